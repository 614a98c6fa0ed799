#!/usr/bin/env node
// Places copies of several GLB models in one scene, for bench/prove.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, extname, join } from 'node:path';

const usage = `Usage: bench/place_models.mjs OUT.glb LAYOUT COLUMNS ROWS SPACING MODEL...
Writes a scene of COLUMNS x ROWS squares with sides of SPACING meters, centred at the origin, y up.

  LAYOUT   field: one model per square, on the ground, turned, scaled by 0.8 to 1.25 and moved off the centre at random
           rooms: every square is a room with walls and doors, and holds four models
  MODEL    FILE.glb=SIZE or FILE.glb,FILE.mtl=SIZE; SIZE is the largest extent in the scene, meters. The MTL file names
           the pictures (map_Kd) of the GLB file's materials, because jalousie-bake does not read those of OBJ files.
           A model that is given twice is placed twice as often.

The models take turns in a random order. The same arguments give the same scene. Only meshes, materials and pictures are taken, from GLB
files with one buffer; animations, skins and cameras are left out.

Examples:
  bench/place_models.mjs forest.glb field 6 6 6 pine.glb,pine.mtl=12 bush.glb=2
  bench/place_models.mjs house.glb rooms 5 5 6 sofa.glb=2 piano.glb=1.6
`;

/** An error in the command line or in a file; printed as one line. */
class Failure extends Error {}

/** Numbers in [0, 1) that are the same in every run (mulberry32). */
function makeRandom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

function readGlb(file) {
  const bytes = readFileSync(file);
  if (bytes.length < 20 || bytes.toString('latin1', 0, 4) !== 'glTF') throw new Failure(`${file}: no GLB file`);
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.toString('utf8', 20, 20 + length));
  const start = 20 + length + 8;
  return { json, binary: bytes.subarray(start, start + (json.buffers?.[0]?.byteLength ?? 0)) };
}

function writeGlb(file, json, binary) {
  const pad = (bytes, fill) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, fill)]);
  const chunk = (bytes, type) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(bytes.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, bytes]);
  };
  const body = Buffer.concat([chunk(pad(Buffer.from(JSON.stringify(json)), 0x20), 0x4e4f534a), chunk(binary, 0x004e4942)]);
  const head = Buffer.alloc(12);
  head.write('glTF', 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + body.length, 8);
  writeFileSync(file, Buffer.concat([head, body]));
}

// Matrices are arrays of 16 numbers in column order, as in glTF.
function multiply(a, b) {
  const out = new Array(16).fill(0);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return out;
}

function matrixOf(node) {
  if (node.matrix) return node.matrix;
  const [x, y, z, w] = node.rotation ?? [0, 0, 0, 1];
  const [sx, sy, sz] = node.scale ?? [1, 1, 1];
  const [tx, ty, tz] = node.translation ?? [0, 0, 0];
  return [
    (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
    2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
    2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0,
    tx, ty, tz, 1,
  ];
}

/** Meshes of a file with their transforms, in the order of its nodes. */
function meshNodes(json) {
  const found = [];
  const visit = (index, parent) => {
    const node = json.nodes[index];
    const matrix = multiply(parent, matrixOf(node));
    if (node.mesh !== undefined) found.push({ mesh: node.mesh, matrix });
    for (const child of node.children ?? []) visit(child, matrix);
  };
  for (const root of json.scenes[json.scene ?? 0].nodes) visit(root, matrixOf({}));
  return found;
}

/** Box of all meshes: { low, high }. Of each mesh the corners of its box are transformed. */
function boundsOf(json, nodes) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { mesh, matrix } of nodes) {
    for (const primitive of json.meshes[mesh].primitives) {
      const { min, max } = json.accessors[primitive.attributes.POSITION];
      for (let corner = 0; corner < 8; ++corner) {
        const p = [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? max[axis] : min[axis]));
        for (let row = 0; row < 3; ++row) {
          const value = matrix[row] * p[0] + matrix[4 + row] * p[1] + matrix[8 + row] * p[2] + matrix[12 + row];
          low[row] = Math.min(low[row], value);
          high[row] = Math.max(high[row], value);
        }
      }
    }
  }
  return { low, high };
}

/** The scene that is being made. */
class Scene {
  constructor() {
    this.json = { asset: { version: '2.0', generator: 'bench/place_models.mjs' }, scene: 0, scenes: [{ nodes: [] }] };
    for (const list of ['nodes', 'meshes', 'materials', 'textures', 'images', 'samplers', 'accessors', 'bufferViews'])
      this.json[list] = [];
    this.parts = [];
    this.bytes = 0;
  }

  appendBytes(bytes) {
    const offset = this.bytes;
    const padding = Buffer.alloc((4 - (bytes.length % 4)) % 4);
    this.parts.push(bytes, padding);
    this.bytes += bytes.length + padding.length;
    return offset;
  }

  /** Copies the lists of a file; indices into them grow by the lengths of the lists here. */
  addFile(file, materials, size) {
    const { json, binary } = readGlb(file);
    if ((json.buffers ?? []).length !== 1) throw new Failure(`${file}: one buffer is expected`);
    const base = Object.fromEntries(Object.entries(this.json).filter(([, v]) => Array.isArray(v)).map(([k, v]) => [k, v.length]));
    const offset = this.appendBytes(binary);
    const moved = (object, key, list) => {
      if (object?.[key] !== undefined) object[key] += base[list];
    };
    for (const view of json.bufferViews ?? []) view.byteOffset = (view.byteOffset ?? 0) + offset;
    for (const accessor of json.accessors ?? []) moved(accessor, 'bufferView', 'bufferViews');
    for (const image of json.images ?? []) moved(image, 'bufferView', 'bufferViews');
    for (const texture of json.textures ?? []) {
      moved(texture, 'source', 'images');
      moved(texture, 'sampler', 'samplers');
    }
    moveTextures(json.materials ?? [], base.textures);
    for (const mesh of json.meshes) {
      for (const primitive of mesh.primitives) {
        moved(primitive, 'indices', 'accessors');
        moved(primitive, 'material', 'materials');
        for (const name of Object.keys(primitive.attributes)) primitive.attributes[name] += base.accessors;
        delete primitive.targets;
      }
    }
    for (const list of ['bufferViews', 'accessors', 'images', 'textures', 'samplers', 'materials', 'meshes'])
      for (const entry of json[list] ?? []) this.json[list].push(entry);
    if (materials) this.addPictures(materials, this.json.materials.slice(base.materials));
    for (const list of ['extensionsUsed', 'extensionsRequired'])
      if (json[list]) this.json[list] = [...new Set([...(this.json[list] ?? []), ...json[list]])];
    return this.model(meshNodes(json).map(({ mesh, matrix }) => ({ mesh: mesh + base.meshes, matrix })), size);
  }

  /** Gives materials the pictures that an MTL file names for them. Pictures that are not there are left out. */
  addPictures(file, materials) {
    const textures = new Map();
    let name = '';
    for (const line of readFileSync(file, 'latin1').split(/\r?\n/)) {
      const [, key, value] = /^\s*(newmtl|map_Kd)\s+(.*?)\s*$/.exec(line) ?? [];
      if (key === 'newmtl') name = value;
      if (key !== 'map_Kd') continue;
      const picture = join(dirname(file), value);
      if (!textures.has(picture)) textures.set(picture, this.addPicture(picture));
      const index = textures.get(picture);
      if (index === undefined) continue;
      for (const material of materials.filter((one) => one.name === name))
        material.pbrMetallicRoughness = { baseColorTexture: { index }, metallicFactor: 0 };
    }
  }

  /** @return  a texture index; undefined if the file is not there or is no PNG or JPEG file */
  addPicture(file) {
    const mimeType = { '.png': 'image/png', '.jpg': 'image/jpeg', '.jpeg': 'image/jpeg' }[extname(file).toLowerCase()];
    if (!mimeType || !existsSync(file)) return undefined;
    const bytes = readFileSync(file);
    this.json.bufferViews.push({ buffer: 0, byteOffset: this.appendBytes(bytes), byteLength: bytes.length });
    this.json.images.push({ mimeType, bufferView: this.json.bufferViews.length - 1 });
    return this.json.textures.push({ source: this.json.images.length - 1 }) - 1;
  }

  /** A model of meshes: its nodes and the matrix that puts it onto the origin, with a largest extent of `size`. */
  model(nodes, size) {
    const { low, high } = boundsOf(this.json, nodes);
    const scale = size / Math.max(...[0, 1, 2].map((axis) => high[axis] - low[axis]));
    if (!(scale > 0 && Number.isFinite(scale))) throw new Failure('a model has no size');
    const middle = [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2];
    const fit = [scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, ...middle.map((value) => -scale * value), 1];
    return { nodes, fit };
  }

  /** Boxes [x0, y0, z0, x1, y1, z1] as one mesh of one colour. */
  addBoxes(name, boxes, color) {
    const positions = [];
    const normals = [];
    const indices = [];
    for (const box of boxes) appendBox(box, positions, normals, indices);
    const accessor = (values, type, componentType, bytes) => {
      this.json.bufferViews.push({ buffer: 0, byteOffset: this.appendBytes(bytes), byteLength: bytes.length });
      const width = type === 'VEC3' ? 3 : 1;
      const entry = { bufferView: this.json.bufferViews.length - 1, componentType, count: values.length / width, type };
      if (type === 'VEC3')
        for (const [key, best] of [['min', Math.min], ['max', Math.max]])
          entry[key] = [0, 1, 2].map((axis) => best(...values.filter((_, i) => i % 3 === axis)));
      return this.json.accessors.push(entry) - 1;
    };
    const floats = (values) => Buffer.from(new Float32Array(values).buffer);
    const attributes = {
      POSITION: accessor(positions, 'VEC3', 5126, floats(positions)),
      NORMAL: accessor(normals, 'VEC3', 5126, floats(normals)),
    };
    const elements = accessor(indices, 'SCALAR', 5125, Buffer.from(new Uint32Array(indices).buffer));
    this.json.materials.push({ name, pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor: 0 } });
    const primitive = { attributes, indices: elements, material: this.json.materials.length - 1 };
    this.json.meshes.push({ name, primitives: [primitive] });
    return this.json.meshes.length - 1;
  }

  addNode(mesh, matrix) {
    this.json.scenes[0].nodes.push(this.json.nodes.push({ mesh, matrix }) - 1);
  }

  /** Puts a model at (x, z), turned around y by an angle in radians. */
  place(model, x, z, angle, scale) {
    const c = scale * Math.cos(angle);
    const s = scale * Math.sin(angle);
    const pose = [c, 0, -s, 0, 0, scale, 0, 0, s, 0, c, 0, x, 0, z, 1];
    for (const { mesh, matrix } of model.nodes) this.addNode(mesh, multiply(multiply(pose, model.fit), matrix));
  }

  write(file) {
    for (const [key, value] of Object.entries(this.json))
      if (Array.isArray(value) && value.length === 0) delete this.json[key];
    this.json.buffers = [{ byteLength: this.bytes }];
    writeGlb(file, this.json, Buffer.concat(this.parts));
  }
}

/** Texture references anywhere in materials, extensions included. */
function moveTextures(value, by) {
  for (const [key, entry] of Object.entries(value)) {
    if (entry === null || typeof entry !== 'object') continue;
    if (key.endsWith('Texture') && Number.isInteger(entry.index)) entry.index += by;
    moveTextures(entry, by);
  }
}

function appendBox(box, positions, normals, indices) {
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [0, 1]) {
      const first = positions.length / 3;
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      for (const [a, b] of [[0, 0], [1, 0], [1, 1], [0, 1]]) {
        const p = [0, 0, 0];
        p[axis] = box[axis + 3 * side];
        p[u] = box[u + 3 * a];
        p[v] = box[v + 3 * b];
        positions.push(...p);
        normals.push(...[0, 1, 2].map((k) => (k === axis ? 2 * side - 1 : 0)));
      }
      const order = side === 1 ? [0, 1, 2, 0, 2, 3] : [0, 2, 1, 0, 3, 2];
      indices.push(...order.map((k) => first + k));
    }
  }
}

const kGroundDepth = 0.02; // meters below the models, so that no surface lies in the plane of another one
const kWall = { height: 3, thickness: 0.2, door: 1, doorHeight: 2.1 }; // meters

/** Centres of the squares: { x, z, column, row }. */
function squares({ columns, rows, spacing }) {
  const all = [];
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column)
      all.push({ x: (column - (columns - 1) / 2) * spacing, z: (row - (rows - 1) / 2) * spacing, column, row });
  return all;
}

function at(x, z, quarter = false) {
  return quarter ? [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, x, 0, z, 1] : [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, z, 1];
}

/** As many models as asked for, each as often as every other one, in a random order. */
function turns(models, count, random) {
  const all = Array.from({ length: count }, (_, i) => models[i % models.length]);
  for (let i = count - 1; i > 0; --i) {
    const other = Math.floor((i + 1) * random());
    [all[i], all[other]] = [all[other], all[i]];
  }
  return all;
}

function addGround(scene, grid) {
  const half = grid.spacing / 2;
  const ground = scene.addBoxes('ground', [[-half, -1, -half, half, -kGroundDepth, half]], [0.25, 0.3, 0.2]);
  for (const { x, z } of squares(grid)) scene.addNode(ground, at(x, z));
}

function layOutField(scene, grid, models, random) {
  addGround(scene, grid);
  const order = turns(models, grid.columns * grid.rows, random);
  squares(grid).forEach(({ x, z }, i) => {
    const moved = () => (random() - 0.5) * 0.4 * grid.spacing;
    scene.place(order[i], x + moved(), z + moved(), 2 * Math.PI * random(), 0.8 * 1.5625 ** random());
  });
}

function layOutRooms(scene, grid, models, random) {
  addGround(scene, grid);
  const { height, thickness, door, doorHeight } = kWall;
  const end = (grid.spacing - thickness) / 2;
  const t = thickness / 2;
  const wall = scene.addBoxes('wall', [
    [-end, -kGroundDepth, -t, -door / 2, height, t],
    [door / 2, -kGroundDepth, -t, end, height, t],
    [-door / 2, doorHeight, -t, door / 2, height, t],
  ], [0.7, 0.68, 0.62]);
  const pillar = scene.addBoxes('pillar', [[-t, -kGroundDepth, -t, t, height, t]], [0.5, 0.48, 0.45]);
  for (const { x, z } of squares({ columns: grid.columns + 1, rows: grid.rows + 1, spacing: grid.spacing }))
    scene.addNode(pillar, at(x, z));
  const half = grid.spacing / 2;
  const order = turns(models, 4 * grid.columns * grid.rows, random);
  for (const { x, z, column, row } of squares(grid)) {
    scene.addNode(wall, at(x, z - half));
    scene.addNode(wall, at(x - half, z, true));
    if (row === grid.rows - 1) scene.addNode(wall, at(x, z + half));
    if (column === grid.columns - 1) scene.addNode(wall, at(x + half, z, true));
    for (const [dx, dz] of [[-1, -1], [1, -1], [-1, 1], [1, 1]]) {
      const quarter = Math.floor(4 * random());
      const near = 0.27 * grid.spacing;
      scene.place(order.pop(), x + dx * near, z + dz * near, (quarter * Math.PI) / 2, 1);
    }
  }
}

function main(words) {
  if (words.length === 0 || words.includes('-h') || words.includes('--help')) {
    process.stdout.write(usage);
    return words.length === 0 ? 2 : 0;
  }
  const [out, layout, columns, rows, spacing, ...specs] = words;
  const grid = { columns: Number(columns), rows: Number(rows), spacing: Number(spacing) };
  const isCount = (value) => Number.isInteger(value) && value > 0 && value <= 100;
  const layOut = { field: layOutField, rooms: layOutRooms }[layout];
  if (!layOut || !isCount(grid.columns) || !isCount(grid.rows) || !(grid.spacing > 0) || specs.length === 0)
    throw new Failure('OUT.glb, field or rooms, two counts of 1 to 100, a length and models are needed (see --help)');
  const scene = new Scene();
  const added = new Map();
  const models = specs.map((spec) => {
    const [, file, materials, size] = /^([^,]+\.glb)(?:,(.+\.mtl))?=([0-9.]+)$/.exec(spec) ?? [];
    if (!file) throw new Failure(`${spec} is not FILE.glb=SIZE or FILE.glb,FILE.mtl=SIZE (see --help)`);
    if (!added.has(spec)) added.set(spec, scene.addFile(file, materials, Number(size)));
    return added.get(spec);
  });
  layOut(scene, grid, models, makeRandom(7));
  scene.write(out);
  return 0;
}

try {
  process.exitCode = main(process.argv.slice(2));
} catch (error) {
  process.stderr.write(`place_models: ${error.message}\n`);
  process.exitCode = error instanceof Failure ? 2 : 1;
}

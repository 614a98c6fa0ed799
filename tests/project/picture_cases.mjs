// node picture_cases.mjs OUT_DIR: writes small GLB files whose pictures every reader of glTF must agree on, and
// cases.json: [{ name, eye, look, time?, camera?, frame? }]. All materials are unlit, so that no shading differs.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { deflateSync } from 'node:zlib';
import { PNG_SIGNATURE, pngChunk, pngHeader } from '../support/png.mjs';

const [outDir] = process.argv.slice(2);
if (!outDir) {
  console.error('usage: node picture_cases.mjs OUT_DIR');
  process.exit(2);
}
mkdirSync(outDir, { recursive: true });

// Documents ------------------------------------------------------------------

const U8 = 5121;
const U16 = 5123;
const FLOAT = 5126;
const WIDTH = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

/** Bytes of numbers, at a multiple of four. */
function packed(type, numbers) {
  const made = type === FLOAT ? new Float32Array(numbers) : type === U16 ? new Uint16Array(numbers) : new Uint8Array(numbers);
  const bytes = Buffer.from(made.buffer);
  return Buffer.concat([bytes, Buffer.alloc((4 - bytes.length % 4) % 4)]);
}

/** A document that grows; add() returns an accessor. */
class Document {
  constructor() {
    this.json = { asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [] }], nodes: [], meshes: [], materials: [],
      accessors: [], bufferViews: [], buffers: [{ byteLength: 0 }], extensionsUsed: ['KHR_materials_unlit'] };
    this.parts = [];
    this.length = 0;
  }

  view(bytes) {
    const padded = Buffer.concat([bytes, Buffer.alloc((4 - bytes.length % 4) % 4)]);
    this.json.bufferViews.push({ buffer: 0, byteOffset: this.length, byteLength: bytes.length });
    this.parts.push(padded);
    this.length += padded.length;
    return this.json.bufferViews.length - 1;
  }

  add(type, componentType, numbers, rest = {}) {
    const count = numbers.length / WIDTH[type];
    const accessor = { bufferView: this.view(packed(componentType, numbers)), type, componentType, count, ...rest };
    if (type === 'VEC3' && componentType === FLOAT || type === 'SCALAR' && componentType === FLOAT) {
      const columns = [...Array(WIDTH[type]).keys()].map((k) => numbers.filter((_, i) => i % WIDTH[type] === k));
      accessor.min = columns.map((c) => Math.fround(Math.min(...c)));
      accessor.max = columns.map((c) => Math.fround(Math.max(...c)));
    }
    this.json.accessors.push(accessor);
    return this.json.accessors.length - 1;
  }

  use(name) {
    if (!this.json.extensionsUsed.includes(name)) this.json.extensionsUsed.push(name);
  }

  node(node, isRoot = true) {
    this.json.nodes.push(node);
    const index = this.json.nodes.length - 1;
    if (isRoot) this.json.scenes[0].nodes.push(index);
    return index;
  }

  mesh(attributes, rest = {}) {
    this.json.meshes.push({ primitives: [{ attributes, ...rest }] });
    return this.json.meshes.length - 1;
  }

  material(rest = {}) {
    this.json.materials.push({ extensions: { KHR_materials_unlit: {} }, ...rest });
    return this.json.materials.length - 1;
  }

  /** A texture with a picture of its own. @param texels  [width, height, bytes RGBA] */
  texture(texels, sampler) {
    for (const key of ['images', 'textures', 'samplers']) this.json[key] ??= [];
    this.json.images.push({ bufferView: this.view(png(...texels)), mimeType: 'image/png' });
    this.json.samplers.push(sampler);
    this.json.textures.push({ source: this.json.images.length - 1, sampler: this.json.samplers.length - 1 });
    return this.json.textures.length - 1;
  }

  animate(node, path, times, type, values, interpolation = 'LINEAR') {
    this.json.animations ??= [{ channels: [], samplers: [] }];
    const { channels, samplers } = this.json.animations[0];
    samplers.push({ input: this.add('SCALAR', FLOAT, times), output: this.add(type, FLOAT, values), interpolation });
    channels.push({ sampler: samplers.length - 1, target: { node, path } });
  }

  glb() {
    this.json.buffers[0].byteLength = this.length;
    let text = Buffer.from(JSON.stringify(this.json));
    text = Buffer.concat([text, Buffer.alloc((4 - text.length % 4) % 4, 0x20)]);
    const u32 = (...values) => packedWords(values);
    return Buffer.concat([Buffer.from('glTF'), u32(2, 28 + text.length + this.length), u32(text.length),
      Buffer.from('JSON'), text, u32(this.length), Buffer.from('BIN\0'), ...this.parts]);
  }
}

const packedWords = (values) => Buffer.from(new Uint32Array(values).buffer);

function png(width, height, texels) {
  const rows = [...Array(height).keys()].map((y) =>
    Buffer.concat([Buffer.alloc(1), Buffer.from(texels.slice(4 * width * y, 4 * width * (y + 1)))]));
  return Buffer.concat([PNG_SIGNATURE, pngHeader(width, height, 8, 6),
    pngChunk('IDAT', deflateSync(Buffer.concat(rows))), pngChunk('IEND', Buffer.alloc(0))]);
}

// Shapes and colours ---------------------------------------------------------

/** Texels that show every flip and shift: a gradient with a mark in each corner. @param alpha  of a texel */
function pattern(side, alpha = () => 255) {
  const texels = [];
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const dark = (x + y) % 2 ? 60 : 0;
      texels.push(Math.round(255 * x / (side - 1)) - (x > side / 2 ? dark : 0), Math.round(255 * y / (side - 1)),
        x < side / 4 && y < side / 4 ? 255 : 80 + dark, alpha(x, y));
    }
  return [side, side, texels];
}

/** A square of 8 x 8 cells from -1 to 1 at z = 0. @param low, high  texture coordinates at two corners */
function square(doc, low = [0, 1], high = [1, 0]) {
  const cells = 8;
  const positions = [];
  const uvs = [];
  const indices = [];
  for (let y = 0; y <= cells; ++y)
    for (let x = 0; x <= cells; ++x) {
      positions.push(2 * x / cells - 1, 2 * y / cells - 1, 0);
      uvs.push(low[0] + (high[0] - low[0]) * x / cells, low[1] + (high[1] - low[1]) * y / cells);
      const at = y * (cells + 1) + x;
      if (x < cells && y < cells) indices.push(at, at + 1, at + cells + 2, at, at + cells + 2, at + cells + 1);
    }
  return { positions, uvs, indices, count: positions.length / 3,
    attributes: { POSITION: doc.add('VEC3', FLOAT, positions) }, index: () => doc.add('SCALAR', U16, indices) };
}

/** A box of the given half sides, a colour for each face. */
function box(doc, [a, b, c] = [0.5, 0.35, 0.25]) {
  const faces = [[0, 1, 2, 1], [0, 1, 2, -1], [1, 2, 0, 1], [1, 2, 0, -1], [2, 0, 1, 1], [2, 0, 1, -1]];
  const half = [a, b, c];
  const positions = [];
  const colors = [];
  const indices = [];
  faces.forEach(([u, v, w, side], face) => {
    for (const [s, t] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
      const point = [0, 0, 0];
      point[u] = s * half[u] * side;
      point[v] = t * half[v];
      point[w] = side * half[w];
      positions.push(...point);
      colors.push(face % 3 === 0 ? 1 : 0.15, face % 3 === 1 ? 0.9 : 0.1 * face, face > 2 ? 0.8 : 0.1, 1);
    }
    const first = 4 * face;
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  });
  return { positions, colors, indices, attributes: { POSITION: doc.add('VEC3', FLOAT, positions),
    COLOR_0: doc.add('VEC4', FLOAT, colors) }, index: () => doc.add('SCALAR', U16, indices) };
}

/** A mesh of a box. */
function boxMesh(doc, half) {
  const made = box(doc, half);
  return doc.mesh(made.attributes, { indices: made.index(), material: doc.material() });
}

// Cases ----------------------------------------------------------------------

const cases = [];
const front = { eye: [0.9, 0.6, 3], look: [0, 0, 0] };

function add(name, build, view = front) {
  const doc = new Document();
  const more = build(doc) ?? {};
  writeFileSync(join(outDir, `${name}.glb`), doc.glb());
  cases.push({ name, ...view, ...more });
}

/** A square with a texture. @param info  beside the index of the texture */
function textured(doc, { sampler = {}, side = 8, low, high, info = {}, material = {}, attributes = () => ({}) }) {
  const made = square(doc, low, high);
  const index = doc.texture(pattern(side, material.alpha), sampler);
  const { alpha, factor, ...rest } = material;
  doc.node({ mesh: doc.mesh({ ...made.attributes, TEXCOORD_0: doc.add('VEC2', FLOAT, made.uvs), ...attributes(doc, made) }, {
    indices: made.index(),
    material: doc.material({ ...rest,
      pbrMetallicRoughness: { baseColorTexture: { index, ...info }, baseColorFactor: factor ?? [1, 1, 1, 1] } }),
  }) });
}

const WRAPS = { repeat: 10497, clamp: 33071, mirror: 33648 };
for (const [name, wrap] of Object.entries(WRAPS))
  for (const [filter, magFilter] of [['linear', 9729], ['nearest', 9728]])
    add(`wrap-${name}-${filter}`, (doc) => textured(doc, { low: [-0.8, 1.7], high: [1.9, -0.6],
      sampler: { wrapS: wrap, wrapT: wrap, magFilter } }));
add('wrap-clamp-mirror', (doc) => textured(doc, { low: [-0.8, 1.7], high: [1.9, -0.6],
  sampler: { wrapS: WRAPS.clamp, wrapT: WRAPS.mirror } }));
add('mip-levels', (doc) => textured(doc, { side: 256, low: [0, 3], high: [3, 0], sampler: { minFilter: 9987 } }));
const second = (doc, made) => ({ TEXCOORD_1: doc.add('VEC2', FLOAT, made.uvs.map((v, i) => (i % 2 ? 1 - v : v) * 0.5)) });
add('second-coordinates', (doc) => textured(doc, { info: { texCoord: 1 }, attributes: second }));
const transformed = (transform) => (doc) => {
  doc.use('KHR_texture_transform');
  textured(doc, { info: { extensions: { KHR_texture_transform: transform } }, attributes: second });
};
add('transform-scale', transformed({ scale: [3, -2] }));
add('transform-rotation', transformed({ rotation: 0.4 }));
add('transform-offset', transformed({ offset: [0.3, -0.2] }));
add('transform-texcoord', transformed({ offset: [0.1, 0.2], scale: [2, 2], texCoord: 1 }));
add('factor', (doc) => textured(doc, { material: { factor: [1, 0.4, 0.2, 1] } }));
add('mask', (doc) => textured(doc, { side: 16, sampler: { magFilter: 9728 }, material: { alphaMode: 'MASK',
  alphaCutoff: 0.5, doubleSided: true, alpha: (x, y) => ((x >> 2) + (y >> 2)) % 2 ? 40 : 255 } }));
add('colors-bytes', (doc) => textured(doc, { attributes: (d, made) => ({ COLOR_0: d.add('VEC4', U8,
  [...Array(made.count).keys()].flatMap((i) => [255 - 3 * i, 2 * i, 128, 255]), { normalized: true }) }) }));
add('back-hidden', (doc) => textured(doc, {}), { eye: [0.9, 0.6, -3], look: [0, 0, 0] });
add('back-shown', (doc) => textured(doc, { material: { doubleSided: true } }), { eye: [0.9, 0.6, -3], look: [0, 0, 0] });

add('box', (doc) => { doc.node({ mesh: boxMesh(doc) }); });
for (const [name, mode] of [['strip', 5], ['fan', 6]])
  add(name, (doc) => {
    const points = mode === 5 ? [-1, -0.5, 0, -0.6, 0.5, 0, 0, -0.5, 0.3, 0.4, 0.6, 0, 1, -0.4, 0]
      : [0, 0, 0.3, 1, 0, 0, 0.5, 0.8, 0, -0.5, 0.8, 0, -1, 0, 0, -0.4, -0.7, 0];
    doc.node({ mesh: doc.mesh({ POSITION: doc.add('VEC3', FLOAT, points) }, { mode, material: doc.material({
      doubleSided: true, pbrMetallicRoughness: { baseColorFactor: [0.9, 0.3, 0.1, 1] } }) }) });
  });
add('hierarchy', (doc) => {
  const leaf = doc.node({ mesh: boxMesh(doc), translation: [0.7, 0, 0], rotation: [0, 0.38268343, 0, 0.92387953] }, false);
  const middle = doc.node({ children: [leaf], scale: [1, 0.5, 1.5], rotation: [0, 0, 0.25881905, 0.96592583] }, false);
  doc.node({ children: [middle], translation: [-0.4, 0.1, 0] });
});
add('matrix', (doc) => {
  doc.node({ mesh: boxMesh(doc), matrix: [0.8, 0.3, 0, 0, -0.3, 0.8, 0, 0, 0, 0, 1.5, 0, 0.2, -0.1, 0.3, 1] });
});
add('mirrored', (doc) => { doc.node({ mesh: boxMesh(doc), scale: [-1, 1, 1], rotation: [0.2, 0.3, 0.1, 0.9273618] }); });
add('instances', (doc) => {
  doc.use('EXT_mesh_gpu_instancing');
  doc.node({ mesh: boxMesh(doc, [0.2, 0.2, 0.2]), extensions: { EXT_mesh_gpu_instancing: { attributes: {
    TRANSLATION: doc.add('VEC3', FLOAT, [-0.8, 0, 0, 0, 0.5, 0, 0.8, -0.3, 0.2]),
    ROTATION: doc.add('VEC4', FLOAT, [0, 0, 0, 1, 0, 0.6, 0, 0.8, 0.28, 0, 0, 0.96]),
    SCALE: doc.add('VEC3', FLOAT, [1, 1, 1, 1.5, 1, 0.5, 0.7, 2, 1]),
  } } } });
});

/** A square that two joints bend; the second one is a child of the first. */
function skinned(doc) {
  const made = square(doc);
  const upper = doc.node({ translation: [0, 1, 0], rotation: [0.25881905, 0, 0, 0.96592583] }, false);
  const lower = doc.node({ children: [upper], translation: [0.2, -0.7, 0], rotation: [0, 0, 0.13052619, 0.99144486] });
  const share = (i) => (made.positions[3 * i + 1] + 1) / 2;
  const all = [...Array(made.count).keys()];
  const mesh = doc.mesh({ ...made.attributes, TEXCOORD_0: doc.add('VEC2', FLOAT, made.uvs),
    JOINTS_0: doc.add('VEC4', U8, all.flatMap(() => [0, 1, 0, 0])),
    WEIGHTS_0: doc.add('VEC4', FLOAT, all.flatMap((i) => [1 - share(i), share(i), 0, 0])),
  }, { indices: made.index(), material: doc.material({ doubleSided: true, pbrMetallicRoughness: {
    baseColorTexture: { index: doc.texture(pattern(8), {}) } } }) });
  const unit = (y) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, y, 0, 1];
  doc.json.skins = [{ joints: [lower, upper], inverseBindMatrices: doc.add('MAT4', FLOAT, [...unit(0.7), ...unit(-0.3)]) }];
  doc.node({ mesh, skin: 0, translation: [5, 5, 5] });
  return upper;
}
add('skin', (doc) => { skinned(doc); });
add('skin-animated', (doc) => {
  doc.animate(skinned(doc), 'rotation', [0, 2], 'VEC4', [0, 0, 0, 1, 0, 0.6, 0, 0.8]);
  return { time: 1.3 };
});

/** A box with two morph targets. */
function morphed(doc, weights) {
  const made = box(doc);
  const moved = (move) => doc.add('VEC3', FLOAT,
    [...Array(made.positions.length / 3).keys()].flatMap((i) => move(made.positions.slice(3 * i, 3 * i + 3))));
  const mesh = doc.mesh(made.attributes, { indices: made.index(), material: doc.material({ doubleSided: true }), targets: [
    { POSITION: moved(([x, y]) => [x * y, 0.3, 0]) }, { POSITION: moved(([, y, z]) => [0, 0, y > 0 ? 0.4 : z]) }] });
  doc.json.meshes[mesh].weights = weights;
  return doc.node({ mesh });
}
add('morph', (doc) => { morphed(doc, [0.8, 0.5]); });
add('morph-animated', (doc) => {
  doc.animate(morphed(doc, [0, 0]), 'weights', [0, 1], 'SCALAR', [0, 1, 1, 0]);
  return { time: 0.25 };
});

const turn = [0, 0, 0, 1, 0, 0.70710678, 0, 0.70710678];
add('node-linear', (doc) => {
  const node = doc.node({ mesh: boxMesh(doc) });
  doc.animate(node, 'translation', [0, 2], 'VEC3', [0, 0, 0, 0.8, 0.4, -0.5]);
  doc.animate(node, 'rotation', [0, 2], 'VEC4', turn);
  doc.animate(node, 'scale', [0, 2], 'VEC3', [1, 1, 1, 0.5, 2, 1]);
  return { time: 1.25 };
});
add('node-step', (doc) => {
  doc.animate(doc.node({ mesh: boxMesh(doc) }), 'rotation', [0, 1, 2], 'VEC4', [...turn, 0.6, 0, 0, 0.8], 'STEP');
  return { time: 1.9 };
});
add('node-spline', (doc) => {
  doc.animate(doc.node({ mesh: boxMesh(doc) }), 'translation', [0, 2], 'VEC3',
    [0, 0, 0, -0.5, 0, 0, 1, 2, 0, 0, -2, 0, 0.6, 0.2, 0, 0, 0, 0], 'CUBICSPLINE');
  return { time: 0.7 };
});
add('node-spline-rotation', (doc) => {
  doc.animate(doc.node({ mesh: boxMesh(doc) }), 'rotation', [0, 2], 'VEC4',
    [0, 0, 0, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 0, 0, 0.4, 0, 0, 0.70710678, 0, 0.70710678, 0, 0, 0, 0], 'CUBICSPLINE');
  return { time: 1.1 };
});

/** A box, a camera that looks at it, and a node above the camera. */
function filmed(doc, above = {}, own = {}) {
  doc.json.cameras = [{ type: 'perspective', perspective: { yfov: 0.7, znear: 0.1 } }];
  doc.node({ mesh: boxMesh(doc) });
  const camera = doc.node({ camera: 0, name: 'eye', ...own }, false);
  return { camera, parent: doc.node({ children: [camera], translation: [0, 0, 3], ...above }) };
}
const byCamera = (frame) => ({ camera: 'eye', frame });
add('camera-parent', (doc) => {
  const { parent } = filmed(doc);
  doc.animate(parent, 'translation', [0, 2], 'VEC3', [0, 0, 3, 1, 0.5, 2.5]);
  doc.animate(parent, 'rotation', [0, 2], 'VEC4', [0, 0, 0, 1, -0.1, 0.2, 0, 0.9746794]);
  return byCamera(45);
}, {});
add('camera-spline', (doc) => {
  const { camera } = filmed(doc);
  doc.animate(camera, 'translation', [0, 2], 'VEC3',
    [0, 0, 0, 0, 0, 0, 0.5, 0.3, 0, 0, 0, 1, 0.4, 0.2, 0.3, 0, 0, 0], 'CUBICSPLINE');
  return byCamera(20);
}, {});
add('camera-step', (doc) => {
  doc.animate(filmed(doc).camera, 'translation', [0, 1, 2], 'VEC3', [0, 0, 0, 0.3, 0.2, 0, 0.6, 0, 0], 'STEP');
  return byCamera(50);
}, {});
add('camera-orthographic', (doc) => {
  const { camera, parent } = filmed(doc, {}, {});
  doc.json.cameras = [{ type: 'orthographic', orthographic: { xmag: 1.4 * 4 / 3, ymag: 1.4, znear: 0, zfar: 20 } }];
  doc.animate(parent, 'rotation', [0, 2], 'VEC4', [0, 0, 0, 1, -0.1, 0.2, 0, 0.9746794]);
  doc.animate(camera, 'translation', [0, 2], 'VEC3', [0, 0, 0, 0.4, 0.3, 4]);
  return byCamera(45);
}, {});
add('camera-below-scale', (doc) => {
  filmed(doc, { scale: [2, 2, 2] }, { translation: [0.2, 0.1, 0] });
  return byCamera(0);
}, {});

writeFileSync(join(outDir, 'cases.json'), JSON.stringify(cases, null, 1));

// node babylon_check.cjs BABYLON_FOLDER FILE.glb: loads the file with Babylon.js and its NullEngine and prints as JSON what it built.
//
// Babylon.js takes MSFT_lod for progressive loading only: the coarsest level of every chain is shown first, then each level replaces
// the one before. It calls Mesh.addLODLevel for none of them and leaves MSFT_screencoverage to the application. So the file is loaded
// twice: as any application would, which must end with LOD 0 of every chain and nothing else; and by byte ranges (useRangeRequests,
// from memory), where a step begins only when the one before is complete, so that each level can be read from the scene.
//
//   meshes        meshes with triangles after the plain load
//   triangles     theirs, a thin-instanced mesh counted once
//   instances     their thin instances (EXT_mesh_gpu_instancing)
//   boundingBox   their [minimum, maximum], glTF's axes: exact for a plain mesh, from boxes for a thin-instanced one
//   chains        per node with MSFT_lod its name and levels, LOD 0 first: triangles, instances and boundingBox as built in the stepwise
//                 load, and screenCoverage as an application gets it from Babylon.js (metadata.gltf.extras)
//   lodsLoaded    steps, which is the number of levels of the longest chain
//   warnings, errors   what Babylon.js says, and what is wrong with a chain
//
// Nothing is drawn and images are not decoded. EXT_meshopt_compression is decoded by the meshoptimizer package in BABYLON_FOLDER,
// without a worker; Babylon.js would fetch that decoder from a web address.
'use strict';
const fs = require('fs');
const path = require('path');
const { createRequire } = require('module');

const warnings = [];
const errors = [];
const said = (words) => words.join(' ').replace(/^BJS - \[[\d:]*\]: /, '');  // without the time of day
console.log = console.info = console.debug = () => {};  // the engine's banner; standard output holds the JSON alone
console.warn = (...words) => warnings.push(said(words));
console.error = (...words) => errors.push(said(words));

function fail(error) {
  process.stderr.write(`babylon_check: ${String((error && error.message) || error).split('\n')[0]}\n`, () => process.exit(1));
}
process.on('uncaughtException', fail);
process.on('unhandledRejection', fail);

// For Babylon.js this is what loading the decoder's script leaves behind.
function provideMeshoptDecoder(BABYLON, decoder) {
  globalThis.MeshoptDecoder = {
    ready: decoder.ready,
    useWorkers: () => {},
    decodeGltfBufferAsync: async (count, stride, source, mode, filter) => {
      const result = new Uint8Array(count * stride);
      decoder.decodeGltfBuffer(result, count, stride, source, mode, filter);
      return result;
    },
  };
  BABYLON.Tools.LoadBabylonScriptAsync = async (url) => {
    if (!url.includes('meshopt_decoder')) throw new Error(`needs a script from the network: ${url}`);
  };
}

// Notes which Babylon.js node is built for which glTF node. Comes after MSFT_lod (order 100), so that it sees every level's node.
function noteBuiltNodes(GLTF2, built, { imagesFirst }) {
  const name = 'built_nodes';
  GLTF2.unregisterGLTFExtension(name);
  GLTF2.registerGLTFExtension(name, false, (loader) => {
    const entered = new Set();
    return {
      name,
      enabled: true,
      order: 150,
      dispose: () => {},
      // By byte ranges an image waits for the step of the level that names it first. Where that is not the first step, and another
      // chain needs the image sooner, Babylon.js waits for ever.
      onLoading: () => {
        if (imagesFirst) (loader.gltf.images || []).forEach((image, index) => loader.loadImageAsync(`/images/${index}`, image));
      },
      loadNodeAsync: (context, node, assign) => {
        if (entered.has(node.index)) return null;  // called again from below: the loader's own turn
        entered.add(node.index);
        return loader.loadNodeAsync(context, node, (babylonNode) => {
          built.set(node.index, babylonNode);
          assign(babylonNode);
        });
      },
    };
  });
}

const isShown = (node) => node !== undefined && !node.isDisposed() && node.isEnabled();
const trianglesOf = (mesh) => (mesh.getTotalIndices() || mesh.getTotalVertices()) / 3;

// A node with one primitive is the mesh itself; with several they are its children, beside the children that are glTF nodes.
function primitivesOf(babylonNode, glTFNodes) {
  const children = babylonNode.getChildMeshes(true).filter((mesh) => !glTFNodes.has(mesh));
  return [babylonNode, ...children].filter((mesh) => mesh.getTotalVertices && mesh.getTotalVertices() > 0);
}

class Box {
  low = [Infinity, Infinity, Infinity];
  high = [-Infinity, -Infinity, -Infinity];

  include(x, y, z) {
    this.low = [Math.min(this.low[0], x), Math.min(this.low[1], y), Math.min(this.low[2], z)];
    this.high = [Math.max(this.high[0], x), Math.max(this.high[1], y), Math.max(this.high[2], z)];
  }

  corners() {
    return [0, 1, 2, 3, 4, 5, 6, 7].flatMap((bits) => [0, 1, 2].map((axis) => (((bits >> axis) & 1) ? this.high : this.low)[axis]));
  }

  report() {
    return this.low[0] > this.high[0] ? null : [this.low, this.high].map((corner) => corner.map((value) => Number(value.toPrecision(7))));
  }
}

function boundingBoxOf(BABYLON, meshes) {
  const box = new Box();
  const moved = new BABYLON.Vector3();
  const include = (floats, matrix) => {
    for (let i = 0; i < floats.length; i += 3) {
      BABYLON.Vector3.TransformCoordinatesFromFloatsToRef(floats[i], floats[i + 1], floats[i + 2], matrix, moved);
      box.include(moved.x, moved.y, moved.z);
    }
  };
  for (const mesh of meshes) {
    const world = mesh.computeWorldMatrix(true);
    const positions = mesh.getVerticesData(BABYLON.VertexBuffer.PositionKind);
    if (mesh.hasThinInstances) {
      const own = new Box();
      for (let i = 0; i < positions.length; i += 3) own.include(positions[i], positions[i + 1], positions[i + 2]);
      mesh.thinInstanceGetWorldMatrices().forEach((instance) => include(own.corners(), instance.multiply(world)));
    } else {
      include(positions, world);
    }
  }
  return box.report();
}

function measure(BABYLON, meshes) {
  return {
    triangles: meshes.reduce((sum, mesh) => sum + trianglesOf(mesh), 0),
    instances: meshes.reduce((sum, mesh) => sum + (mesh.thinInstanceCount || 0), 0),
    boundingBox: boundingBoxOf(BABYLON, meshes),
  };
}

class Chain {
  constructor(json, index) {
    this.title = `node ${index}`;
    this.nodes = [index, ...json.nodes[index].extensions.MSFT_lod.ids];
    this.levels = this.nodes.map(() => ({ triangles: 0, instances: 0, boundingBox: null }));
    this.name = null;
    this.coverage = [];
  }

  // The Babylon.js node of this level, if that one is shown and no other of the chain.
  shownAt(level, built, when) {
    const shown = this.nodes.flatMap((node, k) => (isShown(built.get(node)) ? [k] : []));
    if (shown.length === 1 && shown[0] === level) return built.get(this.nodes[level]);
    errors.push(`${this.title}: ${when} shows ${shown.length === 0 ? 'no level' : `LOD ${shown.join(', ')}`} instead of LOD ${level}`);
    return null;
  }

  // Step 0 shows the coarsest level; a chain shorter than the longest one stays at LOD 0 from then on.
  readStep(BABYLON, step, built, glTFNodes) {
    const level = Math.max(0, this.nodes.length - 1 - step);
    const babylonNode = this.shownAt(level, built, `step ${step}`);
    if (babylonNode === null) return;
    this.levels[level] = measure(BABYLON, primitivesOf(babylonNode, glTFNodes));
    if (this.levels[level].triangles === 0) errors.push(`${this.title}: LOD ${level} has no triangle`);
    if (level > 0) return;
    const { gltf } = babylonNode.metadata || {};
    this.name = babylonNode.name;
    this.coverage = (gltf && gltf.extras && gltf.extras.MSFT_screencoverage) || [];
  }

  report() {
    return { name: this.name, levels: this.levels.map((level, k) => ({ ...level, screenCoverage: this.coverage[k] ?? null })) };
  }
}

// Loads the file into a scene of its own. onStep(step, chains, built) is called after each step, onLimit(levels) says how many Babylon.js
// would load of a chain and returns how many it shall.
async function load({ BABYLON, GLTF2 }, file, { stepwise, onStep, onLimit }) {
  const scene = new BABYLON.Scene(new BABYLON.NullEngine());
  scene.useRightHandedSystem = true;
  const built = new Map();
  noteBuiltNodes(GLTF2, built, { imagesFirst: stepwise });
  let chains = [];
  let complete;
  BABYLON.SceneLoader.OnPluginActivatedObservable.addOnce((plugin) => {
    plugin.useRangeRequests = stepwise;
    complete = new Promise((resolve, reject) => {
      plugin.onCompleteObservable.addOnce(resolve);
      plugin.onErrorObservable.addOnce(reject);
    });
    complete.catch(() => {});  // awaited below
    plugin.onParsedObservable.addOnce(({ json }) => {
      const hasChain = (index) => json.nodes[index].extensions?.MSFT_lod?.ids !== undefined;
      chains = [...(json.nodes || []).keys()].filter(hasChain).map((index) => new Chain(json, index));
    });
    plugin.onExtensionLoadedObservable.add((extension) => {
      if (extension.name !== 'MSFT_lod') return;
      extension.maxLODsToLoad = onLimit(extension.maxLODsToLoad, chains);
      extension.onNodeLODsLoadedObservable.add((step) => onStep(step, chains, built));
    });
  });
  const bytes = fs.readFileSync(file);
  const view = new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  await BABYLON.ImportMeshAsync(view, scene, { pluginExtension: '.glb', name: path.basename(file) });
  await complete;
  return { scene, chains, built };
}

async function check(folder, file) {
  const packages = createRequire(path.resolve(folder) + path.sep);
  const BABYLON = packages('babylonjs');
  const { GLTF2 } = packages('babylonjs-loaders');
  provideMeshoptDecoder(BABYLON, packages('meshoptimizer/meshopt_decoder.js'));
  const babylon = { BABYLON, GLTF2 };

  const plain = await load(babylon, file, {
    stepwise: false,
    onStep: () => {},
    onLimit: (limit, chains) => {
      const longest = Math.max(0, ...chains.map((chain) => chain.nodes.length));
      if (longest > limit)
        warnings.push(`a chain has ${longest} levels; Babylon.js loads the coarsest ${limit}, not LOD 0, unless maxLODsToLoad says more`);
      return limit;
    },
  });
  plain.chains.forEach((chain) => chain.shownAt(0, plain.built, 'the plain load'));
  const meshes = plain.scene.meshes.filter((mesh) => mesh.getTotalVertices() > 0 && mesh.isEnabled());

  let lodsLoaded = 0;
  const steps = await load(babylon, file, {
    stepwise: true,
    onStep: (step, chains, built) => {
      const glTFNodes = new Set(built.values());
      chains.forEach((chain) => chain.readStep(BABYLON, step, built, glTFNodes));
      lodsLoaded = step + 1;
    },
    onLimit: () => Infinity,
  });
  return {
    meshes: meshes.length,
    ...measure(BABYLON, meshes),
    chains: steps.chains.map((chain) => chain.report()),
    lodsLoaded,
    warnings: [...new Set(warnings)],
    errors: [...new Set(errors)],
  };
}

if (process.argv.length !== 4) {
  fail('usage: node babylon_check.cjs BABYLON_FOLDER FILE.glb');
} else {
  process.on('beforeExit', () => fail('Babylon.js never ends loading'));
  check(process.argv[2], process.argv[3])
    .then((report) => process.stdout.write(`${JSON.stringify(report)}\n`, () => process.exit(0)))
    .catch(fail);
}

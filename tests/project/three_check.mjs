// node three_check.mjs THREE_FOLDER FILE.glb: loads the file with three.js' GLTFLoader and prints as JSON what it built.
//
//   meshes        meshes reachable from the scene; three.js knows no MSFT_lod, so these are LOD 0 and what has no chain
//   triangles     theirs, an InstancedMesh counted once
//   instances     instances of all InstancedMeshes (EXT_mesh_gpu_instancing)
//   boundingBox   [minimum, maximum] of the scene: exact for a plain mesh, from boxes for an InstancedMesh
//   warnings      what three.js says
//
// Stubbed: textures. Decoding an image takes a browser; here the bytes of a PNG or JPEG image in the file are read and their signature
// is compared with the MIME type.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const warnings = [];
console.log = console.info = console.debug = () => {};  // standard output holds the JSON alone
console.warn = console.error = (...words) => warnings.push(words.join(' '));

function fail(error) {
  process.stderr.write(`three_check: ${String(error?.message ?? error).split('\n')[0]}\n`, () => process.exit(1));
}
process.on('uncaughtException', fail);
process.on('unhandledRejection', fail);

const signatures = { 'image/png': '89504e47', 'image/jpeg': 'ffd8ff' };

function stubTextures(THREE, parser) {
  return {
    name: 'stub_textures',
    async loadTexture(index) {
      const image = parser.json.images[parser.json.textures[index].source];
      if (image.bufferView !== undefined) {
        const bytes = Buffer.from(await parser.getDependency('bufferView', image.bufferView));
        const signature = signatures[image.mimeType];
        if (signature !== undefined && !bytes.toString('hex', 0, 8).startsWith(signature))
          warnings.push(`texture ${index}: its image is not what its MIME type ${image.mimeType} says`);
      }
      return new THREE.Texture();
    },
  };
}

async function load(folder, file) {
  const module = (name) => import(pathToFileURL(path.resolve(folder, name)).href);
  const THREE = await module('build/three.module.js');
  const { GLTFLoader } = await module('examples/jsm/loaders/GLTFLoader.js');
  const { MeshoptDecoder } = await module('examples/jsm/libs/meshopt_decoder.module.js');
  await MeshoptDecoder.ready;

  const loader = new GLTFLoader();
  loader.setMeshoptDecoder(MeshoptDecoder);
  loader.register((parser) => stubTextures(THREE, parser));
  const bytes = readFileSync(file);
  const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');

  let meshes = 0;
  let triangles = 0;
  let instances = 0;
  gltf.scene.traverse((object) => {
    if (!object.isMesh) return;
    meshes += 1;
    triangles += (object.geometry.index ?? object.geometry.attributes.position).count / 3;
    if (object.isInstancedMesh) instances += object.count;
  });
  gltf.scene.updateMatrixWorld(true);
  const box = new THREE.Box3().setFromObject(gltf.scene, true);
  const rounded = (corner) => corner.toArray().map((value) => Number(value.toPrecision(7)));
  return { meshes, triangles, instances, boundingBox: box.isEmpty() ? null : [rounded(box.min), rounded(box.max)], warnings };
}

if (process.argv.length !== 4) {
  fail('usage: node three_check.mjs THREE_FOLDER FILE.glb');
} else {
  process.on('beforeExit', () => fail('three.js never ends loading'));
  load(process.argv[2], process.argv[3])
    .then((report) => process.stdout.write(`${JSON.stringify(report)}\n`, () => process.exit(0)))
    .catch(fail);
}

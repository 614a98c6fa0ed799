// node three_pictures.mjs THREE_FOLDER FOLDER WIDTHxHEIGHT BACKGROUND: draws the cases of FOLDER/cases.json (see
// picture_cases.mjs) with three.js in a headless Chromium and writes FOLDER/NAME.three.png. BACKGROUND is RRGGBB.
// Exit code 77 without a browser, 1 if a case cannot be drawn.
import { readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { Browser } from '../support/browser.mjs';

const [three, folder, size, background] = process.argv.slice(2);
if (!background) {
  console.error('usage: node three_pictures.mjs THREE_FOLDER FOLDER WIDTHxHEIGHT BACKGROUND');
  process.exit(2);
}
const [width, height] = size.split('x').map(Number);
const cases = JSON.parse(readFileSync(join(folder, 'cases.json')));
const MOST_SECONDS = 150;
const FOV_Y = 0.8;  // radians, as `jalousie render --eye` has it

const PAGE = `<!doctype html><meta charset="utf-8"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from '/three/examples/jsm/loaders/GLTFLoader.js';
import { MeshoptDecoder } from '/three/examples/jsm/libs/meshopt_decoder.module.js';
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setPixelRatio(1);
renderer.setSize(${width}, ${height}, false);
renderer.setClearColor(new THREE.Color('#${background}'), 1);
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);

function pose(gltf, seconds) {
  const mixer = new THREE.AnimationMixer(gltf.scene);
  for (const clip of gltf.animations) {
    const action = mixer.clipAction(clip);
    action.setLoop(THREE.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
  }
  mixer.setTime(seconds);
}

function cameraOf(gltf, c) {
  if (!c.camera) {
    const camera = new THREE.PerspectiveCamera(THREE.MathUtils.radToDeg(${FOV_Y}), 1, 0.01, 1000);
    camera.position.set(...c.eye);
    camera.lookAt(...c.look);
    return camera;
  }
  let found = null;
  gltf.scene.traverse((object) => { if (object.isCamera && (object.name === c.camera || !found)) found = object; });
  return found;
}

window.draw = async (c) => {
  const gltf = await loader.loadAsync('/case/' + c.name + '.glb');
  if (c.time !== undefined) pose(gltf, c.time);
  if (c.frame !== undefined) pose(gltf, c.frame / 30);
  const camera = cameraOf(gltf, c);
  camera.aspect = ${width} / ${height};
  camera.updateProjectionMatrix();
  renderer.render(gltf.scene, camera);
  return renderer.domElement.toDataURL('image/png');
};
window.ready = true;
</script>`;

const TYPES = { '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
function answer(request, response) {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://host').pathname));
  try {
    if (path === '/') {
      response.setHeader('content-type', 'text/html');
      response.end(PAGE);
      return;
    }
    const file = path.startsWith('/three/') ? join(three, path.slice(7)) : join(folder, path.slice(6));
    response.setHeader('content-type', TYPES[extname(file)] ?? 'application/octet-stream');
    response.end(readFileSync(file));
  } catch {
    response.statusCode = 404;
    response.end();
  }
}

const browser = new Browser(MOST_SECONDS, ['--use-angle=swiftshader', '--enable-unsafe-swiftshader']);
const server = createServer(answer);
await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
let code = 0;
try {
  await browser.start();
  await browser.command('/timeouts', { script: 60000 });
  await browser.command('/url', { url: `http://127.0.0.1:${server.address().port}/` });
  await browser.runAsync('const done = arguments[0]; (function wait() { window.ready ? done() : setTimeout(wait, 20); })();');
  for (const c of cases) {
    const picture = await browser.runAsync(`const [c, done] = arguments;
      window.draw(c).then(done, (error) => done('error: ' + error.message));`, c);
    if (!picture.startsWith('data:')) throw new Error(`${c.name}: ${picture}`);
    writeFileSync(join(folder, `${c.name}.three.png`), Buffer.from(picture.slice(picture.indexOf(',') + 1), 'base64'));
  }
} catch (error) {
  console.error(`three_pictures: ${error.message}`);
  code = 1;
}
server.close();
await browser.end(code);

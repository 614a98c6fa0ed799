// node make_seeds.mjs CORPUS OUT: seeds for the fuzzers out of the files of ../hostile/make_corpus.mjs, small ones only.
// OUT/ply, OUT/obj and OUT/glb hold them as they are, OUT/gltf as JSON, a zero byte and the binary chunk, OUT/bake all
// kinds behind three bytes of options.
import fs from 'node:fs';
import path from 'node:path';

const kMaxBytes = 4096;
const [corpus, out] = process.argv.slice(2);
if (!out) {
  console.error('usage: make_seeds.mjs CORPUS OUT');
  process.exit(2);
}
const cases = JSON.parse(fs.readFileSync(path.join(corpus, 'index.json'), 'utf8'));

function save(kind, name, bytes) {
  fs.mkdirSync(path.join(out, kind), { recursive: true });
  fs.writeFileSync(path.join(out, kind, name), bytes);
}

/** JSON and binary of a GLB or glTF file as the harness puts them together again; null if it has no such parts. */
function unassembled(bytes) {
  if (bytes.subarray(0, 4).toString('latin1') !== 'glTF') return bytes;
  if (bytes.length < 20) return null;
  const length = bytes.readUInt32LE(12);
  const json = bytes.subarray(20, 20 + length);
  const binary = bytes.subarray(Math.min(bytes.length, 28 + length));
  return Buffer.concat([Buffer.from(json.toString('utf8').trimEnd()), Buffer.from([0]), binary]);
}

for (const { name, input } of cases) {
  const file = path.join(corpus, input);
  if (!fs.existsSync(file) || !fs.statSync(file).isFile() || fs.statSync(file).size > kMaxBytes) continue;
  const bytes = fs.readFileSync(file);
  const options = (kind) => Buffer.from([kind, bytes.length & 255, (bytes.length >> 3) & 255]);
  const extension = path.extname(file);
  if (extension === '.ply') {
    save('ply', name, bytes);
    save('bake', name, Buffer.concat([options(0), bytes]));
  } else if (extension === '.obj') {
    save('obj', name, Buffer.concat([bytes, Buffer.from('\n%%\nnewmtl a\nKd 1 0 0\nd 0.5\nmap_Kd -s 1 1 a.png\n')]));
    save('bake', name, Buffer.concat([options(1), bytes]));
  } else {
    save('glb', name, bytes);
    const parts = unassembled(bytes);
    if (!parts) continue;
    save('gltf', name, parts);
    save('bake', name, Buffer.concat([options(2), parts]));
  }
}
// A tetrahedron as ASCII and as binary STL: the corpus has no file of this kind that is small.
const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
const faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
const facets = faces.map((face) => `facet normal 0 0 0\nouter loop\n${
  face.map((v) => `vertex ${corners[v].join(' ')}\n`).join('')}endloop\nendfacet\n`);
save('stl', 'ascii', Buffer.from(`solid a\n${facets.join('')}endsolid a\n`));
const binary = Buffer.alloc(84 + 50 * faces.length);
binary.writeUInt32LE(faces.length, 80);
faces.forEach((face, f) => face.forEach((v, k) => corners[v].forEach((x, axis) => {
  binary.writeFloatLE(x, 84 + 50 * f + 12 * (k + 1) + 4 * axis);
})));
save('stl', 'binary', binary);
// Triangles made of the bytes themselves: a few shapes, every combination of options that matters.
for (let bits = 0; bits < 128; ++bits) {
  const shape = Array.from({ length: 90 + bits }, (_, i) => (i * (37 + 2 * bits) + (i >> 3)) & 255);
  save('bake', `triangles-${bits}`, Buffer.from([3, bits * 2, bits, 20, ...shape]));
}

// Writes a corpus of broken files for all programs: node make_corpus.mjs OUT_DIR
// Every case has a folder OUT_DIR/NAME with its input and side files, and is broken in one way; OUT_DIR/index.json lists
// { name, input, code, reason, runtime, about }: the exit code that jalousie-bake owes (3 absent, 4 unreadable,
// 5 malformed, 6 unsupported, 7 over a limit, 0 odd but valid) and a part of its message (reasons.mjs; null where the
// code is 0). `runtime` has code and reason of the commands that draw. OUT_DIR/outside holds bait that no case may open.
// The same bytes in every run; only absolute symbolic links contain OUT_DIR.
import { execFileSync } from 'node:child_process';
import { mkdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { deflateSync } from 'node:zlib';
import { PNG_SIGNATURE, pngChunk, pngHeader } from '../support/png.mjs';
import { reasonsOf, runtimeOf } from './reasons.mjs';

if (process.argv.length !== 3) {
  console.error('usage: node make_corpus.mjs OUT_DIR');
  process.exit(2);
}
const out = resolve(process.argv[2]);

// Cases ----------------------------------------------------------------------

const cases = [];

/** One case per row [name, about, value, code if not the group's]; `files` turns the value into files, the input first. */
function group(prefix, code, files, rows) {
  for (const [name, about, value, own = code] of rows)
    cases.push({ name: `${prefix}-${name}`, code: own, about, files: files(value) });
}

// What a file name may stand for besides bytes.
const folder = { kind: 'folder' };
const fifo = { kind: 'fifo' };
const absent = { kind: 'absent' };
const link = (target) => ({ kind: 'link', target });

function write(path, content) {
  mkdirSync(dirname(path), { recursive: true });
  if (content === folder) mkdirSync(path);
  else if (content === fifo) execFileSync('mkfifo', [path]);
  else if (content.kind === 'link') symlinkSync(content.target, path);
  else writeFileSync(path, content);
}

// Bytes ----------------------------------------------------------------------

const bytes = (...values) => Buffer.from(values);
const u8 = bytes;
const u16 = (...values) => Buffer.concat(values.map((v) => bytes(v & 255, v >> 8 & 255)));
const u32 = (...values) => Buffer.concat(values.map((v) => bytes(v & 255, v >> 8 & 255, v >> 16 & 255, v >>> 24)));
const u32be = (...values) => Buffer.concat(values.map((v) => u32(v).reverse()));
const f32 = (...values) => Buffer.concat(values.map((v) => {
  const four = Buffer.alloc(4);
  four.writeFloatLE(v);
  return four;
}));
const f32be = (...values) => Buffer.concat(values.map((v) => f32(v).reverse()));
const text = (string) => Buffer.from(string, 'latin1');
const padded = (data, fill = 0) => Buffer.concat([data, Buffer.alloc(-data.length & 3, fill)]);
const junk = (length) => Buffer.from(Array.from({ length }, (_, i) => i * 73 + 41 & 255));
const dataUri = (data, type = 'application/octet-stream') => `data:${type};base64,${data.toString('base64')}`;

/** `source` with one place changed; the place must be there. */
function swap(source, from, to) {
  if (!source.includes(from)) throw new Error(`"${from}" not found`);
  return source.replace(from, () => to);
}

/** A copy with `data` written over it at `offset`. */
function over(source, offset, data) {
  const copy = Buffer.from(source);
  data.copy(copy, offset);
  return copy;
}

// glTF -----------------------------------------------------------------------

const BYTE = 5120, U8 = 5121, U16 = 5123, U32 = 5125, FLOAT = 5126;
const COMPONENTS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const PACK = { [BYTE]: u8, [U8]: u8, [U16]: u16, [U32]: u32, [FLOAT]: f32 };

const array = (type, componentType, ...values) =>
  ({ type, componentType, count: values.length / COMPONENTS[type], data: PACK[componentType](...values) });
const POSITIONS = array('VEC3', FLOAT, 0, 0, 0, 1, 0, 0, 0, 1, 0);

/** A document and its binary chunk: one view and one accessor per array, the `extra` bytes in views behind them. */
function model(arrays, json, extra = []) {
  const chunks = [...arrays.map((a) => a.data), ...extra];
  let byteOffset = 0;
  const bufferViews = chunks.map((data) => {
    const view = { buffer: 0, byteOffset, byteLength: data.length };
    byteOffset += padded(data).length;
    return view;
  });
  const accessors = arrays.map(({ type, componentType, count }, bufferView) => ({ bufferView, componentType, count, type }));
  return {
    json: {
      asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
      buffers: [{ byteLength: byteOffset }], bufferViews, accessors, ...json,
    },
    bin: Buffer.concat(chunks.map((data) => padded(data))),
  };
}

const mesh = (attributes, rest = {}) => ({ primitives: [{ attributes, ...rest }] });

/** The smallest document: one triangle. */
const document = () => model([POSITIONS], { meshes: [mesh({ POSITION: 0 })] });

/** One triangle with indices; `skinned` and `mode` make meshes that are passed through. */
function indexed(componentType, values, { mode = 4, skinned = false, targets } = {}) {
  const arrays = [POSITIONS, array('SCALAR', componentType, ...values)];
  if (!skinned) return model(arrays, { meshes: [mesh({ POSITION: 0 }, { indices: 1, mode, targets })] });
  arrays.push(array('VEC4', U8, ...Array(12).fill(0)), array('VEC4', FLOAT, ...Array(3).fill([1, 0, 0, 0]).flat()));
  return model(arrays, {
    meshes: [mesh({ POSITION: 0, JOINTS_0: 2, WEIGHTS_0: 3 }, { indices: 1, mode })],
    nodes: [{ mesh: 0, skin: 0 }, {}], skins: [{ joints: [1] }], scenes: [{ nodes: [0, 1] }],
  });
}

/** Chunks are [type, data] or [type, data, length as written]; `header` overrides what the file's header says. */
function container(chunks, header = {}) {
  const body = Buffer.concat(chunks.flatMap(([type, data, length = data.length]) => [u32(length), text(type), data]));
  const { magic = 'glTF', version = 2, length = 12 + body.length } = header;
  return Buffer.concat([text(magic), u32(version, length), body]);
}

/** JSON where the string "raw:TEXT" stands for TEXT without quotes, for numbers that JavaScript does not have. */
const stringify = (json) => JSON.stringify(json).replace(/"raw:([^"]*)"/g, '$1');
const jsonChunk = (json) => ['JSON', padded(Buffer.from(stringify(json)), 0x20)];
const binChunk = (bin) => ['BIN\0', bin];
const glb = ({ json, bin }) => container([jsonChunk(json), ...(bin ? [binChunk(bin)] : [])]);

/** A copy of the model with members set, or removed where the value is undefined, by JSON pointer. */
function changed({ json, bin }, changes) {
  const copy = structuredClone(json);
  for (const [pointer, value] of Object.entries(changes)) {
    const keys = pointer.split('/').slice(1);
    const last = keys.pop();
    const parent = keys.reduce((object, key) => object[key], copy);
    if (value === undefined) delete parent[last];
    else parent[last] = value;
  }
  return { json: copy, bin };
}

const asIs = (content) => content;
const asGlb = (made) => ({ 'model.glb': glb(made) });
const damaged = (base) => (changes) => asGlb(changed(base, changes));
const asGltf = (content) => ({ 'model.gltf': content });

/** A document whose buffer has the URI, beside a good buffer and the side files. */
function withBuffer([uri, side = {}, changes = {}]) {
  const { json } = changed(document(), { '/buffers/0/uri': uri, ...changes });
  return { 'model.gltf': stringify(json), 'ok.bin': POSITIONS.data, ...side };
}

// Images ---------------------------------------------------------------------

/** A PNG of one grey pixel, whatever its header says. */
function png({ width = 1, height = 1, depth = 8, color = 0 } = {}) {
  const pixel = bytes(0x78, 0x01, 1, 2, 0, 0xFD, 0xFF, 0, 128, 0, 0x82, 0, 0x81);
  return Buffer.concat([PNG_SIGNATURE, pngHeader(width, height, depth, color),
    pngChunk('IDAT', pixel), pngChunk('IEND', bytes())]);
}

/** A JPEG with a frame header, whose sides are given, and the header of a scan without data. */
const jpeg = (width, height) => bytes(0xFF, 0xD8, 0xFF, 0xC0, 0, 11, 8, height >> 8, height & 255, width >> 8, width & 255,
  1, 1, 0x11, 0, 0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0xFF, 0xD9);

/** The triangle with a texture. */
function textured(image) {
  return model([POSITIONS, array('VEC2', FLOAT, 0, 0, 1, 0, 0, 1)], {
    meshes: [mesh({ POSITION: 0, TEXCOORD_0: 1 }, { material: 0 })],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }], textures: [{ source: 0 }], images: [image],
  });
}

const imageBytes = (data) => asGlb(textured({ uri: dataUri(data, 'image/png') }));
const imageFile = ([uri, side = {}]) => ({ ...asGlb(textured({ uri })), 'ok.png': png(), ...side });

/** A whole PNG of black pixels, one bit each. */
const black = (side) => Buffer.concat([PNG_SIGNATURE, pngHeader(side, side, 1, 0),
  pngChunk('IDAT', deflateSync(Buffer.alloc(side * (1 + side / 8)))), pngChunk('IEND', bytes())]);

// One document with a bit of everything, and the accessors of its arrays ------

const RICH = { position: 0, normal: 1, uv: 2, index: 3, joint: 4, weight: 5, matrix: 6, time: 7, rotation: 8, offset: 9 };

const rich = model([
  POSITIONS, array('VEC3', FLOAT, 0, 0, 1, 0, 0, 1, 0, 0, 1), array('VEC2', FLOAT, 0, 0, 1, 0, 0, 1),
  array('SCALAR', U16, 0, 1, 2), array('VEC4', U8, ...Array(12).fill(0)),
  array('VEC4', FLOAT, ...Array(3).fill([1, 0, 0, 0]).flat()),
  array('MAT4', FLOAT, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
  array('SCALAR', FLOAT, 0, 1), array('VEC4', FLOAT, 0, 0, 0, 1, 0, 0, 1, 0), array('VEC3', FLOAT, 0, 0, 0, 5, 0, 0),
], {
  extensionsUsed: ['MSFT_lod', 'EXT_mesh_gpu_instancing'],
  scenes: [{ nodes: [0, 2, 3, 4, 5] }],
  nodes: [
    { mesh: 2, extensions: { MSFT_lod: { ids: [1] } } }, { mesh: 2 }, { mesh: 1, skin: 0 }, {}, { camera: 0 },
    { mesh: 0, extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: RICH.offset, ROTATION: RICH.rotation } } } },
  ],
  meshes: [
    mesh({ POSITION: RICH.position, NORMAL: RICH.normal, TEXCOORD_0: RICH.uv }, { indices: RICH.index, material: 0 }),
    mesh({ POSITION: RICH.position, JOINTS_0: RICH.joint, WEIGHTS_0: RICH.weight }, { indices: RICH.index }),
    mesh({ POSITION: RICH.position }),
  ],
  skins: [{ joints: [3], inverseBindMatrices: RICH.matrix }],
  animations: [{
    channels: [{ sampler: 0, target: { node: 3, path: 'rotation' } }],
    samplers: [{ input: RICH.time, output: RICH.rotation }],
  }],
  cameras: [{ type: 'perspective', perspective: { yfov: 1, znear: 0.1 } }],
  materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 }, baseColorFactor: [1, 1, 1, 1] } }],
  textures: [{ source: 0, sampler: 0 }], samplers: [{}], images: [{ bufferView: 10, mimeType: 'image/png' }],
}, [png()]);

const inRich = damaged(rich);
const inTriangle = damaged(document());

// GLB container --------------------------------------------------------------

const good = document();
const GOOD_JSON = jsonChunk(good.json);
const GOOD_BIN = binChunk(good.bin);
const CHUNKS = [GOOD_JSON, GOOD_BIN];
const GOOD = container(CHUNKS);
const BIN_AT = 20 + GOOD_JSON[1].length;
const file = (content) => ({ 'model.glb': content });

group('glb', 5, file, [
  ['magic-wrong', 'the magic is glTG', container(CHUNKS, { magic: 'glTG' })],
  ['version-1', 'GLB version 1', container(CHUNKS, { version: 1 }), 6],
  ['version-3', 'GLB version 3', container(CHUNKS, { version: 3 }), 6],
  ['header-only', 'nothing follows a header of 12 bytes', container([])],
  ['bin-first', 'the BIN chunk comes before the JSON chunk', container([GOOD_BIN, GOOD_JSON])],
  ['bin-only', 'there is no JSON chunk', container([GOOD_BIN])],
  ['bin-absent', 'buffer 0 has no URI and there is no BIN chunk', container([GOOD_JSON])],
  ['bin-shorter-than-buffer', 'the BIN chunk has 32 of the 36 bytes', container([GOOD_JSON, binChunk(good.bin.subarray(4))])],
  ['bin-empty', 'the BIN chunk has 0 bytes', container([GOOD_JSON, binChunk(bytes())])],
  ['two-json-chunks', 'the second chunk is JSON again', container([GOOD_JSON, GOOD_JSON, GOOD_BIN])],
  ['unknown-chunk-before-bin', 'BIN is not the second chunk', container([GOOD_JSON, ['XTRA', u32(7)], GOOD_BIN])],
  ['json-type-wrong', 'the first chunk has the type json', container([['json', GOOD_JSON[1]], GOOD_BIN])],
  ['json-chunk-empty', 'the JSON chunk has 0 bytes', container([['JSON', bytes()], GOOD_BIN])],
  ['third-chunk-wraps', 'a chunk after BIN says 2^32-4 bytes', container([...CHUNKS, ['XTRA', u32(7), 0xFFFFFFFC]])],
  ['third-chunk-header-cut', 'four stray bytes follow BIN within the length',
    Buffer.concat([container(CHUNKS, { length: GOOD.length + 4 }), u32(0)])],
]);

group('glb-length', 5, (length) => file(container(CHUNKS, { length })), [
  ['zero', 'the total length is 0', 0],
  ['12', 'the total length ends with the header', 12],
  ['in-json', 'the total length ends within the JSON', 40],
  ['after-json', 'the total length leaves out the BIN chunk', BIN_AT],
  ['in-bin', 'the total length cuts four bytes off the BIN chunk', GOOD.length - 4],
  ['one-more', 'the total length is one byte more than the file', GOOD.length + 1],
  ['2-32', 'the total length is 2^32-1', 0xFFFFFFFF],
]);

group('glb-json-length', 5, (length) => file(container([[...GOOD_JSON, length], GOOD_BIN])), [
  ['zero', 'the JSON chunk says 0 bytes', 0],
  ['unaligned', 'the JSON chunk says a length that is no multiple of 4', GOOD_JSON[1].length - 1],
  ['4-more', 'the JSON chunk reaches into the BIN chunk', GOOD_JSON[1].length + 4],
  ['wraps', 'offset and length of the JSON chunk wrap at 2^32', 0xFFFFFFF8],
]);

group('glb-bin-length', 5, (length) => file(container([GOOD_JSON, [...GOOD_BIN, length]])), [
  ['zero', 'the BIN chunk says 0 bytes', 0],
  ['unaligned', 'the BIN chunk says 35 bytes', 35],
  ['4-more', 'the BIN chunk says four bytes more than there are', 40],
  ['wraps', 'offset and length of the BIN chunk wrap at 2^32', 0xFFFFFFFC],
]);

group('glb-cut', 5, (length) => file(GOOD.subarray(0, length)), [
  ['after-magic', 'the file ends after the magic', 4],
  ['after-version', 'the file ends after the version', 8],
  ['after-header', 'the file ends after the header', 12],
  ['in-json-header', 'the file ends within the header of the JSON chunk', 16],
  ['before-json', 'the file ends before the first byte of the JSON', 20],
  ['in-json', 'the file ends within the JSON', 60],
  ['after-json', 'the file ends after the JSON', BIN_AT],
  ['in-bin-header', 'the file ends within the header of the BIN chunk', BIN_AT + 4],
  ['before-bin', 'the file ends before the first byte of the BIN chunk', BIN_AT + 8],
  ['in-bin', 'the last byte is missing', GOOD.length - 1],
]);

// JSON text ------------------------------------------------------------------

const MINIMAL = '{"asset":{"version":"2.0"},"extras":0}';
const nested = (open, close, depth, inner = '0') => open.repeat(depth) + inner + close.repeat(depth);
const extras = (value) => swap(MINIMAL, '0}', `${value}}`);

group('json', 5, asGltf, [
  ['empty', 'the file has 0 bytes', ''],
  ['cut', 'the text ends within an object', MINIMAL.slice(0, -1)],
  ['utf8-invalid', 'a string holds the byte FF', text(extras('"\xFF"'))],
  ['utf16', 'the text is UTF-16', Buffer.from(`\uFEFF${MINIMAL}`, 'utf16le')],
  ['surrogate-alone', 'an escape is half a surrogate pair', extras('"\\ud800"')],
  ['control-character', 'a string holds a raw line end', extras('"a\nb"')],
  ['trailing-text', 'words follow the document', `${MINIMAL} and more`],
  ['trailing-nul', 'words follow behind a NUL byte', `${MINIMAL}\0 and more`],
  ['comment', 'a comment precedes the document', `// glTF\n${MINIMAL}`],
  ['comma-trailing', 'an array ends with a comma', extras('[1,]')],
  ['number-1e999', 'a number is beyond a double', extras('1e999')],
  ['number-nan', 'a number is NaN', extras('NaN')],
  ['root-array', 'the document is an array', '[]'],
  ['root-null', 'the document is null', 'null'],
  ['deep-arrays', '100000 nested arrays', extras(nested('[', ']', 100000)), 7],
  ['deep-objects', '100000 nested objects', extras(nested('{"a":', '}', 100000)), 7],
  ['deep-65', 'one level more than the limit', extras(nested('[', ']', 64)), 7],
  ['deep-root', 'the document is 1000 nested arrays', nested('[', ']', 1000), 7],
]);

group('document', 5, inTriangle, [
  ['asset-missing', 'there is no asset', { '/asset': undefined }],
  ['version-number', 'the version is a number', { '/asset/version': 'raw:2.0' }],
  ['version-1', 'glTF version 1.0', { '/asset/version': '1.0' }, 6],
  ['version-3', 'glTF version 3.0', { '/asset/version': '3.0' }, 6],
  ['min-version-2-1', 'the document needs glTF 2.1', { '/asset/version': '2.1', '/asset/minVersion': '2.1' }, 6],
  ['buffers-object', 'the buffers are an object', { '/buffers': { 0: { byteLength: 36 } } }],
  ['accessors-object', 'the accessors are an object', { '/accessors': {} }],
  ['mesh-number', 'a mesh is a number', { '/meshes/0': 1 }],
  ['primitives-missing', 'a mesh has no primitives', { '/meshes/0/primitives': undefined }],
  ['attributes-missing', 'a primitive has no attributes', { '/meshes/0/primitives/0/attributes': undefined }],
  ['node-null', 'a node is null', { '/nodes/0': null }],
  ['scene-nodes-object', 'the nodes of a scene are an object', { '/scenes/0/nodes': {} }],
  ['required-unknown', 'an unknown extension is required',
    { '/extensionsUsed': ['ACME_mesh'], '/extensionsRequired': ['ACME_mesh'] }, 6],
  ['required-number', 'extensionsRequired holds a number', { '/extensionsRequired': [7] }],
]);

// References between objects ---------------------------------------------------

group('reference', 5, inTriangle, [
  ['scene-9', 'the default scene is out of range', { '/scene': 9 }],
  ['scene-negative', 'the default scene is -1', { '/scene': -1 }],
  ['scene-node-9', 'a scene lists a node out of range', { '/scenes/0/nodes': [9] }],
  ['mesh-9', 'a node names a mesh out of range', { '/nodes/0/mesh': 9 }],
  ['mesh-negative', 'a node names mesh -1', { '/nodes/0/mesh': -1 }],
  ['mesh-fraction', 'a node names mesh 0.5', { '/nodes/0/mesh': 0.5 }],
  ['mesh-2-64', 'a node names mesh 2^64', { '/nodes/0/mesh': 'raw:18446744073709551616' }],
  ['camera-9', 'a node names a camera out of range', { '/nodes/0/camera': 9 }],
  ['skin-9', 'a node names a skin out of range', { '/nodes/0/skin': 9 }],
  ['position-9', 'an attribute names an accessor out of range', { '/meshes/0/primitives/0/attributes/POSITION': 9 }],
  ['position-string', 'an attribute is a string', { '/meshes/0/primitives/0/attributes/POSITION': '0' }],
  ['indices-null', 'the indices are null', { '/meshes/0/primitives/0/indices': null }],
  ['indices-9', 'the indices name an accessor out of range', { '/meshes/0/primitives/0/indices': 9 }],
  ['material-9', 'a primitive names a material out of range', { '/meshes/0/primitives/0/material': 9 }],
  ['target-9', 'a morph target names an accessor out of range', { '/meshes/0/primitives/0/targets': [{ POSITION: 9 }] }],
  ['mode-7', 'the primitive mode is 7', { '/meshes/0/primitives/0/mode': 7 }],
  ['view-9', 'an accessor names a buffer view out of range', { '/accessors/0/bufferView': 9 }],
  ['view-negative', 'an accessor names buffer view -1', { '/accessors/0/bufferView': -1 }],
  ['buffer-9', 'a buffer view names a buffer out of range', { '/bufferViews/0/buffer': 9 }],
]);

// Buffers, views, accessors ------------------------------------------------------

group('buffer', 5, inTriangle, [
  ['length-missing', 'a buffer has no byteLength', { '/buffers/0/byteLength': undefined }],
  ['length-zero', 'a buffer has 0 bytes', { '/buffers/0/byteLength': 0 }],
  ['length-negative', 'a buffer has -36 bytes', { '/buffers/0/byteLength': -36 }],
  ['length-40', 'a buffer says more bytes than the chunk has', { '/buffers/0/byteLength': 40 }],
  ['length-2-53', 'a buffer says 2^53 bytes', { '/buffers/0/byteLength': 2 ** 53 }],
  ['length-2-64', 'a buffer says 2^64-1 bytes', { '/buffers/0/byteLength': 'raw:18446744073709551615' }],
  ['second-without-uri', 'buffer 1 has no URI', { '/buffers/1': { byteLength: 36 } }],
]);

group('view', 5, inTriangle, [
  ['length-37', 'a view ends one byte after its buffer', { '/bufferViews/0/byteLength': 37 }],
  ['length-negative', 'a view has -1 bytes', { '/bufferViews/0/byteLength': -1 }],
  ['offset-36', 'a view starts where its buffer ends', { '/bufferViews/0/byteOffset': 36 }],
  ['offset-wraps-2-32', 'offset and length of a view wrap at 2^32', { '/bufferViews/0/byteOffset': 4294967284 }],
  ['offset-wraps-2-64', 'offset and length of a view wrap at 2^64',
    { '/bufferViews/0/byteOffset': 'raw:18446744073709551604' }],
  ['stride-8', 'the stride is below the size of an element', { '/bufferViews/0/byteStride': 8 }],
  ['stride-16', 'the last element of the stride lies outside the view', { '/bufferViews/0/byteStride': 16 }],
  ['stride-2-32', 'the stride is 2^32+12', { '/bufferViews/0/byteStride': 4294967308 }],
]);

group('accessor', 5, inTriangle, [
  ['count-4', 'an accessor has one element more than its view', { '/accessors/0/count': 4 }],
  ['count-zero', 'an accessor has no elements', { '/accessors/0/count': 0 }],
  ['count-negative', 'an accessor has -3 elements', { '/accessors/0/count': -3 }],
  ['count-wraps', 'count times 12 wraps at 2^32', { '/accessors/0/count': 357913942 }],
  ['count-wraps-stride', 'count times 16 wraps at 2^32',
    { '/accessors/0/count': 268435456, '/bufferViews/0/byteStride': 16 }],
  ['count-2-53', 'an accessor with a view says 2^53 elements', { '/accessors/0/count': 2 ** 53 }],
  ['offset-12', 'the offset moves the last element out of the view', { '/accessors/0/byteOffset': 12 }],
  ['offset-negative', 'the offset is -12', { '/accessors/0/byteOffset': -12 }],
  ['offset-wraps-2-32', 'offset and size wrap at 2^32', { '/accessors/0/byteOffset': 4294967292 }],
  ['offset-wraps-2-64', 'offset and size wrap at 2^64', { '/accessors/0/byteOffset': 'raw:18446744073709551604' }],
  ['component-half', 'the component type is a half float', { '/accessors/0/componentType': 5131 }],
  ['component-int', 'the component type is a signed 32-bit integer', { '/accessors/0/componentType': 5124 }],
  ['type-vec5', 'the type is VEC5', { '/accessors/0/type': 'VEC5' }],
  ['position-vec2', 'POSITION is VEC2', { '/accessors/0/type': 'VEC2' }],
  ['position-vec4', 'POSITION is VEC4', { '/accessors/0/type': 'VEC4', '/accessors/0/count': 2 }],
  ['position-u32', 'quantized POSITION is of unsigned 32-bit integers', {
    '/accessors/0/componentType': U32,
    '/extensionsUsed': ['KHR_mesh_quantization'], '/extensionsRequired': ['KHR_mesh_quantization'],
  }],
  ['viewless-2-32', 'an accessor without a view has 2^32-1 elements',
    { '/accessors/0/bufferView': undefined, '/accessors/0/count': 4294967295 }, 7],
  ['viewless-2-22', 'an accessor without a view has 2^22+1 elements',
    { '/accessors/0/bufferView': undefined, '/accessors/0/count': 4194305 }, 7],
  ['viewless-sum', 'five accessors without views have 5 million elements together', {
    '/accessors': Array(5).fill({ componentType: FLOAT, type: 'VEC3', count: 1000000 }),
    '/meshes/0/primitives': [0, 1, 2, 3, 4].map((a) => ({ attributes: { POSITION: a } })),
  }, 7],
]);

group('accessor', 5, asGlb, [
  ['stride-255', 'the stride is odd', changed(
    model([{ ...POSITIONS, data: Buffer.alloc(524) }], { meshes: [mesh({ POSITION: 0 })] }),
    { '/bufferViews/0/byteStride': 255 })],
  ['counts-differ', 'NORMAL has fewer elements than POSITION', model(
    [POSITIONS, array('VEC3', FLOAT, 0, 0, 1, 0, 0, 1)], { meshes: [mesh({ POSITION: 0, NORMAL: 1 })] })],
  ['normal-vec2', 'NORMAL is VEC2', model(
    [POSITIONS, array('VEC2', FLOAT, 0, 1, 0, 1, 0, 1)], { meshes: [mesh({ POSITION: 0, NORMAL: 1 })] })],
  ['uv-vec3', 'TEXCOORD_0 is VEC3', model([POSITIONS], { meshes: [mesh({ POSITION: 0, TEXCOORD_0: 0 })] })],
  ['target-counts-differ', 'a morph target has fewer elements than POSITION', model(
    [POSITIONS, array('VEC3', FLOAT, 0, 0, 1)], { meshes: [mesh({ POSITION: 0 }, { targets: [{ POSITION: 1 }] })] })],
  ['positions-nan', 'all positions are NaN', model(
    [array('VEC3', FLOAT, ...Array(9).fill(NaN))], { meshes: [mesh({ POSITION: 0 })] })],
]);

// Sparse accessors -------------------------------------------------------------

/** Positions that are all in the sparse block. */
const sparse = model([array('SCALAR', U16, 0, 1, 2), POSITIONS], {
  accessors: [{
    componentType: FLOAT, type: 'VEC3', count: 3,
    sparse: { count: 3, indices: { bufferView: 0, componentType: U16 }, values: { bufferView: 1 } },
  }],
  meshes: [mesh({ POSITION: 0 })],
});
const SPARSE = '/accessors/0/sparse';

group('sparse', 5, damaged(sparse), [
  ['count-zero', 'the sparse count is 0', { [`${SPARSE}/count`]: 0 }],
  ['count-negative', 'the sparse count is -1', { [`${SPARSE}/count`]: -1 }],
  ['count-above-accessor', 'the sparse block has more elements than the accessor', { '/accessors/0/count': 2 }],
  ['count-2-32', 'the sparse count is 2^32+3', { [`${SPARSE}/count`]: 4294967299 }],
  ['indices-missing', 'there are no sparse indices', { [`${SPARSE}/indices`]: undefined }],
  ['indices-view-9', 'the view of the sparse indices is out of range', { [`${SPARSE}/indices/bufferView`]: 9 }],
  ['indices-float', 'the sparse indices are floats', { [`${SPARSE}/indices/componentType`]: FLOAT }],
  ['indices-too-long', 'the sparse indices reach outside their view', { [`${SPARSE}/indices/componentType`]: U32 }],
  ['indices-offset', 'the offset of the sparse indices lies outside their view', { [`${SPARSE}/indices/byteOffset`]: 2 }],
  ['values-view-9', 'the view of the sparse values is out of range', { [`${SPARSE}/values/bufferView`]: 9 }],
  ['values-too-long', 'the sparse values reach outside their view', { '/bufferViews/1/byteLength': 35 }],
  ['viewless-2-32', 'an accessor of 2^32-1 elements has data for three', { '/accessors/0/count': 4294967295 }, 7],
]);

group('sparse', 5, (indices) => asGlb({ json: sparse.json, bin: over(sparse.bin, 0, u16(...indices)) }), [
  ['not-ascending', 'the sparse indices descend', [2, 1, 0]],
  ['twice', 'a sparse index stands twice', [0, 1, 1]],
  ['out-of-range', 'a sparse index is out of range', [0, 1, 3]],
]);

// Indices ------------------------------------------------------------------------

group('index', 5, asGlb, [
  ['u8-3', 'a u8 index is one too large', indexed(U8, [0, 1, 3])],
  ['u16-3', 'a u16 index is one too large', indexed(U16, [0, 1, 3])],
  ['u32-3', 'a u32 index is one too large', indexed(U32, [0, 1, 3])],
  ['u8-255', 'a u8 index restarts the primitive', indexed(U8, [0, 1, 2, 255, 0, 1])],
  ['u16-65535', 'a u16 index restarts the primitive', indexed(U16, [0, 1, 2, 65535, 0, 1, 2], { mode: 5 })],
  ['u32-2-31', 'a u32 index is 2^31', indexed(U32, [0, 1, 0x80000000])],
  ['u32-2-32', 'a u32 index is 2^32-1', indexed(U32, [0, 1, 0xFFFFFFFF])],
  ['skinned', 'an index of a skinned mesh is out of range', indexed(U16, [0, 1, 300], { skinned: true })],
  ['skinned-3', 'an index of a skinned mesh is one too large', indexed(U16, [0, 1, 3], { skinned: true })],
  ['points', 'an index of points is out of range', indexed(U16, [0, 1, 300], { mode: 0 })],
  ['lines', 'an index of lines is out of range', indexed(U8, [0, 200], { mode: 1 })],
  ['strip', 'an index of a triangle strip is out of range', indexed(U16, [0, 1, 2, 300], { mode: 5 })],
  ['morphed', 'an index of a mesh with morph targets is out of range', indexed(U16, [0, 1, 300], { targets: [{ POSITION: 0 }] })],
  ['float', 'the indices are floats', indexed(FLOAT, [0, 1, 2])],
  ['signed', 'the indices are signed', indexed(BYTE, [0, 1, 2])],
  ['vec3', 'the indices are VEC3', changed(indexed(U16, [0, 1, 2]), { '/accessors/1/type': 'VEC3', '/accessors/1/count': 1 })],
  ['float-skinned', 'the indices of a skinned mesh are floats', indexed(FLOAT, [0, 1, 2], { skinned: true })],
]);

/** Largest value of the type as an index where there are that many vertices, most of them without data. */
function restart(componentType, largest) {
  const made = indexed(componentType, [0, 1, largest]);
  return changed({ json: { ...made.json, bufferViews: [...made.json.bufferViews, { buffer: 0, byteLength: 36 }] }, bin: made.bin }, {
    '/accessors/0/bufferView': undefined, '/accessors/0/count': largest + 1,
    '/accessors/0/sparse': { count: 1, indices: { bufferView: 2, componentType: U8 }, values: { bufferView: 0 } },
  });
}

group('index', 5, asGlb, [
  ['restart-u8', 'index 255 of 256 vertices is the value that restarts', restart(U8, 255)],
  ['restart-u16', 'index 65535 of 65536 vertices is the value that restarts', restart(U16, 65535)],
]);

// Node hierarchy -------------------------------------------------------------------

const chain = (length, last) => Array.from({ length }, (_, i) => ({ children: [i + 1 < length ? i + 1 : last] }));

group('nodes', 5, inTriangle, [
  ['own-child', 'a node is its own child', { '/nodes/0/children': [0] }],
  ['two-cycle', 'two nodes are children of each other', { '/nodes': [{ mesh: 0, children: [1] }, { children: [0] }] }],
  ['cycle-unreachable', 'a cycle of 100 nodes that no scene reaches',
    { '/nodes': [...chain(100, 0), { mesh: 0 }], '/scenes/0/nodes': [100] }],
  ['two-parents', 'a node has two parents',
    { '/nodes': [{ mesh: 0, children: [2] }, { children: [2] }, {}], '/scenes/0/nodes': [0, 1] }],
  ['child-twice', 'a node lists a child twice', { '/nodes': [{ mesh: 0, children: [1, 1] }, {}] }],
  ['explosion', '41 nodes each list the next twice, 2^40 paths', {
    '/nodes': Array.from({ length: 41 }, (_, i) => (i < 40 ? { children: [i + 1, i + 1] } : { mesh: 0 })),
  }],
  ['root-is-child', 'a scene lists a node that is a child',
    { '/nodes': [{ mesh: 0, children: [1] }, {}], '/scenes/0/nodes': [0, 1] }, 0],
  ['root-twice', 'a scene lists a node twice', { '/scenes/0/nodes': [0, 0] }],
  ['child-9', 'a child is out of range', { '/nodes/0/children': [9] }],
  ['matrix-15', 'a matrix has 15 numbers', { '/nodes/0/matrix': Array(15).fill(1) }],
  ['rotation-zero', 'a rotation is four zeros', { '/nodes/0/rotation': [0, 0, 0, 0] }],
  ['scale-strings', 'a scale is of strings', { '/nodes/0/scale': ['1', '1', '1'] }],
]);

group('transform', 5, inTriangle, [
  ['translation-1e39', 'a translation is beyond 32-bit numbers', { '/nodes/0/translation': [1e39, 0, 0] }],
  ['scale-1e300-twice', 'the product of two scales is infinite',
    { '/nodes': [{ scale: [1e300, 1e300, 1e300], children: [1] }, { mesh: 0, scale: [1e300, 1e300, 1e300] }] }],
  ['matrix-1e308', 'a matrix is beyond 32-bit numbers', { '/nodes/0/matrix': Array(16).fill(1e308) }],
  ['scale-zero', 'a scale is zero', { '/nodes/0/scale': [0, 0, 0] }, 0],
]);

// MSFT_lod, EXT_mesh_gpu_instancing ----------------------------------------------

group('lod', 5, (lod) => inRich({ '/nodes/0/extensions/MSFT_lod': lod }), [
  ['id-99', 'a level is a node out of range', { ids: [99] }],
  ['id-2-32', 'a level is node 2^32+1', { ids: [4294967297] }],
  ['id-float', 'a level is node 1.5', { ids: [1.5] }],
  ['id-self', 'a node is its own level', { ids: [0] }],
  ['id-twice', 'a level stands twice', { ids: [1, 1] }],
  ['id-without-mesh', 'a level that is not the last one has no mesh', { ids: [3, 1] }],
  ['ids-number', 'the ids are a number', { ids: 1 }],
]);
group('lod', 5, inRich, [
  ['cycle', 'two nodes are levels of each other', { '/nodes/1/extensions': { MSFT_lod: { ids: [0] } } }],
]);

const groupLevel = { '/nodes/0/extensions/MSFT_lod': { ids: [3] } };
const coverage = (value) => ({ '/nodes/0/extras': { MSFT_screencoverage: value } });
group('lod', 0, inRich, [
  ['group', 'a level has no mesh, but a node below it has', { ...groupLevel, '/nodes/6': { mesh: 2 }, '/nodes/3': { children: [6] } }],
  ['group-around', 'a level of a node lies above it', { ...groupLevel, '/nodes/3': { children: [0] }, '/scenes/0/nodes': [2, 3, 4, 5] }],
  ['coverage-number', 'the thresholds are a number', coverage(0.5)],
  ['coverage-strings', 'the thresholds are strings', coverage(['0.5', '0'])],
  ['coverage-ascending', 'the thresholds ascend', coverage([0.1, 0.5])],
  ['coverage-1e39', 'a threshold is beyond 32-bit numbers', coverage([1e39, -1e39])],
]);

// Cells of the baked format -------------------------------------------------------

const level = (lod, cells) => ({
  jalousie: {
    format: 3, lod, triangles: 3, vertices: 9, errorObject: 0, diagonal: 1, coverage: 0,
    ...Object.fromEntries(['toOriginal', 'fromOriginal', 'twoSided'].map((key) => [key, { max: 0, mean: 0 }])),
    ...Object.fromEntries(['normalDegrees', 'uv'].map((key) => [key, { mean: 0, p95: 0 }])), cells,
  },
});
const cells = () => ({ triangles: [[1, 0, 2], [0, 3, 0]] });
/** A chain of two levels, each with two primitives of three triangles in three cells. */
const divided = model([array('VEC3', FLOAT, ...Array.from({ length: 27 }, (_, i) => i * i % 7)),
  array('SCALAR', U16, 0, 1, 2, 3, 4, 5, 6, 7, 8)], {
  extensionsUsed: ['MSFT_lod'],
  nodes: [{ mesh: 0, extensions: { MSFT_lod: { ids: [1] } } }, { mesh: 1 }],
  meshes: [0, 1].map((lod) => ({
    primitives: [{ attributes: { POSITION: 0 }, indices: 1 }, { attributes: { POSITION: 0 }, indices: 1 }],
    extras: level(lod, cells()),
  })),
});
const ofLevel = (lod) => `/meshes/${lod}/extras/jalousie/cells`;

group('cells', 5, damaged(divided), [
  ['valid', 'a chain in cells', {}, 0],
  ['null', 'there is no table', { [ofLevel(0)]: null }],
  ['number', 'the table is a number', { [ofLevel(0)]: 3 }],
  ['list-missing', 'the table has no list', { [ofLevel(0)]: { ends: [3, 3] } }],
  ['list-object', 'the list is an object', { [ofLevel(0)]: { triangles: { 0: [1, 2] } } }],
  ['primitive-missing', 'one primitive has no cells', { [ofLevel(0)]: { triangles: [[1, 0, 2]] } }],
  ['primitive-number', 'the cells of a primitive are a number', { [`${ofLevel(0)}/triangles/1`]: 3 }],
  ['primitive-other-count', 'primitives have different numbers of cells', { [`${ofLevel(1)}/triangles/1`]: [0, 3] }],
  ['sum-too-large', 'the cells have more triangles than the primitive', { [`${ofLevel(0)}/triangles/1/2`]: 1 }],
  ['sum-too-small', 'the cells have fewer triangles than the primitive', { [`${ofLevel(1)}/triangles/0/0`]: 0 }],
  ['sum-wraps', 'the sum is right modulo 2^32',
    { [`${ofLevel(0)}/triangles`]: [[2147483647, 2147483647, 5], [0, 3, 0]] }],
  ['negative', 'a number of triangles is negative', { [`${ofLevel(0)}/triangles/0`]: [4, -1, 0] }],
  ['fraction', 'a number of triangles is 1.5', { [`${ofLevel(0)}/triangles/0`]: [1.5, 0, 1.5] }],
  ['string', 'a number of triangles is a string', { [`${ofLevel(0)}/triangles/0/0`]: '1' }],
  ['huge', 'a number of triangles is 1e300', { [`${ofLevel(0)}/triangles/0/0`]: 1e300 }],
  ['level-missing', 'the coarse level has none', { [ofLevel(1)]: undefined }],
  ['finest-missing', 'LOD 0 has none', { [ofLevel(0)]: undefined }],
  ['levels-differ', 'the levels have different numbers of cells',
    { [ofLevel(1)]: { triangles: [[1, 2], [0, 3]] } }],
  ['points', 'points have triangles in cells', { '/meshes/0/primitives/1/mode': 0 }],
  ['older-format', 'a file of format 2 has a key of a later format', { ...Object.fromEntries(
    [0, 1].map((lod) => [`/meshes/${lod}/extras/jalousie/format`, 2])), [ofLevel(0)]: 7 }, 0],
]);

// Groups of cells of the baked format ----------------------------------------------

/** The chain in cells with format 6 and two groups of cells. */
const levelled = structuredClone(divided);
[{ groups: [0, 0, 1], max: [0.1, 0.2], mean: [0.05, 0.1] }, { producers: [2, 1] }].forEach((cellLevels, lod) => {
  Object.assign(levelled.json.meshes[lod].extras.jalousie, { format: 6, cellLevels });
});
const groupsOf = (lod) => `/meshes/${lod}/extras/jalousie/cellLevels`;

group('cell-levels', 5, damaged(levelled), [
  ['valid', 'a chain with groups of cells', {}, 0],
  ['number', 'the table is a number', { [groupsOf(0)]: 3 }],
  ['empty', 'the table has neither producers nor groups', { [groupsOf(1)]: { kind: 1 } }],
  ['groups-object', 'the groups are an object', { [`${groupsOf(0)}/groups`]: { 0: [1, 2] } }],
  ['group-2', 'a cell is in a group that is not there', { [`${groupsOf(0)}/groups/2`]: 2 }],
  ['negative', 'the number of a group is negative', { [`${groupsOf(0)}/groups/2`]: -1 }],
  ['fraction', 'the number of a group is 0.5', { [`${groupsOf(0)}/groups/2`]: 0.5 }],
  ['group-unused', 'a group has no cell', { [`${groupsOf(0)}/groups/2`]: 0 }],
  ['cell-uncounted', 'a filled cell is in no group', { [`${groupsOf(1)}/producers`]: [2, 0] }],
  ['too-many', 'there are more cells than the cells', { [`${groupsOf(1)}/producers`]: [2, 2147483647] }],
  ['max-string', 'an error is a string', { [`${groupsOf(0)}/max/0`]: '0.1' }],
  ['max-1e300', 'an error is no float', { [`${groupsOf(0)}/max/0`]: 1e300 }],
  ['mean-above', 'a mean is larger than its maximum', { [`${groupsOf(0)}/mean/0`]: 0.15 }],
  ['lengths', 'there are fewer means than maxima', { [`${groupsOf(0)}/mean`]: [0.05] }],
  ['producers-finest', 'LOD 0 has producers', { [`${groupsOf(0)}/producers`]: [3] }],
  ['groups-coarsest', 'the last level has groups',
    { [groupsOf(1)]: { producers: [2, 1], groups: [0, 0, 0], max: [0.2], mean: [0.1] } }],
  ['producers-other-count', 'a level has fewer producers than groups before', { [`${groupsOf(1)}/producers`]: [3] }],
  ['level-missing', 'the coarse level has none', { [groupsOf(1)]: undefined }],
  ['older-format', 'a file of format 5 has a key of a later format', { ...Object.fromEntries(
    [0, 1].map((lod) => [`/meshes/${lod}/extras/jalousie/format`, 5])), [groupsOf(0)]: 7 }, 0],
]);

// Groups of back faces of the baked format -----------------------------------------

/** The chain in cells with format 5 and groups. */
const grouped = structuredClone(divided);
for (const lod of [0, 1]) {
  Object.assign(grouped.json.meshes[lod].extras.jalousie,
    { format: 5, faces: { kind: 'clusters', trees: [[1, 0, 1, 1], 0] } });
}
const facesOf = (lod) => `/meshes/${lod}/extras/jalousie/faces`;

group('faces', 5, damaged(grouped), [
  ['valid', 'a chain with groups of triangles', {}, 0],
  ['number', 'the table is a number', { [facesOf(0)]: 3 }],
  ['kind', 'the kind is unknown', { [`${facesOf(0)}/kind`]: 'spheres' }],
  ['kind-number', 'the kind is a number', { [`${facesOf(0)}/kind`]: 1 }],
  ['trees-object', 'the trees are an object', { [`${facesOf(0)}/trees`]: { 0: [3] } }],
  ['tree-missing', 'one primitive has no tree', { [`${facesOf(0)}/trees`]: [[1, 0, 1, 1]] }],
  ['tree-number', 'a tree is a number', { [`${facesOf(0)}/trees/1`]: 3 }],
  ['tree-null', 'there is a null beside the trees', { [`${facesOf(0)}/trees/2`]: null }],
  ['empty-list', 'the table is an empty list', { [facesOf(0)]: [] }],
  ['negative', 'a number of triangles is negative', { [`${facesOf(0)}/trees/0`]: [4, -1] }],
  ['huge', 'a number of triangles is 1e300', { [`${facesOf(0)}/trees/0`]: [1e300] }],
  ['incomplete', 'a node has one part', { [`${facesOf(1)}/trees/0`]: [1, 0, 2] }],
  ['nodes-alone', 'a tree has nodes and no group', { [`${facesOf(1)}/trees/0`]: [0, 0, 0, 0] }],
  ['sum-too-large', 'the groups have more triangles than the primitive', { [`${facesOf(0)}/trees/1`]: [1, 3] }],
  ['sum-wraps', 'the sum is right modulo 2^32', { [`${facesOf(0)}/trees/0`]: [1, 2147483647, 2147483647, 4] }],
  ['across-cells', 'a group has triangles of two cells', { [`${facesOf(0)}/trees/0`]: [3] }],
  ['tree-across-cells', 'a tree has groups of two cells', { [`${facesOf(0)}/trees/0`]: [0, 1, 2] }],
  ['older-format', 'a file of format 4 has a key of a later format', { ...Object.fromEntries(
    [0, 1].map((lod) => [`/meshes/${lod}/extras/jalousie/format`, 4])), [facesOf(0)]: 7 }, 0],
]);

// Occluders -----------------------------------------------------------------------

const OCCLUDERS = '/meshes/0/extras/jalousie_occluders';
const tetrahedron = (changes = {}) => [{
  vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], levels: 2,
  ...changes,
}];
const withOccluder = (changes) => ({ [OCCLUDERS]: tetrahedron(changes) });

group('occluders', 5, damaged(divided), [
  ['valid', 'a tetrahedron in the mesh', withOccluder(), 0],
  ['number', 'the list is a number', { [OCCLUDERS]: 3 }],
  ['entry-string', 'an occluder is a string', { [OCCLUDERS]: ['box'] }],
  ['vertex-1e39', 'a coordinate is beyond 32-bit numbers', withOccluder({ vertices: [[0, 0, 0], [1e39, 0, 0], [0, 1, 0], [0, 0, 1]] })],
  ['corner-99', 'a face has a vertex that does not exist', withOccluder({ faces: [[0, 2, 1], [0, 1, 99], [0, 3, 2], [1, 2, 3]] })],
  ['corner-2-32', 'a corner is right modulo 2^32', withOccluder({ faces: [[4294967296, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] })],
  ['open', 'a face is missing', withOccluder({ faces: [[0, 2, 1], [0, 1, 3], [0, 3, 2]] })],
  ['inside-out', 'the faces look inwards', withOccluder({ faces: [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]] })],
  ['vertices-many', 'there are 33 vertices', withOccluder({ vertices: Array(33).fill([0, 0, 0]) })],
  ['levels-negative', 'the number of levels is negative', withOccluder({ levels: -1 })],
  ['sides-string', 'bothSides is a string', withOccluder({ bothSides: 'yes' })],
  ['outside', 'the occluder reaches out of the mesh', withOccluder({ vertices: [[0, 0, 0], [9, 0, 0], [0, 1, 0], [0, 0, 1]] })],
]);

// Rooms ---------------------------------------------------------------------------

const twoRooms = (changes = {}, portal = {}) => ({ '/scenes/0/extras': { jalousie_rooms: {
  rooms: [{ name: 'hall', floor: 0, ceiling: 3, outline: [[[0, 0], [4, 0], [4, 4], [0, 4]]], ...changes },
    { floor: -1, ceiling: 2, outline: [[[4, 0], [9, 0], [9, 4], [4, 4]]] }],
  portals: [{ rooms: [0, 1], corners: [[4, 0, 1], [4, 2, 1], [4, 2, 2], [4, 0, 2]], ...portal }],
} } });

group('rooms', 5, damaged(divided), [
  ['valid', 'two rooms and a door', twoRooms(), 0],
  ['number', 'the plan is a number', { '/scenes/0/extras': { jalousie_rooms: 3 } }],
  ['flat', 'a room has no height', twoRooms({ ceiling: 0 })],
  ['floor-1e300', 'a height is 1e300', twoRooms({ floor: -1e300 })],
  ['outline-open', 'an outline has two points', twoRooms({ outline: [[[0, 0], [4, 0]]] })],
  ['portal-room-9', 'a portal leads to a room that does not exist', twoRooms({}, { rooms: [0, 9] })],
  ['portal-room-2-32', 'a room is right modulo 2^32', twoRooms({}, { rooms: [0, 4294967297] })],
  ['portal-bent', 'a portal is not flat', twoRooms({}, { corners: [[4, 0, 1], [4.5, 2, 1], [4, 2, 2], [4, 0, 2]] })],
  ['portal-outside', 'a portal is not in the border', twoRooms({}, { corners: [[4, 0, 1], [4, 9, 1], [4, 9, 2], [4, 0, 2]] })],
]);

const INSTANCING = '/nodes/5/extensions/EXT_mesh_gpu_instancing';
const viewless = (count) => ({ componentType: FLOAT, type: 'VEC3', count });

group('instancing', 5, (attributes) => inRich({ [`${INSTANCING}/attributes`]: attributes }), [
  ['accessor-99', 'an attribute is an accessor out of range', { TRANSLATION: 99 }],
  ['accessor-string', 'an attribute is a string', { TRANSLATION: `${RICH.offset}` }],
  ['custom-99', 'an attribute of an application is an accessor out of range', { TRANSLATION: RICH.offset, _ID: 99 }],
  ['counts-differ', 'the attributes have different counts', { TRANSLATION: RICH.offset, SCALE: RICH.position }],
  ['translation-vec4', 'TRANSLATION is VEC4', { TRANSLATION: RICH.rotation }],
  ['rotation-vec3', 'ROTATION is VEC3', { ROTATION: RICH.offset }],
  ['attributes-missing', 'there are no attributes', undefined],
]);
group('instancing', 5, inRich, [
  ['quaternion-zero', 'a rotation is four zeros',
    { [`/accessors/${RICH.rotation}/bufferView`]: undefined, '/animations': undefined }],
  ['2-24', 'a node has 2^24+1 instances without data',
    { '/accessors/10': viewless(16777217), [`${INSTANCING}/attributes`]: { TRANSLATION: 10 } }, 7],
  ['sum-2-24', 'five nodes have 20 million instances together', {
    '/accessors/10': viewless(4000000), [`${INSTANCING}/attributes`]: { TRANSLATION: 10 },
    '/nodes/5/children': [6, 7, 8, 9],
    ...Object.fromEntries([6, 7, 8, 9].map((n) => [`/nodes/${n}`,
      { mesh: 0, extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 10 } } } }])),
  }, 7],
]);

/** The instances' translations hold `values`. */
const translated = (...values) => asGlb({ json: rich.json,
  bin: over(rich.bin, rich.json.bufferViews[RICH.offset].byteOffset, f32(...values)) });
group('instancing', 5, asIs, [
  ['translation-infinite', 'the translation of an instance is infinite', translated(0, 0, 0, Infinity, 0, 0)],
  ['translation-nan', 'the translation of an instance is NaN', translated(NaN, 0, 0, 5, 0, 0)],
]);

// EXT_meshopt_compression ----------------------------------------------------------

/** Vertex codec, version 0, up to 16 vertices: every group of 16 deltas is stored raw. */
function meshoptVertices(data, stride) {
  const columns = Array.from({ length: stride }, (_, k) => {
    let last = data[k];
    return [3, ...Array.from({ length: 16 }, (_, i) => {
      const value = data[i * stride + k] ?? last;
      const delta = value - last << 24 >> 24;
      last = value;
      return (delta << 1 ^ delta >> 31) & 255;
    })];
  });
  return Buffer.concat([bytes(0xA0), ...columns.map((c) => bytes(...c)), Buffer.alloc(32 - stride), data.subarray(0, stride)]);
}

/** One view of `length` bytes that unfolds from `stream`; `rest` are members of its extension. */
function compressed(arrays, which, stream, length, rest) {
  const extension = 'EXT_meshopt_compression';
  const made = model(arrays, {
    extensionsUsed: [extension], extensionsRequired: [extension],
    meshes: [arrays.length > 1 ? mesh({ POSITION: 0 }, { indices: 1 }) : mesh({ POSITION: 0 })],
  }, [stream]);
  const source = made.json.bufferViews.pop();
  return changed(made, {
    '/buffers/1': { byteLength: length, extensions: { [extension]: { fallback: true } } },
    [`/bufferViews/${which}`]: {
      buffer: 1, byteLength: length, extensions: { [extension]: { ...source, count: 3, mode: 'ATTRIBUTES', ...rest } },
    },
  });
}

const STREAM = meshoptVertices(POSITIONS.data, 12);
const vertices = (stream = STREAM, length = 36, rest = {}) => compressed([POSITIONS], 0, stream, length, { byteStride: 12, ...rest });
const indices = (stream, rest) => compressed([POSITIONS, array('SCALAR', U16, 0, 1, 2)], 1, stream, 6,
  { byteStride: 2, mode: 'INDICES', ...rest });
const SEQUENCE = bytes(0xD1, 0, 4, 4, 0, 0, 0, 0);  // 0, 1, 2 as deltas, and the tail
const [VIEW, OPTIONS] = ['/bufferViews/0', '/bufferViews/0/extensions/EXT_meshopt_compression'];

group('meshopt', 5, damaged(vertices()), [
  ['mode-unknown', 'the mode is POINTS', { [`${OPTIONS}/mode`]: 'POINTS' }],
  ['stride-6', 'the stride is no multiple of 4', { [`${OPTIONS}/byteStride`]: 6, [`${OPTIONS}/count`]: 6 }],
  ['count-4', 'count times stride is not the length of the view', { [`${OPTIONS}/count`]: 4 }],
  ['count-negative', 'the count is -3', { [`${OPTIONS}/count`]: -3 }],
  ['count-wraps', 'count times stride wraps at 2^64', { [`${OPTIONS}/count`]: 'raw:4611686018427387907' }],
  ['count-wraps-2-32', 'count times stride wraps at 2^32',
    { [`${OPTIONS}/byteStride`]: 4, [`${OPTIONS}/count`]: 1073741833 }],
  ['buffer-9', 'the buffer of the stream is out of range', { [`${OPTIONS}/buffer`]: 9 }],
  ['offset-outside', 'the stream starts after its buffer', { [`${OPTIONS}/byteOffset`]: 5000 }],
  ['length-outside', 'the stream ends after its buffer', { [`${OPTIONS}/byteLength`]: 5000 }],
  ['length-1-outside', 'the stream ends one byte after its buffer', { [`${OPTIONS}/byteLength`]: padded(STREAM).length + 1 }],
  ['length-wraps', 'offset and length of the stream wrap at 2^64', { [`${OPTIONS}/byteLength`]: 'raw:18446744073709551604' }],
  ['truncated', 'the stream lacks its last 8 bytes', { [`${OPTIONS}/byteLength`]: STREAM.length - 8 }],
  ['filter-unknown', 'the filter is GAUSS', { [`${OPTIONS}/filter`]: 'GAUSS' }],
  ['filter-octahedral-12', 'the octahedral filter has stride 12', { [`${OPTIONS}/filter`]: 'OCTAHEDRAL' }],
  ['fallback-read', 'an uncompressed view reads the fallback buffer', { [`${VIEW}/extensions`]: undefined }],
]);

group('meshopt', 5, asGlb, [
  ['random-body', 'random bytes follow a good first byte', vertices(Buffer.concat([bytes(0xA0), junk(60)]))],
  ['bomb', 'the view is 100 times as large as the stream', vertices(STREAM, 24000, { count: 2000 })],
  ['bomb-1-gib', 'a stream of 237 bytes says 1 GiB', vertices(STREAM, 1073741820, { count: 89478485 })],
  ['index-out-of-range', 'a decoded index is 9', indices(bytes(0xD1, 0, 4, 32, 0, 0, 0, 0))],
  ['index-truncated', 'a stream of indices ends early', indices(SEQUENCE.subarray(0, 6))],
  ['index-stride-3', 'the stride of indices is 3', indices(SEQUENCE, { byteStride: 3, count: 2 })],
  ['index-filter', 'indices have a filter', indices(SEQUENCE, { filter: 'EXPONENTIAL' })],
  ['triangles-random-body', 'random bytes follow a good first byte',
    indices(Buffer.concat([bytes(0xE1), junk(39)]), { mode: 'TRIANGLES' })],
]);

// KHR_draco_mesh_compression -------------------------------------------------------

/** Two triangles with four vertices, as tests/support/draco_document.cpp encodes them. */
const DRACO = Buffer.from(
  'RFJBQ08CAgEBAAAABAIEAgAAAR//ARH/ARH/ARH/ARH/AREF/wAAAAAAAQAAAgAAAwAAAQAJAwAHAgEBCQMAAwMBAwkCAAwCAQIC' +
  'BAEFAQEEBAEACQEBAQEACwMBEB8BMAMAKIIAAEB5AAFMLgAAlAMAAAAA/z8AAAAAAAAAAAAAreXkvAAAgD8OAAMBAA0TARATARAB' +
  'IAMA5JAA+Of6AwAF6w8A/w8AAP8HAAAMAQEBAAMDATABEAMAKIIsAAAAAAD/DwAAAAAAAAAAAAAAAIA/DAEBAQAJAwEgARATARAD' +
  'AOyPAAAB/woBAAAAAP8AAAABAQEAAgMBQAEABgAAAAADAAAA', 'base64');

/** A document with the stream in its only view. */
function draco(stream = DRACO) {
  const extension = 'KHR_draco_mesh_compression';
  const made = model([], {
    extensionsUsed: [extension], extensionsRequired: [extension],
    meshes: [mesh({ POSITION: 0, NORMAL: 1 },
      { indices: 2, extensions: { [extension]: { bufferView: 0, attributes: { POSITION: 7, NORMAL: 3 } } } })],
  }, [stream]);
  const vertices = { componentType: FLOAT, count: 4, type: 'VEC3' };
  made.json.accessors = [{ ...vertices, min: [0, 0, 0], max: [1, 1, 1] }, vertices, { componentType: U16, count: 6, type: 'SCALAR' }];
  return made;
}
const DRACO_OPTIONS = '/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression';

group('draco', 5, damaged(draco()), [
  ['no-object', 'the extension is a number', { [DRACO_OPTIONS]: 7 }],
  ['view-9', 'the view of the stream is out of range', { [`${DRACO_OPTIONS}/bufferView`]: 9 }],
  ['view-outside', 'the view of the stream ends after its buffer', { '/bufferViews/0/byteLength': 5000 }],
  ['attributes-none', 'the stream has no attributes', { [`${DRACO_OPTIONS}/attributes`]: {} }],
  ['attribute-unknown', 'an attribute is missing in the stream', { [`${DRACO_OPTIONS}/attributes/NORMAL`]: 99 }],
  ['attribute-type', 'an attribute has three components, its accessor two', { '/accessors/1/type': 'VEC2' }],
  ['indices-none', 'the primitive has no indices', { '/meshes/0/primitives/0/indices': undefined }],
  ['indices-9', 'the accessor of the indices is out of range', { '/meshes/0/primitives/0/indices': 9 }],
  ['strip', 'the primitive is a strip', { '/meshes/0/primitives/0/mode': 5 }, 6],
  ['count-5', 'the accessors have a vertex more than the stream', { '/accessors/0/count': 5, '/accessors/1/count': 5 }],
  ['triangles-3', 'the accessor has a triangle more than the stream', { '/accessors/2/count': 9 }],
  ['count-2-27', 'the accessors have 2^27 vertices', { '/accessors/0/count': 134217728, '/accessors/1/count': 134217728 }, 7],
]);

group('draco', 5, asGlb, [
  ['magic', 'the stream begins with another word', draco(over(DRACO, 0, text('WACKO')))],
  ['version-1', 'the stream has version 1.2', draco(over(DRACO, 5, bytes(1))), 6],
  ['cut-in-half', 'the stream ends in the middle', draco(DRACO.subarray(0, DRACO.length >> 1))],
  ['random-body', 'random bytes follow a good header', draco(Buffer.concat([DRACO.subarray(0, 14), junk(200)]))],
  ['faces-2-31', 'the stream says 2^31 triangles', draco(Buffer.concat([DRACO.subarray(0, 13), bytes(255, 255, 255, 255, 7), junk(90)]))],
]);

// Skins, animations, cameras, materials ------------------------------------------

group('skin', 5, inRich, [
  ['joint-99', 'a joint is a node out of range', { '/skins/0/joints': [99] }],
  ['skeleton-99', 'the skeleton is a node out of range', { '/skins/0/skeleton': 99 }],
  ['matrices-99', 'the inverse bind matrices are an accessor out of range', { '/skins/0/inverseBindMatrices': 99 }],
  ['matrices-too-few', 'there are more joints than inverse bind matrices', { '/skins/0/joints': [3, 4] }],
  ['matrices-vec3', 'the inverse bind matrices are VEC3', { '/skins/0/inverseBindMatrices': RICH.position }],
  ['joints-float', 'JOINTS_0 is of floats', { '/meshes/1/primitives/0/attributes/JOINTS_0': RICH.weight }],
]);

group('animation', 5, inRich, [
  ['sampler-9', 'a channel names a sampler out of range', { '/animations/0/channels/0/sampler': 9 }],
  ['sampler-missing', 'a channel names no sampler', { '/animations/0/channels/0/sampler': undefined }],
  ['node-99', 'a channel moves a node out of range', { '/animations/0/channels/0/target/node': 99 }],
  ['input-99', 'the times are an accessor out of range', { '/animations/0/samplers/0/input': 99 }],
  ['input-vec3', 'the times are VEC3', { '/animations/0/samplers/0/input': RICH.offset }],
  ['output-99', 'the values are an accessor out of range', { '/animations/0/samplers/0/output': 99 }],
  ['output-too-short', 'there are fewer values than times', { [`/accessors/${RICH.rotation}/count`]: 1,
    [`${INSTANCING}/attributes/ROTATION`]: undefined }],
  ['channels-object', 'the channels are an object', { '/animations/0/channels': {} }],
]);

group('camera', 5, inRich, [
  ['type-unknown', 'the type is fisheye', { '/cameras/0/type': 'fisheye' }],
  ['lens-missing', 'a perspective camera has no lens', { '/cameras/0/perspective': undefined }],
  ['yfov-string', 'yfov is a string', { '/cameras/0/perspective/yfov': '1' }],
]);

group('camera', 5, inRich, [
  ['yfov-pi', 'the view is half a turn high', { '/cameras/0/perspective/yfov': 3.2 }],
  ['yfov-zero', 'the view is flat', { '/cameras/0/perspective/yfov': 0 }],
  ['yfov-tiny', 'the view is 1e-30 high', { '/cameras/0/perspective/yfov': 1e-30 }, 0],
  ['znear-zero', 'the near plane goes through the eye', { '/cameras/0/perspective/znear': 0 }],
  ['znear-huge', 'the near plane is beyond 32-bit numbers', { '/cameras/0/perspective/znear': 1e300 }],
  ['zfar-before-znear', 'the far plane lies before the near plane', { '/cameras/0/perspective/zfar': 0.01 }],
  ['xmag-zero', 'an orthographic view has no width',
    { '/cameras/0': { type: 'orthographic', orthographic: { xmag: 0, ymag: 1, znear: 0, zfar: 1 } } }],
]);

const PBR = '/materials/0/pbrMetallicRoughness';
group('material', 5, inRich, [
  ['base-color-texture-9', 'a texture is out of range', { [`${PBR}/baseColorTexture/index`]: 9 }],
  ['base-color-texture-missing', 'a texture has no index', { [`${PBR}/baseColorTexture`]: {} }],
  ['metallic-texture-9', 'a texture is out of range', { [`${PBR}/metallicRoughnessTexture`]: { index: 9 } }],
  ['normal-texture-9', 'a texture is out of range', { '/materials/0/normalTexture': { index: 9 } }],
  ['extension-texture-9', 'a texture of a known extension is out of range',
    { '/extensionsUsed/2': 'KHR_materials_clearcoat',
      '/materials/0/extensions': { KHR_materials_clearcoat: { clearcoatTexture: { index: 9 } } } }],
  ['base-color-3', 'baseColorFactor has three numbers', { [`${PBR}/baseColorFactor`]: [1, 1, 1] }],
  ['base-color-strings', 'baseColorFactor is of strings', { [`${PBR}/baseColorFactor`]: ['1', '1', '1', '1'] }],
  ['emissive-4', 'emissiveFactor has four numbers', { '/materials/0/emissiveFactor': [0, 0, 0, 0] }],
  ['texture-source-9', 'a texture names an image out of range', { '/textures/0/source': 9 }],
  ['texture-sampler-9', 'a texture names a sampler out of range', { '/textures/0/sampler': 9 }],
  ['image-view-99', 'an image names a buffer view out of range', { '/images/0/bufferView': 99 }],
  ['image-without-source', 'an image has neither URI nor view', { '/images/0': {} }],
  ['image-two-sources', 'an image has a URI and a view', { '/images/0/uri': dataUri(png(), 'image/png') }],
  ['alpha-cutoff-1e300', 'alphaCutoff is beyond 32-bit numbers',
    { '/materials/0/alphaMode': 'MASK', '/materials/0/alphaCutoff': 1e300 }, 0],
  ['alpha-cutoff-negative', 'alphaCutoff is negative', { '/materials/0/alphaMode': 'MASK', '/materials/0/alphaCutoff': -1 }, 0],
  ['base-color-1e308', 'baseColorFactor is beyond 32-bit numbers', { [`${PBR}/baseColorFactor`]: [1e308, -1e308, 1, 1] }, 0],
  ['base-color-nan', 'baseColorFactor is NaN', { [`${PBR}/baseColorFactor`]: ['raw:NaN', 1, 1, 1] }],
]);

// Images ---------------------------------------------------------------------------

const PNG = png();
group('image', 5, imageBytes, [
  ['png-signature-only', 'the PNG ends after its signature', PNG.subarray(0, 8)],
  ['png-header-cut', 'the PNG ends within its header', PNG.subarray(0, 20)],
  ['png-header-absent', 'the PNG has no IHDR', Buffer.concat([PNG.subarray(0, 8), PNG.subarray(33)])],
  ['png-width-zero', 'the PNG is 0 pixels wide', png({ width: 0 })],
  ['png-depth-3', 'the PNG has 3 bits per sample', png({ depth: 3 })],
  ['png-16385-wide', 'the PNG says one pixel more than the limit', png({ width: 16385 }), 7],
  ['png-30000', 'the PNG says 30000 x 30000 pixels', png({ width: 30000, height: 30000 }), 7],
  ['png-2-31', 'the PNG says 2^31-1 pixels a side', png({ width: 0x7FFFFFFF, height: 0x7FFFFFFF }), 7],
  ['jpeg-without-frame', 'the JPEG has no frame header', bytes(0xFF, 0xD8, 0xFF, 0xD9)],
  ['jpeg-cut', 'the JPEG ends within its frame header', jpeg(1, 1).subarray(0, 7)],
  ['jpeg-width-zero', 'the JPEG is 0 pixels wide', jpeg(0, 1)],
  ['jpeg-65535', 'the JPEG says 65535 x 65535 pixels', jpeg(65535, 65535), 7],
  ['gif', 'the image is a GIF', Buffer.concat([text('GIF89a'), u16(1, 1), bytes(0, 0, 0, 0x3B)]), 6],
  ['bmp', 'the image is a BMP', Buffer.concat([text('BM'), u32(58, 0, 54, 40, 1, 1, 0x180001), Buffer.alloc(28)]), 6],
  ['psd', 'the image is a PSD', Buffer.concat([text('8BPS'), bytes(0, 1), Buffer.alloc(20, 1)]), 6],
  ['hdr', 'the image is a Radiance HDR', text('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\0\0\0\0'), 6],
  ['webp', 'the image is an empty WebP', Buffer.concat([text('RIFF'), u32(12), text('WEBPVP8 '), u32(0)])],
  ['svg', 'the image is an SVG', text('<svg xmlns="http://www.w3.org/2000/svg"/>'), 6],
]);

group('image-uri', 5, imageFile, [
  ['bad-base64', 'the data of an image is no base64', ['data:image/png;base64,?!?!']],
  ['empty', 'the URI of an image is empty', ['']],
  ['absent', 'the file of an image is absent', ['absent.png'], 3],
  ['folder', 'the file of an image is a folder', ['folder.png', { 'folder.png': folder }], 4],
  ['fifo', 'the file of an image is a FIFO', ['pipe.png', { 'pipe.png': fifo }], 4],
  ['parent', 'the URI of an image leaves the folder', ['../outside/bait.png'], 6],
  ['link-outside', 'a link to an image leaves the folder', ['link.png', { 'link.png': link('../outside/bait.png') }], 6],
  ['https', 'the URI of an image has a scheme', ['https://example.org/bait.png'], 6],
]);

// Files that a document names ------------------------------------------------------

group('uri', 6, withBuffer, [
  ['parent', 'the URI leaves the folder', ['../outside/bait.bin']],
  ['parent-percent', 'the dots are percent-encoded', ['%2e%2e/outside/bait.bin']],
  ['slash-percent', 'the slash is percent-encoded', ['..%2Foutside%2Fbait.bin']],
  ['parent-after-folder', 'the URI enters a folder and leaves two', ['sub/../../outside/bait.bin', { sub: folder }]],
  ['parent-only', 'the URI is the parent folder', ['..']],
  ['parent-absent', 'the URI leaves the folder to a file that is absent', ['../outside/absent.bin']],
  ['absolute', 'the URI is an absolute path', ['/etc/passwd']],
  ['network-path', 'the URI has a host without a scheme', ['//example.org/bait.bin']],
  ['file', 'the scheme is file', ['file:///etc/passwd']],
  ['file-relative', 'the scheme is file, the path relative', ['file:ok.bin']],
  ['http', 'the scheme is http', ['http://127.0.0.1:9/bait.bin']],
  ['https', 'the scheme is https', ['https://example.org/bait.bin']],
  ['pipe-scheme', 'the scheme is pipe', ['pipe:ok.bin']],
  ['drive', 'the URI starts with a drive letter', ['C:/ok.bin']],
  ['link-file', 'a link leads to a file outside', ['link.bin', { 'link.bin': link('../outside/bait.bin') }]],
  ['link-folder', 'a link leads to the folder outside', ['link/bait.bin', { link: link('../outside') }]],
  ['link-parent', 'a link leads to the parent folder', ['up/outside/bait.bin', { up: link('..') }]],
  ['link-absolute', 'an absolute link leads to a file outside', ['link.bin', { 'link.bin': link(join(out, 'outside/bait.bin')) }]],
  ['link-twice', 'a link leads to a link to a file outside',
    ['a.bin', { 'a.bin': link('b.bin'), 'b.bin': link('../outside/bait.bin') }]],
  ['absent', 'the file is absent', ['absent.bin'], 3],
  ['absent-folder', 'the folder of the file is absent', ['absent/ok.bin'], 3],
  ['file-as-folder', 'a file is used as a folder', ['ok.bin/ok.bin'], 3],
  ['link-dangling', 'a link leads to nothing', ['link.bin', { 'link.bin': link('absent.bin') }], 3],
  ['link-loop', 'two links lead to each other', ['a.bin', { 'a.bin': link('b.bin'), 'b.bin': link('a.bin') }], 4],
  ['percent-twice', 'the dots are percent-encoded twice', ['%252e%252e/outside/bait.bin'], 3],
  ['backslashes', 'the URI has backslashes, which are part of a name', ['..\\outside\\bait.bin'], 3],
  ['shell-pipe', 'the URI is a shell command', ['|cat ok.bin'], 3],
  ['shell-substitution', 'the URI is a command substitution', ['$(echo ok.bin)'], 3],
  ['newline', 'a line end follows the name', ['ok.bin\n'], 3],
  ['folder', 'the file is a folder', ['sub', { sub: folder }], 4],
  ['dot', 'the URI is the folder of the document', ['.'], 4],
  ['fifo', 'the file is a FIFO', ['pipe', { pipe: fifo }], 4],
  ['empty', 'the URI is empty', [''], 5],
  ['nul', 'a NUL byte cuts the name', ['ok.bin\0.png'], 5],
  ['nul-percent', 'a percent-encoded NUL byte cuts the name', ['ok.bin%00.png'], 5],
  ['too-short', 'the file is shorter than byteLength', ['short.bin', { 'short.bin': POSITIONS.data.subarray(1) }], 5],
  ['number', 'the URI is a number', [7], 5],
]);

const ENCODED = POSITIONS.data.toString('base64');
group('data-uri', 5, (uri) => withBuffer([uri]), [
  ['no-base64', 'there is no base64 marker', `data:application/octet-stream,${ENCODED}`],
  ['empty', 'the data is empty', 'data:application/octet-stream;base64,'],
  ['alphabet', 'a character is not in the alphabet', `data:application/octet-stream;base64,${swap(ENCODED, 'A', '#')}`],
  ['length', 'one character is left over', `data:application/octet-stream;base64,${ENCODED}A`],
  ['padding-inside', 'padding stands within the data', `data:application/octet-stream;base64,AA==${ENCODED}`],
  ['too-short', 'the data is shorter than byteLength', `data:application/octet-stream;base64,${ENCODED.slice(4)}`],
]);

// The input itself -------------------------------------------------------------------

group('input', 4, asIs, [
  ['folder-glb', 'the input is a folder without files', { 'model.glb': folder }, 3],
  ['folder-ply', 'the input is a folder without files', { 'model.ply': folder }, 3],
  ['folder-obj', 'the input is a folder without files', { 'model.obj': folder }, 3],
  ['fifo-glb', 'the input is a FIFO', { 'model.glb': fifo }],
  ['fifo-ply', 'the input is a FIFO', { 'model.ply': fifo }],
  ['fifo-obj', 'the input is a FIFO', { 'model.obj': fifo }],
  ['device-glb', 'the input is a link to /dev/zero', { 'model.glb': link('/dev/zero') }],
  ['device-ply', 'the input is a link to /dev/zero', { 'model.ply': link('/dev/zero') }],
  ['link-loop', 'the input is a link to itself', { 'model.glb': link('model.glb') }],
  ['link-dangling', 'the input is a link to nothing', { 'model.glb': link('absent.glb') }, 3],
  ['absent', 'the input does not exist', { 'model.glb': absent }, 3],
  ['empty-glb', 'the input has 0 bytes', { 'model.glb': '' }, 5],
  ['empty-ply', 'the input has 0 bytes', { 'model.ply': '' }, 5],
  ['elf', 'a program is named .glb', { 'model.glb': Buffer.concat([text('\x7FELF\x02\x01\x01'), Buffer.alloc(57)]) }, 5],
  ['zip', 'a ZIP archive is named .glb', { 'model.glb': Buffer.concat([text('PK\x05\x06'), Buffer.alloc(18)]) }, 5],
  ['png-as-glb', 'a PNG is named .glb', { 'model.glb': PNG }, 5],
  ['png-as-ply', 'a PNG is named .ply', { 'model.ply': PNG }, 5],
  ['png-as-obj', 'a PNG is named .obj', { 'model.obj': PNG }, 5],
  ['glb-as-ply', 'a GLB is named .ply', { 'model.ply': GOOD }, 5],
  ['extension-stl', 'an STL file has no facets', { 'model.stl': text('solid\nendsolid\n') }, 6],
  ['extension-none', 'the file name has no extension', { model: GOOD }, 6],
]);

// PLY ----------------------------------------------------------------------------------

const PLY = `ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
`;
const LIST = 'property list uchar int vertex_indices';
const ply = (content) => ({ 'model.ply': content });

/** The same triangle in binary; `header` overrides lines, `body` the data. */
function binaryPly(edits = [], body = Buffer.concat([POSITIONS.data, u8(3), u32(0, 1, 2)]), order = 'little') {
  const header = PLY.slice(0, PLY.indexOf('0 0 0'));
  const edited = [['ascii', `binary_${order}_endian`], ...edits].reduce((t, [from, to]) => swap(t, from, to), header);
  return Buffer.concat([text(edited), body]);
}

group('ply', 5, (edits) => ply(edits.reduce((content, [from, to]) => swap(content, from, to), PLY)), [
  ['magic-wrong', 'the magic is plx', [['ply', 'plx']]],
  ['format-missing', 'there is no format', [['format ascii 1.0\n', '']]],
  ['format-unknown', 'the format is unknown', [['ascii', 'binary_middle_endian']]],
  ['keyword-unknown', 'a header line is unknown', [['element face', 'elephant face']]],
  ['type-unknown', 'a property has the type half', [['float x', 'half x']]],
  ['property-first', 'a property precedes the elements', [['element vertex 3\n', '']]],
  ['property-twice', 'the property x stands twice', [['float y', 'float x']]],
  ['z-missing', 'the vertices have no z', [['float z', 'float w']]],
  ['list-count-float', 'the count of a list is a float', [['list uchar', 'list float']]],
  ['count-negative', 'an element has the count -3', [['vertex 3', 'vertex -3']]],
  ['count-fraction', 'an element has the count 3.5', [['vertex 3', 'vertex 3.5']]],
  ['count-200-million', 'there are fewer vertices than the header says', [['vertex 3', 'vertex 200000000']]],
  ['count-4', 'there is one vertex less than the header says', [['vertex 3', 'vertex 4']]],
  ['count-2-28', 'there are 2^28+1 vertices', [['vertex 3', 'vertex 268435457']], 7],
  ['count-2-32', 'the count of vertices is 2^32+3', [['vertex 3', 'vertex 4294967299']], 7],
  ['count-2-64', 'the count of vertices is 2^64+3', [['vertex 3', 'vertex 18446744073709551619']], 7],
  ['faces-2-31', 'there are 2^31-1 faces', [['face 1', 'face 2147483647']], 7],
  ['vertices-none', 'the count of vertices is 0', [['vertex 3', 'vertex 0'], ['0 0 0\n1 0 0\n0 1 0\n', '']]],
  ['vertices-absent', 'the element of vertices has another name', [['element vertex', 'element corner']]],
  ['x-nan', 'a vertex is NaN', [['1 0 0', 'nan 0 0']]],
  ['x-infinite', 'a vertex is infinite', [['1 0 0', 'inf 0 0']]],
  ['index-3', 'a face has an index out of range', [['3 0 1 2', '3 0 1 3']]],
  ['index-negative', 'a face has a negative index', [['3 0 1 2', '3 0 1 -1']]],
  ['index-fraction', 'a face has the index 1.5', [['3 0 1 2', '3 0 1 1.5']]],
  ['corners-negative', 'a face has -3 corners', [[LIST, LIST.replace('uchar', 'int')], ['3 0 1 2', '-3 0 1 2']]],
  ['corners-5000', 'a face has 5000 corners', [[LIST, LIST.replace('uchar', 'int')],
    ['3 0 1 2', `5000${' 0 1 2 1'.repeat(1250)}`]]],
  ['list-2-31', 'an unknown list says 2^31-1 values', [[LIST, `${LIST}\nproperty list int int flags`],
    ['3 0 1 2', '3 0 1 2 2147483647 0']]],
  ['list-200-million', 'an unknown element of lists has a huge count',
    [['end_header', 'element junk 200000000\nproperty list uchar int a\nend_header']]],
  ['nul', 'NUL bytes stand in place of a vertex', [['1 0 0', '\0\0\0\0\0']]],
]);

group('ply', 5, ply, [
  ['end-header-missing', 'the header does not end', PLY.slice(0, PLY.indexOf('end_header'))],
  ['faces-absent', 'the file is a cloud of points',
    swap(swap(PLY, `element face 1\n${LIST}\n`, ''), '3 0 1 2\n', ''), 6],
  ['header-5000-lines', 'the header has 5000 comments', swap(PLY, 'element', `${'comment\n'.repeat(5000)}element`), 7],
  ['properties-300', 'a vertex has 300 more properties', swap(swap(PLY, 'float z\n',
    `float z\n${Array.from({ length: 300 }, (_, i) => `property list uchar int p${i}\n`).join('')}`),
  '0 0 0\n1 0 0\n0 1 0', ['0 0 0', '1 0 0', '0 1 0'].map((xyz) => xyz + ' 0'.repeat(300)).join('\n')), 7],
  ['hang-vertices', '2^31-1 vertices without properties', 'ply\nformat ascii 1.0\nelement vertex 2147483647\nend_header\n', 7],
  ['hang-below-limit', '268 million vertices without properties',
    'ply\nformat ascii 1.0\nelement vertex 268000000\nelement face 268000000\nend_header\n'],
  ['binary-cut-in-vertices', 'the file ends within a vertex', binaryPly().subarray(0, -20)],
  ['binary-cut-in-face', 'the last byte is missing', binaryPly().subarray(0, -1)],
  ['binary-list-255', 'a face says 255 corners', binaryPly([], Buffer.concat([POSITIONS.data, u8(255), u32(0, 1, 2)]))],
  ['binary-list-negative', 'a face says -1 corners',
    binaryPly([['uchar', 'int']], Buffer.concat([POSITIONS.data, u32(-1, 0, 1, 2)]))],
  ['binary-list-2-32', 'an unknown list says 2^32-1 doubles', binaryPly([[LIST, `${LIST}\nproperty list uint double a`]],
    Buffer.concat([POSITIONS.data, u8(3), u32(0, 1, 2, -1)]))],
  ['binary-nan', 'a vertex is NaN', binaryPly([], Buffer.concat([f32(NaN), POSITIONS.data.subarray(4), u8(3), u32(0, 1, 2)]))],
  ['binary-index-nan', 'a face has the index NaN',
    binaryPly([['uchar int', 'uchar float']], Buffer.concat([POSITIONS.data, u8(3), f32(0, NaN, 2)]))],
]);

// OBJ ----------------------------------------------------------------------------------

const OBJ = `v 0 0 0
v 1 0 0
v 0 1 0
vn 0 0 1
vt 0 0
f 1/1/1 2/1/1 3/1/1
`;
const FACE = 'f 1/1/1 2/1/1 3/1/1\n';
const obj = (content) => ({ 'model.obj': content });

group('obj', 5, ([from, to]) => obj(swap(OBJ, from, to)), [
  ['index-zero', 'a face has the index 0', [FACE, 'f 0 1 2\n']],
  ['index-4', 'a face has an index out of range', [FACE, 'f 1 2 4\n']],
  ['index-negative-4', 'a relative index is out of range', [FACE, 'f -4 -2 -1\n']],
  ['index-wraps', 'a face has the index 2^32+3', [FACE, 'f 1 2 4294967299\n']],
  ['normal-2', 'a face has a normal out of range', [FACE, 'f 1//1 2//1 3//2\n']],
  ['uv-2', 'a face has a texture coordinate out of range', [FACE, 'f 1/1 2/1 3/2\n']],
  ['face-relative-first', 'a face with relative indices precedes the vertices', ['v 0 0 0\n', 'f -3 -2 -1\nv 0 0 0\n']],
  ['face-two-corners', 'the only face has two corners', [FACE, 'f 1 2\n'], 6],
  ['faces-absent', 'the file is a cloud of points', [FACE, ''], 6],
  ['x-nan', 'a vertex is NaN', ['v 1 0 0', 'v nan 0 0']],
  ['x-infinite', 'a vertex is infinite', ['v 1 0 0', 'v inf 0 0']],
  ['normal-nan', 'a normal is NaN', ['vn 0 0 1', 'vn nan nan nan']],
  ['uv-infinite', 'a texture coordinate is infinite', ['vt 0 0', 'vt inf 0']],
  ['x-2-mb', 'a vertex is a number of two million digits', ['v 1 0 0', `v ${'9'.repeat(2000000)} 0 0`]],
  ['index-2-mb', 'a face has an index of two million digits', [FACE, `f 1 2 ${'3'.repeat(2000000)}\n`]],
  ['tag-counts', 'a subdivision tag, which is passed over, says 2^31-1 values of each kind',
    [FACE, `t x 2147483647/2147483647/2147483647\n${FACE}`], 0],
  ['tag-negative', 'a subdivision tag, which is passed over, says -1 values of each kind', [FACE, `t x -1/-1/-1\n${FACE}`], 0],
]);

group('obj', 5, obj, [
  ['faces-only', 'there are no vertices', 'f 1 2 3\n'],
  ['junk', 'the file is random bytes', junk(4096)],
  ['nul-in-face', 'a NUL byte stands within the face', swap(OBJ, FACE, 'f 1 2\0 3\n')],
]);

const MATERIAL = 'newmtl bait\nKd 1 0 0\n';
const withLibrary = (name, side = {}) => ({ 'model.obj': `mtllib ${name}\nusemtl bait\n${OBJ}`, ...side });
group('obj-library', 0, asIs, [
  ['absent', 'the material library is absent, which is no error', withLibrary('absent.mtl')],
  ['parent', 'the material library leaves the folder and is ignored', withLibrary('../outside/bait.mtl')],
  ['link', 'the material library is a link that leaves the folder and is ignored',
    withLibrary('link.mtl', { 'link.mtl': link('../outside/bait.mtl') })],
  ['fifo', 'the material library is a FIFO and is ignored', withLibrary('pipe.mtl', { 'pipe.mtl': fifo })],
]);

// Small files that ask the runtime for much memory ---------------------------------------

/** A material for each picture. */
function pictures(list) {
  const made = model([POSITIONS], {
    meshes: [mesh({ POSITION: 0 }, { material: 0 })],
    materials: list.map((_, index) => ({ pbrMetallicRoughness: { baseColorTexture: { index } } })),
    textures: list.map((_, source) => ({ source })),
    images: list.map((data) => ({ uri: dataUri(data, 'image/png') })),
  });
  return asGlb(made);
}

/** Cameras that all follow the same keys. */
function cameras(count, keys) {
  const times = Buffer.concat(Array.from({ length: keys }, (_, i) => f32(i / 30)));
  const made = model([POSITIONS, { type: 'SCALAR', componentType: FLOAT, count: keys, data: times }], {
    meshes: [mesh({ POSITION: 0 })],
    cameras: [{ type: 'perspective', perspective: { yfov: 1, znear: 0.1 } }],
    nodes: [{ mesh: 0 }, ...Array(count).fill({ camera: 0 })],
    scenes: [{ nodes: Array.from({ length: count + 1 }, (_, i) => i) }],
    animations: [{
      samplers: [{ input: 1, output: 2 }],
      channels: Array.from({ length: count }, (_, i) => ({ sampler: 0, target: { node: i + 1, path: 'translation' } })),
    }],
  });
  made.json.accessors.push(viewless(keys));
  return asGlb(made);
}

group('memory', 0, asIs, [
  ['textures', '200 pictures of one pixel stand in an array with one of 4096 x 4096',
    pictures([black(4096), ...Array(200).fill(png())])],
  ['instances', 'four nodes have 16 million instances of a triangle together, without data', inTriangle({
    '/accessors/1': viewless(4194304),
    '/nodes': Array(4).fill({ mesh: 0, extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 1 } } } }),
    '/scenes/0/nodes': [0, 1, 2, 3], '/extensionsUsed': ['EXT_mesh_gpu_instancing'] })],
  ['cameras', 'a thousand cameras share 100000 keys', cameras(1000, 100000)],
]);

// Odd, but valid -------------------------------------------------------------------------

const withData = changed(document(), { '/buffers/0/uri': dataUri(POSITIONS.data) }).json;
const polygon = Array.from({ length: 300 }, (_, i) => [Math.cos(i / 300 * 2 * Math.PI), Math.sin(i / 300 * 2 * Math.PI)]);

group('valid', 0, asIs, [
  ['everything', 'skin, animation, camera, texture, instances and levels', asGlb(rich)],
  ['meshopt', 'a view unfolds from a stream', asGlb(vertices())],
  ['draco', 'a primitive unfolds from a stream', asGlb(draco())],
  ['data-uri-longer', 'a data URI is longer than byteLength', withBuffer([dataUri(Buffer.concat([POSITIONS.data, u32(1, 2)]))])],
  ['glb-trailing-bytes', 'bytes follow the declared length', file(Buffer.concat([GOOD, junk(64)]))],
  ['glb-without-bin', 'the buffer is a data URI and there is no BIN chunk', asGlb({ json: withData })],
  ['glb-unknown-chunk', 'an unknown chunk follows BIN', file(container([...CHUNKS, ['XTRA', u32(7)]]))],
  ['scene-absent', 'no scene is named: the first one counts', inTriangle({ '/scene': undefined })],
  ['scenes-absent', 'there are nodes and no scenes', inTriangle({ '/scene': undefined, '/scenes': undefined })],
  ['scene-empty', 'the scene has no nodes', inTriangle({ '/scenes/0/nodes': undefined })],
  ['triangles-none', 'the only primitive has points', inTriangle({ '/meshes/0/primitives/0/mode': 0 })],
  ['animation-one-key', 'an animation has one key', inRich({
    '/accessors/10': { bufferView: RICH.time, componentType: FLOAT, type: 'SCALAR', count: 1 },
    '/accessors/11': { bufferView: RICH.rotation, componentType: FLOAT, type: 'VEC4', count: 1 },
    '/animations/0/samplers/0': { input: 10, output: 11 }, '/animations/0/channels/0/target/node': 4 })],
  ['extension-unknown', 'an unknown extension is used but not required', inTriangle({ '/extensionsUsed': ['ACME_mesh'] })],
  ['sparse-without-view', 'all positions are in the sparse block', asGlb(sparse)],
  ['name-with-space', 'the file name has a percent-encoded space',
    withBuffer(['my%20data.bin', { 'my data.bin': POSITIONS.data }])],
  ['link-inside', 'a link leads to a file of the same folder', withBuffer(['link.bin', { 'link.bin': link('ok.bin') }])],
  ['name-utf8', 'file and mesh have names beyond ASCII',
    withBuffer(['dreieck-△-三角.bin', { 'dreieck-△-三角.bin': POSITIONS.data }, { '/meshes/0/name': 'Dreieck △ 三角' }])],
  ['obj-crlf-relative', 'lines end with CR LF, the indices are relative',
    obj('v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf -3 -2 -1\r\n')],
  ['obj-300-corners', 'a face has 300 corners',
    obj(`${polygon.map(([x, y]) => `v ${x.toFixed(4)} ${y.toFixed(4)} 0\n`).join('')}f ${polygon.map((_, i) => i + 1).join(' ')}\n`)],
  ['ply-unknown-parts', 'unknown elements, properties and lists stand around the mesh', ply(`ply
format ascii 1.0
element camera 1
property list uchar float matrix
element vertex 3
property float x
property float y
property float z
property list int int groups
property double quality
element face 1
property uchar flags
${LIST}
end_header
2 1 1
0 0 0 0 0.5
1 0 0 2 7 8 0.5
0 1 0 1 9 0.5
255 3 0 1 2
`)],
  ['ply-big-endian', 'the data is big-endian',
    ply(binaryPly([], Buffer.concat([f32be(0, 0, 0, 1, 0, 0, 0, 1, 0), u8(3), u32be(0, 1, 2)]), 'big'))],
]);

// Writing --------------------------------------------------------------------------------

const names = cases.map(({ name }) => name);
const twice = names.filter((name, i) => names.indexOf(name) !== i);
if (twice.length > 0) throw new Error(`two cases are named ${twice.join(', ')}`);

const bait = { 'bait.bin': POSITIONS.data, 'bait.mtl': MATERIAL, 'bait.png': png() };
for (const { name, files: content } of [{ name: 'outside', files: bait }, ...cases]) {
  rmSync(join(out, name), { recursive: true, force: true });
  mkdirSync(join(out, name), { recursive: true });
  for (const [path, bytesOrKind] of Object.entries(content)) {
    if (bytesOrKind !== absent) write(join(out, name, path), bytesOrKind);
  }
}
const reasons = reasonsOf(cases);
const index = cases.map(({ name, files: content, code, about }) =>
  ({ name, input: `${name}/${Object.keys(content)[0]}`, code, reason: reasons.get(name) ?? null,
    runtime: runtimeOf(name, code, reasons), about }));
writeFileSync(join(out, 'index.json'), `[\n${index.map((entry) => `  ${JSON.stringify(entry)}`).join(',\n')}\n]\n`);
console.log(`${cases.length} cases, ${cases.filter(({ code }) => code !== 0).length} of them broken`);

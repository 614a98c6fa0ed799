// Writes a city of closed blocks as OBJ: towers with ledges, columns and roof houses, on one slab. Every box is closed and
// single-sided. Usage: node bench/closed_city.mjs OUT.obj
import { writeFileSync } from 'node:fs';

if (process.argv.length !== 3) {
  console.error('Usage: node bench/closed_city.mjs OUT.obj');
  process.exit(2);
}

const lines = ['# a city of closed boxes'];
let vertices = 0;

/** Appends a closed box, its faces counter-clockwise from outside. */
function box(low, high) {
  for (let k = 0; k < 8; ++k)
    lines.push(`v ${[0, 1, 2].map((axis) => ((k >> axis) & 1 ? high : low)[axis].toFixed(3)).join(' ')}`);
  for (const quad of [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
    lines.push(`f ${quad.map((corner) => vertices + corner + 1).join(' ')}`);
  vertices += 8;
}

// Numbers of a linear congruence: the same city in every run.
let state = 12345;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
}

function tower(x, z) {
  const width = 8 + 6 * random();
  const depth = 8 + 6 * random();
  const floors = 4 + Math.floor(16 * random() * random());
  const height = 3 * floors;
  box([x - width / 2, 0, z - depth / 2], [x + width / 2, height, z + depth / 2]);
  box([x - width / 5, height, z - depth / 5], [x + width / 5, height + 3, z + depth / 5]);
  for (let floor = 1; floor < floors; ++floor) {
    for (let k = 0; k < 4; ++k) {
      const at = (k + 0.5) / 4 - 0.5;
      const y = 3 * floor;
      for (const side of [-1, 1]) {
        const px = x + (side * width) / 2;
        const pz = z + (side * depth) / 2;
        box([x + at * width - 0.7, y, pz - 0.3], [x + at * width + 0.7, y + 1.6, pz + 0.3]);
        box([px - 0.3, y, z + at * depth - 0.7], [px + 0.3, y + 1.6, z + at * depth + 0.7]);
      }
    }
  }
}

box([-130, -1, -130], [130, 0, 130]);
for (let row = -5; row <= 5; ++row)
  for (let column = -5; column <= 5; ++column) tower(22 * column + 2 * random(), 22 * row + 2 * random());
writeFileSync(process.argv[2], `${lines.join('\n')}\n`);

// Writes the table of docs/occlusion_queries.md from the reports of scripts/reproduce --queries.
//   node scripts/queries.mjs REPORTS PAGE.md
import { existsSync, readFileSync, writeFileSync } from 'node:fs';

const [reports, page] = process.argv.slice(2);
if (!page) {
  console.error('usage: node scripts/queries.mjs REPORTS PAGE.md');
  process.exit(2);
}
const SCENES = [
  ['queries-thesis-5001', 'thesis-5001: 5001 bunnies in a dense cube'],
  ['queries-thesis-10001-moving', 'thesis-10001, half of the objects moving'],
  ['queries-ground', '4000 bunnies of random size on a ground plane, the camera among them'],
  ['queries-city', 'candela_city, along a street'],
  ['queries-field', 'cornfield_crossing, along a field'],
];
const HEAD = ['configuration', 'drawn / visible', 'triangles', 'queries', 'boxes', 'waits', 'round trips', 'state changes',
  'draw calls', 'CPU ms', 'frame / `frustum`', 'frame / `hiz`', 'wrong pixels'];

const whole = (value) => (value == null ? '-' : Math.round(value).toLocaleString('en'));
const short = (value) => (value == null ? '-' : value.toFixed(2));

function row(c, hiz) {
  const q = (key) => c.queries?.[key]?.median;
  const ms = q('query_decision_ns');
  return [`\`${c.name}\``, short(c.drawn_per_visible?.median), whole(c.triangles.median), whole(q('queries')),
    whole(q('query_boxes')), whole(q('query_waits')), whole(q('query_round_trips')), whole(q('query_switches')),
    whole(c.draws.median), ms == null ? '-' : (ms / 1e6).toFixed(2), short(c.frame_ratio.median),
    short(c.frame_ms.median / hiz.frame_ms.median), whole(c.lost?.pixels_most)];
}

function section([folder, title]) {
  const file = `${reports}/${folder}/summary.json`;
  if (!existsSync(file)) return '';
  const summary = JSON.parse(readFileSync(file, 'utf8'));
  const hiz = summary.configurations.find((c) => c.name === 'hiz');
  const rows = [HEAD, HEAD.map(() => '---'), ...summary.configurations.map((c) => row(c, hiz))];
  const frames = `${summary.frames.count} frames, ${whole(summary.objects)} objects, ${summary.width}x${summary.height}`;
  return `### ${title}\n\n${frames}, ${summary.renderer}.\n\n${rows.map((r) => `| ${r.join(' | ')} |`).join('\n')}\n`;
}

const [before, rest] = readFileSync(page, 'utf8').split('<!-- table -->\n');
const after = rest.split('<!-- end of table -->\n')[1];
const text = SCENES.map(section).filter(Boolean).join('\n');
writeFileSync(page, `${before}<!-- table -->\n\n${text}\n<!-- end of table -->\n${after}`);

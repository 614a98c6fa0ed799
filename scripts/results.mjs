// Writes results.md, its curves and its pictures from the reports of scripts/reproduce.
//   node scripts/results.mjs REPORTS DOCS
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

const [reports, docs] = process.argv.slice(2);
if (!docs) {
  console.error('usage: node scripts/results.mjs REPORTS DOCS');
  process.exit(2);
}
const echarts = createRequire(import.meta.url)(
  fileURLToPath(new URL('../assets/fetched/echarts/echarts.min.js', import.meta.url)));

const COLORS = ['#000000', '#E69F00', '#56B4E9', '#009E73', '#0072B2', '#D55E00', '#CC79A7'];
const DASHES = ['solid', [7, 3], 'solid', [2, 3], 'solid', [10, 3, 2, 3], [5, 2]];

const summaryOf = (name) => JSON.parse(readFileSync(`${reports}/${name}/summary.json`, 'utf8'));
const configuration = (summary, name) => summary.configurations.find((c) => c.name === name);

/// Rows of frames.csv as objects; the names here hold no commas.
function framesOf(name) {
  const [head, ...lines] = readFileSync(`${reports}/${name}/frames.csv`, 'utf8').trim().split('\n');
  const keys = head.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((value, i) => [keys[i], value])));
}

function count(value) {
  if (value >= 1e7) return `${(value / 1e6).toFixed(0)} M`;
  if (value >= 1e6) return `${(value / 1e6).toFixed(2)} M`;
  return value >= 1e4 ? `${(value / 1e3).toFixed(0)} k` : String(Math.round(value));
}
const table = (head, rows) =>
  [head, head.map(() => '---'), ...rows].map((cells) => `| ${cells.join(' | ')} |`).join('\n');

function draw(file, option) {
  const chart = echarts.init(null, null, { renderer: 'svg', ssr: true, width: 900, height: 380 });
  const text = { color: '#333', fontSize: 11, fontFamily: 'DejaVu Sans, Arial, sans-serif' };
  const axis = (given) => ({ nameLocation: 'middle', nameTextStyle: text,
    splitLine: { lineStyle: { color: '#ddd' } }, ...given, axisLabel: { ...text, ...given.axisLabel } });
  chart.setOption({ animation: false, backgroundColor: '#fff', color: COLORS,
    grid: { left: 70, right: 20, top: 60, bottom: 50 }, legend: { textStyle: text, itemWidth: 26, itemGap: 24, top: 5 },
    ...option, xAxis: axis(option.xAxis), yAxis: axis(option.yAxis) });
  writeFileSync(`${docs}/images/${file}`, chart.renderToSVGString());
  chart.dispose();
}

function drawPath(scene) {
  const rows = framesOf(`${scene}-path`);
  const names = [...new Set(rows.map((row) => row.configuration))];
  draw(`results-${scene}.svg`, {
    xAxis: { type: 'value', name: 'frame: around (0-899), towards (900-1199), inside (1200-1799)', nameGap: 30, max: 1800 },
    yAxis: { type: 'log', name: 'triangles', nameGap: 50, axisLabel: { formatter: count } },
    series: names.map((name, i) => ({ name, type: 'line', symbol: 'none', lineStyle: { type: DASHES[i], width: 2 },
      data: rows.filter((row) => row.configuration === name).map((row) => [+row.frame, +row.triangles]) })),
  });
  return { rows, names };
}

function pathTable({ rows, names }) {
  const mean = (name, from, to) => {
    const values = rows.filter((r) => r.configuration === name && +r.frame >= from && +r.frame < to).map((r) => +r.triangles);
    return values.reduce((sum, v) => sum + v, 0) / values.length;
  };
  return table(['mean triangles', 'around', 'towards', 'inside', 'whole path / frustum'], names.map((name) => [`\`${name}\``,
    count(mean(name, 0, 900)), count(mean(name, 900, 1200)), count(mean(name, 1200, 1800)),
    (mean(name, 0, 1800) / mean(names[0], 0, 1800)).toPrecision(2)]));
}

function timesTable(scene) {
  const rows = framesOf(`${scene}-times`);
  const frames = [...new Set(rows.map((row) => row.frame))];
  const names = [...new Set(rows.map((row) => row.configuration))];
  const at = (name, frame) => rows.find((row) => row.configuration === name && row.frame === frame);
  const head = ['frame time / frustum-finest', ...frames.map((f) => `frame ${f}`), ...frames.map((f) => `FLIP, ${f}`)];
  return table(head, names.map((name) => [`\`${name}\``,
    ...frames.map((f) => (+at(name, f).frame_ms / +at(names[0], f).frame_ms).toPrecision(2)),
    ...frames.map((f) => (+at(name, f).flip).toFixed(4))]));
}

function drawSweep() {
  const { sweep } = summaryOf('detail');
  draw('results-detail.svg', {
    xAxis: { type: 'log', name: 'triangles, mean of three frames', nameGap: 30, axisLabel: { formatter: count } },
    yAxis: { type: 'log', name: 'FLIP', nameGap: 50 },
    series: sweep.curves.map((curve, i) => ({ name: curve.name, type: 'line', color: COLORS[i === 0 ? 4 : 5],
      lineStyle: { type: DASHES[i], width: 2 }, data: curve.points.map((p) => [p.triangles, p.flip]) })),
  });
  const names = sweep.curves.map((curve) => curve.name);
  return table(['FLIP at most', ...names.map((name) => `triangles, \`${name}\``)],
    sweep.triangles_at_flip.map((row) => [row.flip, ...names.map((name) =>
      (row.triangles[name] == null ? 'not reached' : count(row.triangles[name])))]));
}

const SITUATIONS = [['foliage', 'foliage'], ['plane-low', 'plane, low'], ['plane-medium', 'plane, medium'],
  ['plane-high', 'plane, high']];

function situationTable() {
  const rows = [];
  for (const [name, title] of SITUATIONS) {
    for (const c of summaryOf(name).configurations)
      rows.push([title, `\`${c.name}\``, count(c.triangles.median), c.error.flip.mean.toFixed(4),
        (100 * c.popping.switches_per_visible_object).toFixed(2) + ' %', c.popping.temporal_flip.toFixed(5)]);
  }
  return table(['occluder', 'configuration', 'triangles', 'FLIP', 'switches per frame', 'temporal FLIP'], rows);
}

function switchesAt(report) {
  return `${(100 * configuration(summaryOf(report), 'hom+lv').popping.switches_per_visible_object).toFixed(1)} %`;
}

function copyPicture(report, name, target) {
  const [frame] = summaryOf(report).frames.kept;
  copyFileSync(`${reports}/${report}/pictures/${String(frame).padStart(5, '0')}-${name}.png`, `${docs}/images/${target}`);
}

const small = drawPath('thesis-5001');
const large = drawPath('thesis-10001');
const detail = drawSweep();
copyPicture('foliage', 'hom+lv-image', 'results-foliage.png');
copyPicture('foliage', 'hom+lv-error', 'results-foliage-error.png');
const { renderer, width, height } = summaryOf('thesis-5001-path');
const ratioOf = (scene, name, from, to) => {
  const sum = (who) => scene.rows.filter((r) => r.configuration === who && +r.frame >= from && +r.frame < to)
    .reduce((total, r) => total + +r.triangles, 0);
  return sum(name) / sum('frustum-finest');
};
function timeRatios(scene, name) {
  const rows = framesOf(`${scene}-times`);
  const of = (who) => rows.filter((row) => row.configuration === who).map((row) => +row.frame_ms);
  const base = of('frustum-finest');
  return of(name).map((ms, i) => (ms / base[i]).toPrecision(2)).join(', ');
}
const winsInside = (scene) => (Number(timeRatios(scene, 'hom').split(', ').at(-1)) < 1 ? 'agreed'
  : 'not agreed, with objects this far apart the map hides too few of them even inside');
const percent = (value) => `${(100 * value).toPrecision(2)} %`;
const within = (value, text, otherwise) => (value ? text : otherwise);
const culledOutside = 1 - ratioOf(small, 'hom', 0, 900);
const lvInside = ratioOf(small, 'hom+lv-tessellation', 1200, 1800);
const lvOutside = ratioOf(small, 'hom+lv-tessellation', 0, 900);

writeFileSync(`${docs}/results.md`, `# The thesis' results, redone

\`scripts/reproduce\` measures and writes this page: ${renderer}, ${width}x${height}. Triangle counts do not depend on the driver; times are
ratios within one run. The scenes are those of the thesis (Kristmann 2022, 4.2) as far as it describes them; the side of its cubes and the
distance of its occluders are our choices.

\`frustum-finest\`, \`hom\` and \`hom+lv-tessellation\` are the thesis' three methods: frustum culling, its occlusion map without and with
levels of visibility, all else at full detail. \`hom+lv\` maps LV onto discrete levels instead, \`hiz\` is two-phase culling with a pixel error,
\`default\` relaxes that error by counted visibility, \`tessellation\` spends the same budget on Phong tessellation.

## 5001 bunnies in a small cube (Fig. 4.6, 4.7)

![Triangles over the path](images/results-thesis-5001.svg)

${pathTable(small)}

${timesTable('thesis-5001')}

## 10001 bunnies in a large cube (Fig. 4.9, 4.10)

![Triangles over the path](images/results-thesis-10001.svg)

${pathTable(large)}

${timesTable('thesis-10001')}

## Where we agree with the thesis, and where not

- **Plain occlusion culling loses outside the small cube.** The thesis: it culls nothing there and costs more than frustum culling. Here it leaves
  out ${percent(culledOutside)} of the triangles from outside: ${within(culledOutside < 0.05, 'agreed', 'more than reported')}.
- **LV with tessellation saves.** The thesis: 132.9 M of 294.1 M triangles (45 %) in its pictured view, up to 30 % less than everything from
  outside. Here the path outside takes ${percent(lvOutside)} of full detail: ${within(lvOutside < 0.9, 'agreed in kind', 'less than reported')}; the amount follows from the
  distance within which objects are occluders, which are drawn at full detail.
- **Inside, culling and LV share the work.** There the map leaves ${percent(ratioOf(small, 'hom', 1200, 1800))} of what frustum culling draws, LV ${percent(lvInside)} of it.
- **The map costs a pass over the occluders**, and pays where it hides more than that. The thesis: plain occlusion culling loses to frustum culling outside and wins
  inside. Here \`hom\` takes ${timeRatios('thesis-5001', 'hom')} of frustum culling's frame time in the small cube: ${winsInside('thesis-5001')}; in the large one
  ${timeRatios('thesis-10001', 'hom')}: ${winsInside('thesis-10001')}.
  With LV it is ${timeRatios('thesis-5001', 'hom+lv')} and ${timeRatios('thesis-10001', 'hom+lv')} on discrete levels, ${timeRatios('thesis-5001', 'hom+lv-tessellation')} and
  ${timeRatios('thesis-10001', 'hom+lv-tessellation')} tessellated: this renderer has no unit for it, and tessellates much slower than it draws.
- **Against today's baseline the thesis' method does not hold.** LV ignores the size on screen: a pixel error draws ${percent(ratioOf(small, 'hiz', 0, 1800) / ratioOf(small, 'hom+lv-tessellation', 0, 1800))} of
  its triangles over the path, ${percent(ratioOf(small, 'hiz', 1200, 1800) / ratioOf(small, 'hom+lv-tessellation', 1200, 1800))} inside. As a factor on top of that error visibility pays ([detail](lod_selection.md#does-it-pay)).

## Phong tessellation against discrete levels

Same budget, thesis-5001, frames 1100, 1300 and 1500, error against full detail:

![FLIP over triangles](images/results-detail.svg)

${detail}

The patches are pieces of a smooth surface over the coarsest level (98 triangles). However fine they are, the surface is not the bunny's: their error
has a floor, and discrete levels have none. The thesis does not meet it, because its full detail is that smooth surface itself; the errors of
\`tessellation\` on this page are errors to the scanned bunny. For a base mesh whose smooth surface *is* the model, patches save memory, not triangles.

## Behind foliage and planes (4.2.3)

![A bunny behind foliage, drawn by the thesis' method](images/results-foliage.png) ![Its error map](images/results-foliage-error.png)

*\`hom+lv\`, and where it differs from full detail (FLIP: black = not seen).*

One bunny, 60 frames on end along an arc in front of it, 640x360; a switch is a change of level of a visible object. Tessellation is left out: the
patch path rounds the planes as well, and their error would hide the bunny's.

${situationTable()}

The thesis asked five viewers: no difference at low and high cover, popping at medium cover on silhouettes. The figures agree in kind: with \`hom+lv\`
levels switch most often at medium cover (${switchesAt('plane-low')}, ${switchesAt('plane-medium')} and ${switchesAt('plane-high')} at low, medium and high). Its error keeps growing with the
cover, because LV alone chooses ever coarser levels, while less and less of them is left to be seen. The pixel error holds an object of this size within a pixel whatever
covers it; what its visibility relaxes here is one level at most.

## To repeat it

\`\`\`sh
scripts/reproduce     # half an hour on two cores without a GPU; out/reproduce/NAME/index.html are the reports
\`\`\`
`);
console.log(`${docs}/results.md`);
process.exit(0);  // the charts library keeps a timer running

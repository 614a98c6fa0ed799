// Passes and levels: bars of the time per pass and of the objects per level.

// Passes and levels --------------------------------------------------------

// [fill, text]. Drawing passes are blue; passes that decide what to draw are brown and grey.
const DRAWING = [['#1d5788', '#fff'], ['#4b8fc6', '#000'], ['#93c1e4', '#000'], ['#c9e0f2', '#000']];
const DECIDING = [
  ['#8a4a12', '#fff'], ['#cf8a3a', '#000'], ['#e9bd78', '#000'], ['#f5e0ba', '#000'], ['#5f5f5c', '#fff'],
  ['#9b9b96', '#000'], ['#c8c8c2', '#000'], ['#7c6a55', '#fff'],
];

function passColors() {
  const colors = new Map();
  const used = [0, 0];
  for (const c of configurations) {
    for (const pass of Object.keys(c.passes_ms ?? {})) {
      if (colors.has(pass)) continue;
      const kind = /\bdraw\b/.test(pass) ? 0 : 1;
      const list = kind === 0 ? DRAWING : DECIDING;
      colors.set(pass, list[used[kind]++ % list.length]);
    }
  }
  return colors;
}

const sum = (values) => values.reduce((a, b) => a + b, 0);
const shareText = (v, total) => (total > 0 ? `${((100 * v) / total).toFixed(0)} %` : '');

/// One bar per configuration.
/// @param parts  of a configuration: [{ text, value, color: [fill, ink] }]
/// @param format  of a value, with its unit
function barChart(rows, parts, format, kind) {
  const total = (i) => sum(parts(i).map(({ value }) => value));
  const largest = Math.max(...rows.map(total));
  return element('div', { class: 'bars' }, rows.map((i) => {
    const pieces = parts(i).filter(({ value }) => value > 0).map(({ text, value, color: [fill, ink] }) => {
      const title = `${text}: ${format(value)}, ${shareText(value, total(i))}`;
      const piece = element('div', { title }, element('span', null, text));
      piece.style.flexGrow = value;
      piece.style.setProperty('--of', fill);
      piece.style.setProperty('--on', ink);
      return piece;
    });
    const bar = element('div', { class: `bar ${kind}`, 'aria-hidden': 'true' }, pieces);
    bar.style.width = `${largest > 0 ? (100 * total(i)) / largest : 0}%`;
    const label = element('span', null, format(total(i)));
    return element('div', null, element('div', { class: 'head' }, owner(i), label), bar);
  }));
}

/// A bar chart, and its numbers as a table for print and screen readers.
function barFigure(title, chart, caption, columns, rows, unit) {
  return [element('h3', null, title),
    element('figure', { class: 'chart' }, chart, element('figcaption', { class: 'numbered' }, caption)),
    element('details', null, element('summary', null, `${title}, as a table`),
      tableFigure(title, unit, configurationTable(columns, rows)))];
}

function passBars(section, rows) {
  const colors = passColors();
  if (colors.size === 0) return;
  const key = element('div', { class: 'legend' }, [...colors].map(([pass, [fill]]) => {
    const mark = element('i');
    mark.style.setProperty('--of', fill);
    return element('span', { class: 'entry' }, mark, pass);
  }));
  const times = (i) => configurations[i].passes_ms ?? {};
  const parts = (i) => Object.entries(times(i)).map(([text, value]) => ({ text, value, color: colors.get(text) }));
  const columns = [...colors.keys()].map((pass) => ({ head: pass, cell: (i) => milliseconds(times(i)[pass]) }));
  section.append(...barFigure('Time per pass', [key, barChart(rows, parts, (v) => `${milliseconds(v)} ms`, '')],
    'Median time of each pass, times the share of frames in which it ran. Blue passes draw; brown and grey passes '
    + 'decide what to draw. The sum can differ from the median frame time.', columns, rows, 'Milliseconds per frame.'));
}

function levelBars(section, rows) {
  const levels = (i) => configurations[i].lod_histogram_mean ?? [];
  const most = Math.max(0, ...rows.map((i) => levels(i).length));
  if (!rows.some((i) => sum(levels(i)) > 0)) return;
  const mix = (a, b, t) => Math.round(a + (b - a) * t);
  // The same dark and light blue as in the LOD map.
  const color = (k) => {
    const t = most > 1 ? k / (most - 1) : 0;
    return [`rgb(${mix(16, 205, t)} ${mix(39, 238, t)} ${mix(160, 255, t)})`, t < 0.55 ? '#fff' : '#000'];
  };
  const parts = (i) => levels(i).map((value, k) => ({ text: String(k), value, color: color(k) }));
  const columns = Array.from({ length: most }, (_, k) => ({ head: String(k), cell: (i) => count(levels(i)[k]) }));
  const patches = configurations.some((c) => /tessellation/.test(c.options ?? ''))
    ? '. With tessellation, level 0 is the coarsest' : '';
  const chart = barChart(rows, parts, (v) => `${count(v)} objects`, 'levels');
  section.append(...barFigure('Objects per level of detail', chart,
    `Mean number of drawn objects per level. Level 0 (dark) is the finest${patches}.`,
    columns, rows, 'Mean number of drawn objects. The columns are levels.'));
}

function passesSection() {
  const section = byId('passes');
  const rows = configurations.map((_, i) => i).filter((i) => configurations[i].frames > 0);
  const length = choice('length', 'length of the bars', [['amount', 'amount'], ['share', 'share']], 'amount',
    (value) => section.classList.toggle('shares', value === 'share'));
  if (rows.length) {
    passBars(section, rows);
    levelBars(section, rows);
  }
  section.hidden = section.children.length === 1;
  if (rows.length > 1) section.querySelector('h2').after(element('div', { class: 'controls' }, length.node));
}

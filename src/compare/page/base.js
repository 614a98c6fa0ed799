// Parts that all sections share: data, elements, numbers, colours, tables.
// Names are user input: they are inserted as text, never as markup.

const data = JSON.parse(document.getElementById('data').textContent);
const summary = data.summary;
const configurations = summary.configurations ?? [];
const frames = summary.frames ?? {};
const kept = data.kept ?? [];
const sweep = summary.sweep?.curves?.length ? summary.sweep : null;
const chartsLibrary = window.echarts ?? null;
const indexOf = new Map(configurations.map((c, i) => [c.name, i]));
const baseline = indexOf.get(summary.baseline) ?? 0;
const base = configurations[baseline];
const measured = Math.max(0, ...configurations.map((c) => c.frames ?? 0));
const byName = new Map((data.series ?? []).map((s) => [s.name, s]));
const series = configurations.map((c) => {
  const columns = byName.get(c.name) ?? { frame: [] };
  return { ...columns, at: new Map((columns.frame ?? []).map((frame, i) => [frame, i])) };
});
const calm = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
const byId = (id) => document.getElementById(id);

// Elements -----------------------------------------------------------------

function element(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes ?? {})) {
    if (typeof value === 'function') node.addEventListener(key, value);
    else if (value != null && value !== false) node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child != null && child !== ''));
  return node;
}

const named = (name) => element('span', { class: 'name' }, name);

function speak(text) {
  byId('spoken').textContent = text;
}

/// Radio buttons, shown as a row of buttons; the arrow keys move among them.
function choice(id, label, options, value, onChange) {
  const inputs = new Map();
  const node = element('div', { class: 'choice', role: 'radiogroup', 'aria-label': label },
    element('b', null, label));
  for (const [key, text] of options) {
    const input = element('input', { type: 'radio', name: id, value: key, checked: key === value });
    inputs.set(key, input);
    node.append(element('label', null, input, element('span', null, text)));
  }
  node.addEventListener('change', (event) => onChange(event.target.value));
  return {
    node,
    set: (key) => { inputs.get(key).checked = true; },
    allow: (keys) => inputs.forEach((input, key) => { input.disabled = !keys.includes(key); }),
  };
}

// Numbers ------------------------------------------------------------------

const NONE = '\u2013';
const threeDigits = (v) => v.toFixed(v >= 99.95 ? 0 : v >= 9.995 ? 1 : 2);

/// 1234567 -> "1.23 M".
function count(v) {
  if (v == null) return NONE;
  if (v >= 999.5e6) return `${threeDigits(v / 1e9)}\u202fG`;
  if (v >= 999.5e3) return `${threeDigits(v / 1e6)}\u202fM`;
  if (v >= 1e4) return `${threeDigits(v / 1e3)}\u202fk`;
  return (v >= 100 ? Math.round(v) : Math.round(v * 10) / 10).toLocaleString('en');
}
function milliseconds(v) {
  if (v == null) return NONE;
  return v === 0 ? '0' : v < 0.995 ? v.toPrecision(2) : threeDigits(v);
}
function ratio(v) {
  if (v == null) return NONE;
  return v !== 0 && v < 0.0995 ? v.toPrecision(2) : v >= 9.995 ? threeDigits(v) : v.toFixed(2);
}
const percent = (v) => (v == null ? NONE : `${(100 * v).toFixed(v < 0.0995 ? 1 : 0)} %`);
function small(v) {
  if (v == null) return NONE;
  return v === 0 ? '0' : v < 0.00005 ? '<0.0001' : v.toFixed(4);
}
const decibel = (v) => (v == null ? NONE : v.toFixed(1));
const whole = (v) => (v == null ? NONE : Math.round(v).toLocaleString('en'));
const range = (spread, format) => `${format(spread.q1)}\u2013${format(spread.q3)}`;

// Colours and marks --------------------------------------------------------

// Outlines of the marks in a box of 20 x 20, for legends, tables and charts.
const SYMBOLS = [
  'M10,2A8,8,0,1,1,9.99,2Z',
  'M3,3H17V17H3Z',
  'M10,2L18.5,17H1.5Z',
  'M10,0.5L19.5,10L10,19.5L0.5,10Z',
  'M10,18L1.5,3H18.5Z',
  'M7,1.5H13V7H18.5V13H13V18.5H7V13H1.5V7H7Z',
  'M10,6.2L14.9,1.3L18.7,5.1L13.8,10L18.7,14.9L14.9,18.7L10,13.8L5.1,18.7L1.3,14.9L6.2,10L1.3,5.1L5.1,1.3Z',
  'M10,1L12.6,7.2L19.3,7.7L14.2,12.1L15.8,18.6L10,15.1L4.2,18.6L5.8,12.1L0.7,7.7L7.4,7.2Z',
];
const DASHES = [[], [], [7, 3], [2, 2.5], [10, 3, 2, 3], [12, 4], [4, 2], [7, 2, 2, 2, 2, 2]];
const COLORS = 8;
const TICK_LABEL = 11;

/// The baseline has the first entry of a list, the other configurations share the rest. @param round  shifts them each
/// time that the list begins anew
function entryOf(index, round) {
  if (index === baseline) return 0;
  const place = index < baseline ? index : index - 1;
  return 1 + ((place + round * Math.floor(place / (COLORS - 1))) % (COLORS - 1));
}
/// Index of a colour.
const styleOf = (index) => entryOf(index, 0);
/// Index of a mark and of dashes. Where colours repeat, marks are others: up to 49 configurations differ.
const markOf = (index) => entryOf(index, 3);
const dashOf = (index) => (DASHES[markOf(index)].length ? DASHES[markOf(index)] : 'solid');
const cssColor = (index) => `var(--series-${styleOf(index)})`;
const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function swatch(index) {
  const create = (tag, attributes) => {
    const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    return node;
  };
  const svg = create('svg', { class: 'swatch', width: 28, height: 12, viewBox: '0 0 28 12', 'aria-hidden': 'true' });
  svg.style.setProperty('--of', cssColor(index));
  const style = markOf(index);
  const dashes = DASHES[style].join(' ');
  svg.append(create('path', { d: 'M0 6H28', stroke: 'currentColor', 'stroke-width': 2, 'stroke-dasharray': dashes }),
    create('path', { d: SYMBOLS[style], fill: 'currentColor', transform: 'translate(8.5 0.5) scale(0.55)' }));
  return svg;
}
function owner(index) {
  return element('div', { class: 'owner' }, swatch(index), element('span', null, configurations[index].name));
}

// Tables -------------------------------------------------------------------

const overflowing = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    // A box that scrolls must be reachable by keyboard; other boxes need no tab stop.
    if (target.scrollWidth > target.clientWidth + 1) target.setAttribute('tabindex', '0');
    else target.removeAttribute('tabindex');
    markEnds(target);
  }
});
/// Tells the style sheet on which sides of a box there is more to see.
function markEnds(box) {
  const hidden = box.scrollWidth - box.clientWidth;
  box.parentElement.classList.toggle('more-left', hidden > 1 && box.scrollLeft > 1);
  box.parentElement.classList.toggle('more-right', hidden > 1 && box.scrollLeft < hidden - 1);
  box.parentElement.previousElementSibling.classList.toggle('needed', hidden > 1);
  box.parentElement.previousElementSibling.classList.toggle('done', box.scrollLeft >= hidden - 1);
}
function scrolling(table, label) {
  const node = element('div', { class: 'scroll', role: 'region', 'aria-label': label,
    scroll: () => markEnds(node) }, table);
  overflowing.observe(node);
  return [element('p', { class: 'swipe', 'aria-hidden': 'true' }, 'More columns: scroll sideways \u2192'),
    element('div', { class: 'ends' }, node)];
}

function tableFigure(label, caption, table, kind = '') {
  return element('figure', { class: `data ${kind}` },
    element('figcaption', { class: 'above numbered' }, caption), scrolling(table, label));
}

/// Rows of configurations, columns of numbers.
/// @param columns [{ head, sub?, cell(index), note?(index), key?(index), better?: 1 | -1 }]
function configurationTable(columns, rows) {
  const marks = columns.map((column) => best(column, rows));
  const head = element('tr', null, element('th', { class: 'corner', scope: 'col' }, 'configuration'));
  for (const { head: text, sub } of columns)
    head.append(element('th', { scope: 'col' }, text, sub ? element('small', null, element('br'), sub) : null));
  const body = element('tbody', { class: 'rows' });
  for (const index of rows) {
    const cells = columns.map((column, k) => cell(column, index, marks[k]));
    body.append(element('tr', null, element('th', { scope: 'row' }, owner(index)), cells));
  }
  return element('table', null, element('thead', null, head), body);
}

function cell(column, index, marks) {
  const note = column.note?.(index);
  return element('td', null, element('span', { class: marks.has(index) ? 'best' : null }, column.cell(index)),
    note ? element('small', null, note) : null);
}

/// Rows with the best value of a column; empty if all shown values are the same.
function best(column, rows) {
  if (!column.better || rows.length < 2) return new Set();
  const known = rows.filter((index) => column.key(index) != null && !Number.isNaN(column.key(index)));
  if (known.length < 2) return new Set();
  const winner = known.reduce((a, b) => ((column.key(b) - column.key(a)) * column.better > 0 ? b : a));
  const found = known.filter((index) => column.cell(index) === column.cell(winner));
  return new Set(found.length === known.length ? [] : found);
}

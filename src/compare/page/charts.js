// Parts that all charts share: legend, axes, tooltips, keyboard.

// Charts -------------------------------------------------------------------

const charts = {};
const hidden = new Set();
const state = { quantity: 'triangles', scale: 'linear', axis: 'triangles' };
const redraw = [];  // functions that draw the charts and legends again

function legend(shown) {
  const node = element('div', { class: 'legend', role: 'group', 'aria-label': 'Configurations shown' });
  for (const index of shown) {
    const button = element('button', { type: 'button', 'aria-pressed': 'true', click: () => {
      if (!hidden.delete(index)) hidden.add(index);
      redraw.forEach((draw) => draw());
    } }, swatch(index), element('span', null, configurations[index].name));
    redraw.push(() => button.setAttribute('aria-pressed', String(!hidden.has(index))));
    node.append(button);
  }
  return node;
}

function createChart(id, node, option) {
  const chart = chartsLibrary.init(node, null, { renderer: 'canvas' });
  charts[id] = chart;
  const draw = () => chart.setOption(option(), { notMerge: true });
  redraw.push(draw);
  let width = node.clientWidth;
  new ResizeObserver(() => {
    if (node.clientWidth === 0) return;
    chart.resize();
    if (node.clientWidth !== width) draw();  // the number of ticks depends on the width
    width = node.clientWidth;
  }).observe(node);
  draw();
  return chart;
}

function chartColors() {
  const names = ['ink', 'muted', 'rule', 'edge', 'paper', 'accent', 'raised'];
  return Object.fromEntries(names.map((name) => [name, variable(`--${name}`)]));
}

const axisStyle = (t) => ({
  axisLine: { show: true, lineStyle: { color: t.edge } },
  axisTick: { show: true, lineStyle: { color: t.edge } },
  axisLabel: { color: t.muted, fontSize: TICK_LABEL, hideOverlap: true },
  splitLine: { lineStyle: { color: t.rule, width: 1 } },
  nameTextStyle: { color: t.muted, fontSize: 12 },
});

const tooltipStyle = (t) => ({
  confine: true, backgroundColor: t.paper, borderColor: t.edge, borderWidth: 1, padding: [6, 9],
  transitionDuration: 0, textStyle: { color: t.ink },
  extraCssText: 'box-shadow: 0 2px 8px #0004; border-radius: 4px;',
});

/// A linear axis of logarithms, which ends where the data end. The library's logarithmic axes end at powers of ten.
function logAxis(values, room, format) {
  const positive = values.filter((v) => v > 0);
  if (positive.length === 0) return {};
  let low = Math.log10(positive.reduce((a, b) => Math.min(a, b)));
  let high = Math.log10(positive.reduce((a, b) => Math.max(a, b)));
  const margin = Math.max(0.04 * (high - low), 0.02);
  [low, high] = [low - margin, high + margin];
  const densities = [
    [1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9], [1, 1.5, 2, 3, 4, 5, 7], [1, 2, 5], [1, 3], [1],
  ];
  let ticks = [];
  for (const steps of densities) {
    ticks = [];
    for (let power = Math.floor(low); power <= high; ++power)
      for (const step of steps) ticks.push(power + Math.log10(step));
    ticks = ticks.filter((tick) => tick >= low && tick <= high);
    if (ticks.length <= room) break;
  }
  if (ticks.length > room) ticks = ticks.filter((_, i) => i % Math.ceil(ticks.length / room) === 0);
  return {
    min: low, max: high, axisTick: { customValues: ticks },
    axisLabel: { customValues: ticks, formatter: (v) => format(Number((10 ** v).toPrecision(3))) },
  };
}
/// count() and other numbers without trailing zeros, for ticks.
const countTick = (v) => count(v).replace(/\.0+(?=\u202f)|(\.\d*[1-9])0+(?=\u202f)/, '$1');
const brief = (v) => String(Number(v.toPrecision(2)));

/// Merges options of an axis one level deep.
function axis(...parts) {
  const result = {};
  for (const part of parts) {
    for (const [key, value] of Object.entries(part)) {
      const nested = value && typeof value === 'object' && !Array.isArray(value);
      result[key] = nested ? { ...result[key], ...value } : value;
    }
  }
  return result;
}

function tip(title, rows) {
  const table = element('table');
  for (const [index, ...texts] of rows) {
    const cells = texts.map((text) => element('td', null, text));
    table.append(element('tr', null, element('td', null, swatch(index)), cells));
  }
  return element('div', { class: 'tip' }, element('b', null, title), rows.length ? table : null);
}

/// @param actions  by key; an action that returns false leaves the key to the browser
function listenForKeys(node, actions) {
  node.addEventListener('keydown', (event) => {
    if (event.target !== node || event.ctrlKey || event.metaKey || event.altKey
      || !Object.hasOwn(actions, event.key)) return;
    if (actions[event.key](event) !== false) event.preventDefault();
  });
}

// Fills the report: tables, charts, the picture viewer. Names come from users: they enter as text, never as markup.
'use strict';
(() => {
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

  /// Radio buttons that look like keys; the arrows of the keyboard choose among them.
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
  function small(v) {
    if (v == null) return NONE;
    return v === 0 ? '0' : v < 0.00005 ? '<0.0001' : v.toFixed(4);
  }
  const decibel = (v) => (v == null ? NONE : v.toFixed(1));
  const whole = (v) => (v == null ? NONE : Math.round(v).toLocaleString('en'));
  const range = (spread, format) => `${format(spread.q1)}\u2013${format(spread.q3)}`;

  // Colours and marks --------------------------------------------------------

  // Outlines in a box of 20 x 20; the same in legends, tables and charts.
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

  /// Place in the lists above: the baseline has the first, the others share the rest.
  function styleOf(index) {
    if (index === baseline) return 0;
    const place = index < baseline ? index : index - 1;
    return 1 + (place % (COLORS - 1));
  }
  const dashOf = (index) => (DASHES[styleOf(index)].length ? DASHES[styleOf(index)] : 'solid');
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
    const style = styleOf(index);
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
      // A box that scrolls must be reachable by keyboard; one that does not is a useless stop.
      if (target.scrollWidth > target.clientWidth + 1) target.setAttribute('tabindex', '0');
      else target.removeAttribute('tabindex');
    }
  });
  function scrolling(table, label) {
    const node = element('div', { class: 'scroll', role: 'region', 'aria-label': label }, table);
    overflowing.observe(node);
    return node;
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

  /// Rows with the best value of a column; none where all are the same to the shown digits.
  function best(column, rows) {
    if (!column.better || rows.length < 2) return new Set();
    const known = rows.filter((index) => column.key(index) != null && !Number.isNaN(column.key(index)));
    if (known.length < 2) return new Set();
    const winner = known.reduce((a, b) => ((column.key(b) - column.key(a)) * column.better > 0 ? b : a));
    const found = known.filter((index) => column.cell(index) === column.cell(winner));
    return new Set(found.length === known.length ? [] : found);
  }

  // Head ---------------------------------------------------------------------

  // Without pictures nothing is drawn either.
  const timeName = summary.reference === 'none' ? 'culling time' : 'frame time';
  const capital = (text) => text[0].toUpperCase() + text.slice(1);
  const sceneName = String(summary.scene ?? 'scene').split(/[\\/]/).pop();

  function frameText() {
    const { first, last, step, count: planned } = frames;
    if (planned === 1) return `frame ${first}`;
    return `${whole(planned)} frames, ${first}\u2013${last}${step > 1 ? ` in steps of ${step}` : ''}`;
  }

  function head() {
    document.title = `${sceneName}: comparison`;
    byId('version').textContent = summary.version ?? '';
    byId('title').textContent = sceneName;
    const facts = [
      summary.path ? `path: ${summary.path}` : null,
      `${summary.width}\u00d7${summary.height}`,
      frameText(),
      summary.objects ? `${whole(summary.objects)} objects` : null,
      summary.triangles_full ? `${count(summary.triangles_full)} triangles at full detail` : null,
      summary.renderer,
      summary.timing === 'gpu' ? 'GPU timestamps' : 'wall time',
    ];
    byId('circumstances').append(...facts.filter(Boolean).map((fact) => element('li', null, fact)));
    if (summary.complete !== false) return;
    const banner = byId('banner');
    banner.hidden = false;
    const all = measured >= (frames.count ?? 0);
    const share = all ? 'all' : `${whole(measured)} of`;
    banner.append(element('b', null, `Interrupted after ${share} ${whole(frames.count)} frames`),
      `; ${all ? 'pictures or the sweep are incomplete, and ' : ''}figures are of what was measured.`);
  }

  function contents() {
    for (const section of document.querySelectorAll('main > section')) {
      if (section.hidden) continue;
      byId('contents').append(element('a', { href: `#${section.id}` }, section.querySelector('h2').textContent));
    }
  }

  // Results ------------------------------------------------------------------

  /// The configuration to speak of: the fewest triangles, the baseline aside.
  function candidate() {
    const others = configurations.map((_, i) => i).filter((i) => i !== baseline && configurations[i].frames > 0);
    if (others.length === 0) return baseline;
    const share = (i) => configurations[i].triangles_ratio.median;
    return others.reduce((a, b) => (share(b) < share(a) ? b : a));
  }

  const meanFlip = (c) => c?.error?.flip?.mean ?? null;

  function leadSentence() {
    const c = configurations[candidate()];
    if (!c || !measured) return ['Nothing has been measured yet.'];
    if (c === base) {
      const flip = meanFlip(c);
      return [named(c.name), ` draws ${count(c.triangles.median)} triangles${measured > 1 ? ' per frame' : ''}`,
        summary.triangles_full ? ` of ${count(summary.triangles_full)} at full detail` : '',
        flip == null ? '; pictures were not compared.' : `, at FLIP ${small(flip)}.`];
    }
    const share = c.triangles_ratio.median;
    const parts = share < 0.995
      ? [named(c.name), ` draws ${ratio(share)} of the triangles of `, named(base.name), ' (the baseline)']
      : ['None draws fewer triangles than ', named(base.name), ' (the baseline); ', named(c.name),
        ` comes closest with ${ratio(share)}`];
    const time = c.frame_ratio;
    const differs = time.q3 < 1 || time.q1 > 1;
    if (time.median > 0 && differs) parts.push(` in ${ratio(time.median)} of its ${timeName}`);
    else if (time.median > 0) parts.push(` in about its ${timeName} (${ratio(time.median)})`);
    const [flip, baseFlip] = [meanFlip(c), meanFlip(base)];
    if (flip == null) parts.push('; pictures were not compared.');
    else if (small(flip) === small(baseFlip)) parts.push(`, at the same FLIP, ${small(flip)}.`);
    else parts.push(`, at FLIP ${small(flip)}${baseFlip == null ? '' : ` against ${small(baseFlip)}`}.`);
    return parts;
  }

  /// What the sweep says in one sentence, at the middle budget that the baseline's curve reaches.
  function equalQuality() {
    const rows = sweep?.triangles_at_flip ?? [];
    const order = [1, 2, 0].map((i) => rows[i]).filter(Boolean);
    for (const row of order) {
      const own = row.triangles[base.name];
      const others = Object.entries(row.triangles).filter(([name, v]) => name !== base.name && v != null);
      if (own == null || own <= 0 || others.length === 0) continue;
      const [name, least] = others.reduce((a, b) => (b[1] < a[1] ? b : a));
      const start = `At equal quality (FLIP ${row.flip}) `;
      if (least >= own) return [start, 'none needs fewer triangles than ', named(base.name), '.'];
      return [start, named(name), ` needs ${ratio(least / own)} of the triangles of `, named(base.name), '.'];
    }
    return null;
  }

  /// Columns of the table of results, in groups; those that nothing is known of are left out.
  function resultColumns() {
    const of = (get) => (index) => (configurations[index].frames > 0 ? get(configurations[index]) : null);
    const spread = (group, head, key, format) => {
      const get = of((c) => c[key]);
      return {
        group, head, better: -1, key: (i) => get(i)?.median ?? null, cell: (i) => format(get(i)?.median),
        note: (i) => (get(i) && configurations[i].frames > 1 ? range(get(i), format) : null),
      };
    };
    const shareOf = (group, key) => {
      const column = spread(group, 'ratio', key, ratio);
      const known = (i) => (configurations[i][key]?.median > 0 ? column.key(i) : null);
      const note = (i) => (known(i) == null || i === baseline ? null : column.note(i));
      return { ...column, key: known, cell: (i) => ratio(known(i)), note };
    };
    const plain = (group, head, get, note) => ({
      group, head, better: -1, key: of(get), cell: (i) => small(of(get)(i)), note: note ? of(note) : null,
    });
    const error = (head, measure, worst, sign, format, better) => {
      // Equal pictures have no PSNR, and the best one.
      const get = (key) => of((c) => (c.error ? c.error[measure][key] ?? Infinity : null));
      const text = (key) => (i) => (get(key)(i) === Infinity ? 'equal' : format(get(key)(i)));
      const [mean, extreme] = [text('mean'), text(worst)];
      return {
        group: 'Error against the reference', head, better, key: get('mean'), cell: mean,
        note: (i) => (configurations[i].frames > 1 && extreme(i) !== mean(i) ? `${sign}\u2009${extreme(i)}` : null),
      };
    };
    return [
      spread('Triangles', 'median', 'triangles', count),
      shareOf('Triangles', 'triangles_ratio'),
      spread(capital(timeName), 'ms', 'frame_ms', milliseconds),
      shareOf(capital(timeName), 'frame_ratio'),
      spread('Drawn', 'commands', 'draws', count),
      spread('Drawn', 'objects', 'drawn', count),
      error('FLIP', 'flip', 'largest', '\u2264', small, -1),
      error('PSNR', 'psnr', 'least', '\u2265', decibel, 1),
      error('SSIM', 'ssim', 'least', '\u2265', small, 1),
      plain('Popping', 'switches', (c) => c.popping?.switches_per_visible_object),
      plain('Popping', 'frozen', (c) => c.popping?.frozen_flip_largest,
        (c) => (c.popping?.frozen_flip_mean > 0 ? `mean ${small(c.popping.frozen_flip_mean)}` : null)),
      plain('Popping', 'temporal', (c) => c.popping?.temporal_flip),
    ].filter((column) => configurations.some((_, i) => column.key(i) != null));
  }

  function results() {
    byId('lead').append(...leadSentence());
    const second = equalQuality();
    if (second) byId('lead').after(element('p', { class: 'second' }, second));
    const columns = resultColumns();
    const groups = element('tr', null, element('th', { class: 'corner', scope: 'col', rowspan: 2 }, 'configuration'));
    const heads = element('tr');
    columns.forEach((column, k) => {
      heads.append(element('th', { scope: 'col' }, column.head));
      if (k > 0 && columns[k - 1].group === column.group) return;
      const span = columns.filter((c) => c.group === column.group).length;
      const title = element('span', null, column.group);
      groups.append(element('th', { class: 'group', scope: 'colgroup', colspan: span }, title));
    });
    const table = element('table', null, element('thead', null, groups, heads));
    const rows = configurations.map((_, i) => i);
    const marks = columns.map((column) => best(column, rows));
    for (const index of rows) {
      const c = configurations[index];
      const partial = summary.complete === false && c.frames < measured ? `${whole(c.frames)} frames` : null;
      const notes = [index === baseline && rows.length > 1 ? 'baseline' : null, partial].filter(Boolean).join(', ');
      const title = element('th', { scope: 'row' }, owner(index), notes ? element('small', null, notes) : null);
      const options = element('td', { colspan: columns.length + 1 }, element('code', null, c.options ?? ''));
      table.append(element('tbody', null,
        element('tr', null, title, columns.map((column, k) => cell(column, index, marks[k]))),
        c.options ? element('tr', { class: 'options' }, options) : null));
    }
    const many = measured > 1;
    const compared = configurations.some((c) => c.error);
    const text = [many ? `Medians over ${whole(measured)} frames, below them the quartiles.` : 'One frame.'];
    if (rows.length > 1) {
      const where = many ? ' in the same frame' : '';
      text.push(`Ratios are those to the baseline${where}; the best value of a column is marked.`);
    }
    text.push(compared
      ? `Errors are means${many ? ', below them the worst frame' : ''}; smaller is better, except PSNR (dB) and SSIM.`
      : 'Pictures were not compared: there is no error and no popping to show.');
    if (columns.some((c) => c.group === 'Popping'))
      text.push('Popping: level switches per visible object and frame; FLIP of the worst pixel when time stands still; '
        + 'temporal FLIP.');
    byId('results').append(tableFigure('Results', text.join(' '), table));
  }

  // Charts -------------------------------------------------------------------

  const charts = {};
  const hidden = new Set();
  const state = { quantity: 'triangles', scale: 'linear', axis: 'triangles' };
  const redraw = [];  // of every chart, on another theme or legend

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
      if (node.clientWidth !== width) draw();  // ticks follow the room
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

  /// The library's logarithmic axes end at powers of ten; these end where the data does: a linear axis of logarithms.
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
  /// Of round numbers on axes.
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

  // Over the frames ----------------------------------------------------------

  const ALL_SCALES = ['linear', 'log', 'ratio'];
  const digits = (v) => String(Number(v.toFixed(5)));
  // [key of the series, label, axis, format, format of ticks, scales, whether the axis may start above zero]
  const QUANTITIES = [
    ['triangles', 'triangles', 'triangles per frame', count, countTick, ALL_SCALES],
    ['frame_ms', timeName, `${timeName}, ms`, milliseconds, brief, ALL_SCALES],
    ['flip', 'FLIP', 'FLIP, mean of the frame', small, brief, ['linear', 'log']],
    ['psnr', 'PSNR', 'PSNR, dB', decibel, digits, ['linear'], true],
    ['ssim', 'SSIM', 'SSIM', small, digits, ['linear'], true],
    ['drawn', 'drawn objects', 'objects drawn', count, countTick, ALL_SCALES],
    ['culled_frustum', 'outside the frustum', 'objects outside the frustum', count, countTick, ['linear']],
    ['culled_occlusion', 'culled by occlusion', 'objects culled by occlusion', count, countTick, ['linear']],
    ['draws', 'draws', 'draw commands', count, countTick, ALL_SCALES],
    ['switches', 'switches', 'level switches per visible object', small, brief, ['linear']],
    ['temporal_flip', 'temporal FLIP', 'temporal FLIP, mean of the frame', small, brief, ['linear', 'log']],
  ].map(([key, label, long, format, tick, scales, floating]) => ({ key, label, long, format, tick, scales, floating }))
    .filter(({ key }) => series.some((s) => s[key]?.some((v) => v != null)));
  const quantityOf = (key) => QUANTITIES.find((q) => q.key === key);

  function valueAt(index, key, frame) {
    const s = series[index];
    return s.at.has(frame) ? s[key]?.[s.at.get(frame)] ?? null : null;
  }

  /// What the chart shows of one configuration at one frame, before the logarithm.
  function shownAt(index, frame) {
    const v = valueAt(index, state.quantity, frame);
    if (state.scale !== 'ratio' || v == null) return v;
    const of = valueAt(baseline, state.quantity, frame);
    return of > 0 ? v / of : null;
  }

  const allFrames = [...new Set(series.flatMap((s) => s.frame ?? []))].sort((a, b) => a - b);

  const wholeFrame = (v) => String(Math.round(v));

  function framesOption(node, window_) {
    const t = chartColors();
    const quantity = quantityOf(state.quantity);
    const logarithmic = state.scale === 'log';
    const format = state.scale === 'ratio' ? brief : quantity.tick;
    const shown = configurations.map((_, i) => i);
    const values = new Map(shown.map((i) => [i, (series[i].frame ?? []).map((frame) => [frame, shownAt(i, frame)])]));
    const scaled = (v) => (v == null ? null : !logarithmic ? v : v > 0 ? Math.log10(v) : null);
    const visible = shown.filter((i) => !hidden.has(i));
    const spread = (visible.length ? visible : shown).flatMap((i) => values.get(i).map(([, v]) => v));
    const stride = Math.max(1, Math.round(allFrames.length / 12));
    const lines = shown.map((index, k) => {
      const color = variable(`--series-${styleOf(index)}`);
      // Few and staggered: they tell the lines apart, not the frames.
      const offset = Math.floor((stride * k) / shown.length);
      const single = values.get(index).length < 3;
      return {
        id: `c${index}`, name: `c${index}`, type: 'line', z: index === baseline ? 3 : 4,
        data: values.get(index).map(([frame, v]) => [frame, scaled(v)]),
        symbol: (_, p) => (single || p.dataIndex % stride === offset ? `path://${SYMBOLS[styleOf(index)]}` : 'none'),
        symbolSize: 9, showSymbol: true, showAllSymbol: true, connectNulls: false,
        lineStyle: { color, width: allFrames.length > 400 ? 1.2 : 1.8, type: dashOf(index) },
        itemStyle: { color }, emphasis: { disabled: true },
      };
    });
    const selected = {};
    shown.forEach((index) => { selected[`c${index}`] = !hidden.has(index); });
    // A finger on the chart scrolls the page.
    const coarse = window.matchMedia('(pointer: coarse)').matches;
    // Where it would cover the chart, it hangs below it.
    const place = node.clientWidth < 640 ? { confine: false, position: () => [0, node.clientHeight - 4] } : {};
    return {
      animation: false,
      grid: { left: 6, right: 14, top: 14, bottom: 74, containLabel: true },
      legend: { show: false, selected },
      tooltip: {
        ...tooltipStyle(t), ...place, trigger: 'axis', formatter: frameTip,
        axisPointer: { type: 'line', snap: true, lineStyle: { color: t.muted } },
      },
      xAxis: axis(axisStyle(t), {
        type: 'value', min: allFrames[0], max: allFrames[allFrames.length - 1], minInterval: 1, name: 'frame',
        nameLocation: 'middle', nameGap: 26, splitLine: { show: false }, axisLabel: { formatter: wholeFrame },
        axisPointer: { label: { show: false } },
      }),
      yAxis: [
        axis(axisStyle(t), { type: 'value', scale: Boolean(quantity.floating), axisLabel: { formatter: format } },
          logarithmic ? logAxis(spread, 8, format) : {}),
        { type: 'value', min: 0, max: 1, show: false },
      ],
      dataZoom: [
        {
          type: 'inside', filterMode: 'none', disabled: coarse, zoomOnMouseWheel: 'ctrl', moveOnMouseMove: true,
          moveOnMouseWheel: false, preventDefaultMouseMove: false, ...window_,
        },
        {
          type: 'slider', filterMode: 'none', height: 16, bottom: 12, left: 44, right: 44, brushSelect: false,
          showDataShadow: false, moveHandleSize: 0, borderColor: t.edge, backgroundColor: t.raised,
          fillerColor: `${t.accent}33`, handleStyle: { color: t.paper, borderColor: t.edge },
          textStyle: { color: t.muted, fontSize: TICK_LABEL }, labelFormatter: wholeFrame, ...window_,
        },
      ],
      series: [...lines, ...(kept.length ? [keptMarks(t)] : [])],
    };
  }

  /// Frames with pictures: lines and marks at the foot; the one in the viewer is heavier.
  function keptMarks(t) {
    const isCurrent = (frame) => frame === (viewer?.frame ?? kept[0].frame);
    const color = (frame) => (isCurrent(frame) ? t.accent : t.muted);
    return {
      id: 'kept', name: 'kept', type: 'scatter', yAxisIndex: 1, z: 2, symbol: `path://${SYMBOLS[2]}`, silent: true,
      tooltip: { show: false },
      data: kept.map(({ frame }) => ({
        value: [frame, 0], symbolSize: isCurrent(frame) ? 14 : 9, symbolOffset: [0, '-50%'],
        itemStyle: { color: color(frame) },
      })),
      markLine: {
        symbol: 'none', silent: true, label: { show: false }, animation: false,
        data: kept.map(({ frame }) => ({
          xAxis: frame, lineStyle: { color: color(frame), width: 1, type: isCurrent(frame) ? 'solid' : [2, 4] },
        })),
      },
    };
  }

  const nearest = (list, value) => list.reduce((a, b) => (Math.abs(b - value) < Math.abs(a - value) ? b : a));

  function frameRows(frame) {
    const quantity = quantityOf(state.quantity);
    const rows = [];
    configurations.forEach((c, index) => {
      if (hidden.has(index)) return;
      const v = valueAt(index, state.quantity, frame);
      const of = valueAt(baseline, state.quantity, frame);
      const comparable = index !== baseline && quantity.scales.includes('ratio') && v != null && of > 0;
      const same = v == null && quantity.key === 'psnr' && valueAt(index, 'flip', frame) != null;
      rows.push([index, c.name, same ? 'equal' : quantity.format(v), comparable ? `\u00d7 ${ratio(v / of)}` : '']);
    });
    return rows;
  }
  function frameTip(parameters) {
    const found = (Array.isArray(parameters) ? parameters : [parameters]).find((p) => p.seriesId !== 'kept');
    if (!found) return '';
    const frame = nearest(allFrames, found.axisValue ?? found.value[0]);
    return tip(`frame ${frame}, ${quantityOf(state.quantity).label}`, frameRows(frame));
  }

  function framesSection() {
    const section = byId('frames');
    const several = allFrames.length > 1 && QUANTITIES.length > 0;
    if (!several) {
      section.append(element('p', null,
        measured ? 'One frame was measured: the table above says all about it.' : 'Nothing has been measured yet.'));
    }
    if (!chartsLibrary && (several || sweep)) {
      section.append(element('p', null,
        'The charts are missing because the program was built without the charts library; '
        + 'the values of each frame are in frames.csv.'));
    }
    if (!several || !chartsLibrary) return;
    state.quantity = QUANTITIES[0].key;
    const medians = configurations.map((c) => c.triangles?.median).filter((v) => v > 0);
    // One that draws everything would press the others onto the axis.
    if (Math.max(...medians) > 10 * Math.min(...medians)) state.scale = 'log';
    const scales = choice('scale', 'scale',
      [['linear', 'linear'], ['log', 'logarithmic'], ['ratio', 'ratio to the baseline']],
      state.scale, (value) => { state.scale = value; draw(); });
    const allowed = () => quantityOf(state.quantity).scales.filter((s) => s !== 'ratio' || configurations.length > 1);
    const quantities = choice('quantity', 'show', QUANTITIES.map((q) => [q.key, q.label]), state.quantity, (value) => {
      state.quantity = value;
      draw();
    });
    const plot = element('div', { class: 'plot', tabindex: 0, role: 'application', 'aria-describedby': 'frames-keys' });
    const caption = element('figcaption', { class: 'numbered' });
    const hints = element('span', { class: 'hint' });
    section.append(element('div', { class: 'controls' }, quantities.node, scales.node),
      element('figure', { class: 'chart' }, legend(configurations.map((_, i) => i)), plot, caption));
    const keys = element('p', { class: 'unseen', id: 'frames-keys' },
      `Left and right move from frame to frame, plus and minus zoom, 0 shows all${
        kept.length ? ', Enter shows the nearest pictures' : ''}.`);
    section.append(keys);
    // The library swallows every turn of the wheel, even those it does not zoom by; these belong to the page.
    const spare = (event) => event.ctrlKey || event.stopPropagation();
    for (const type of ['wheel', 'mousewheel']) plot.addEventListener(type, spare, { capture: true, passive: true });
    let window_ = { start: 0, end: 100 };
    const chart = createChart('frames', plot, () => framesOption(plot, window_));
    chart.on('datazoom', () => {
      const zoom = chart.getOption().dataZoom[0];
      window_ = { start: zoom.start, end: zoom.end };
    });
    function draw() {
      if (!allowed().includes(state.scale)) state.scale = 'linear';
      scales.set(state.scale);
      scales.allow(allowed());
      const quantity = quantityOf(state.quantity);
      const long = capital(quantity.long);
      const over = state.scale === 'ratio' ? `, over that of ${base.name} in the same frame` : '';
      caption.textContent = `${long}${over}. `;
      if (quantity.key === 'psnr') caption.append('Gaps: the picture equals the reference. ');
      hints.textContent = `${kept.length ? 'Marks at the foot: frames with pictures; a click shows the nearest. ' : ''}`
        + 'Ctrl and the wheel zoom, the slider too; with the keyboard: arrows, + and \u2212.';
      caption.append(hints);
      plot.setAttribute('aria-label', `Chart over the frames: ${quantity.long}`);
      redraw.forEach((again) => again());
    }
    draw();
    frameKeys(plot, chart, () => window_);
    if (kept.length === 0) return;
    chart.getZr().on('click', (event) => {
      const at = [event.offsetX, event.offsetY];
      if (!chart.containPixel({ gridIndex: 0 }, at)) return;
      viewer.show(chart.convertFromPixel({ xAxisIndex: 0 }, event.offsetX));
    });
    const jumps = element('div', { class: 'controls' },
      element('div', { class: 'field' }, element('b', null, 'pictures at frame'),
      kept.map(({ frame }) => element('button', { type: 'button', click: () => viewer.show(frame) }, String(frame)))));
    section.querySelector('figure').after(jumps);
  }

  /// What a mouse does on the chart over the frames, by keyboard.
  function frameKeys(plot, chart, currentWindow) {
    let at = -1;
    const visible = () => configurations.map((_, i) => i).filter((i) => !hidden.has(i));
    function point(to) {
      at = Math.max(0, Math.min(allFrames.length - 1, to));
      const index = visible().find((i) => series[i].at.has(allFrames[at]));
      if (index == null) return;
      chart.dispatchAction({ type: 'showTip', seriesIndex: index, dataIndex: series[index].at.get(allFrames[at]) });
      const texts = frameRows(allFrames[at]).map(([, name, text]) => `${name} ${text}`);
      speak(`Frame ${allFrames[at]}: ${texts.join(', ')}`);
    }
    function zoom(factor) {
      const { start, end } = currentWindow();
      const middle = at < 0 ? (start + end) / 2
        : (100 * (allFrames[at] - allFrames[0])) / (allFrames[allFrames.length - 1] - allFrames[0]);
      const half = Math.min(50, ((end - start) / 2) * factor);
      const from = Math.max(0, Math.min(100 - 2 * half, middle - half));
      chart.dispatchAction({ type: 'dataZoom', start: from, end: from + 2 * half });
    }
    const actions = {
      ArrowLeft: (e) => point((at < 0 ? allFrames.length : at) - (e.shiftKey ? 10 : 1)),
      ArrowRight: (e) => point(at + (e.shiftKey ? 10 : 1)),
      Home: () => point(0),
      End: () => point(allFrames.length - 1),
      '+': () => zoom(0.5),
      '=': () => zoom(0.5),
      '-': () => zoom(2),
      0: () => chart.dispatchAction({ type: 'dataZoom', start: 0, end: 100 }),
      Enter: () => kept.length && viewer.show(at < 0 ? kept[0].frame : allFrames[at]),
      Escape: () => chart.dispatchAction({ type: 'hideTip' }),
    };
    listenForKeys(plot, actions);
    plot.addEventListener('blur', () => chart.dispatchAction({ type: 'hideTip' }));
  }

  /// @param actions  by key; one that returns false leaves the key to the browser
  function listenForKeys(node, actions) {
    node.addEventListener('keydown', (event) => {
      if (event.target !== node || event.ctrlKey || event.metaKey || event.altKey
        || !Object.hasOwn(actions, event.key)) return;
      if (actions[event.key](event) !== false) event.preventDefault();
    });
  }

  // Quality at equal cost ----------------------------------------------------

  const curves = (sweep?.curves ?? []).filter((curve) => indexOf.has(curve.name))
    .map((curve) => ({ index: indexOf.get(curve.name), points: curve.points }));

  /// Points that nothing beats in both cost and FLIP.
  function front(cost) {
    if (cost === 'triangles') return sweep.pareto;
    const points = curves.flatMap((curve) => curve.points).filter((p) => p[cost] > 0)
      .sort((a, b) => a[cost] - b[cost] || a.flip - b.flip);
    let least = Infinity;
    return points.filter((p) => p.flip < least && ((least = p.flip), true));
  }

  function sweepOption(node) {
    const t = chartColors();
    const cost = state.axis;
    const all = curves.flatMap((curve) => curve.points);
    const positive = all.map((p) => p.flip).filter((v) => v > 0);
    // Without any error there is no logarithm: such points lie on the foot of the chart.
    const foot = positive.length ? Math.min(...positive) / 2 : 1e-4;
    const flips = all.map((p) => Math.max(p.flip, foot));
    const place = (p) => [Math.log10(Math.max(p[cost], 1e-6)), Math.log10(Math.max(p.flip, foot))];
    const room = Math.max(3, Math.floor(node.clientWidth / 75));
    const lines = curves.map(({ index, points }) => {
      const color = variable(`--series-${styleOf(index)}`);
      return {
        id: `c${index}`, name: `c${index}`, type: 'line', z: 4,
        data: [...points].sort((a, b) => a[cost] - b[cost]).map((point) => ({ value: place(point), point })),
        symbol: `path://${SYMBOLS[styleOf(index)]}`, symbolSize: 10, showSymbol: true, showAllSymbol: true,
        lineStyle: { color, width: 1.8, type: dashOf(index) },
        itemStyle: { color }, emphasis: { scale: 1.5 },
      };
    });
    const selected = {};
    curves.forEach(({ index }) => { selected[`c${index}`] = !hidden.has(index); });
    return {
      animation: false,
      grid: { left: 6, right: 20, top: 30, bottom: 30, containLabel: true },
      legend: { show: false, selected },
      tooltip: {
        ...tooltipStyle(t), trigger: 'item', formatter: (p) => pointTip(curveOfSeries(p.seriesId), p.data.point),
      },
      xAxis: axis(axisStyle(t), logAxis(all.map((p) => p[cost]), room, cost === 'triangles' ? countTick : brief), {
        type: 'value', name: cost === 'triangles' ? 'triangles' : 'frame time, ms', nameLocation: 'middle', nameGap: 28,
      }),
      yAxis: axis(axisStyle(t), logAxis(flips, 10, brief), {
        type: 'value', name: 'FLIP', nameLocation: 'end', nameGap: 12, nameTextStyle: { align: 'right' },
      }),
      series: [...lines, {
        id: 'front', name: 'front', type: 'line', z: 1, silent: true, symbol: 'none', data: front(cost).map(place),
        lineStyle: { color: t.accent, width: 11, opacity: 0.22, cap: 'round', join: 'round' },
        emphasis: { disabled: true }, tooltip: { show: false },
      }],
    };
  }
  const curveOfSeries = (id) => curves.find(({ index }) => `c${index}` === id);

  const pointTexts = (p) => [
    `${count(p.triangles)} triangles`, `${milliseconds(p.frame_ms)} ms`, `FLIP ${small(p.flip)}`,
    p.psnr == null ? 'PSNR: equal' : `${decibel(p.psnr)} dB`, `SSIM ${small(p.ssim)}`,
  ];
  function pointTip(curve, point) {
    if (!curve || !point) return '';
    return element('div', { class: 'tip' },
      tip(`\u03c4 = ${point.tau}`, [[curve.index, configurations[curve.index].name]]),
      pointTexts(point).map((text) => element('div', null, text)));
  }

  function sweepSection() {
    const section = byId('sweep');
    if (!sweep || curves.length === 0) {
      section.hidden = true;
      return;
    }
    section.append(element('p', null,
      'Each configuration was run with several error budgets \u03c4; means over the kept frames. '
      + 'Curves further down and to the left are better: less error for less work.'));
    if (chartsLibrary) {
      const costs = [['triangles', 'triangles'], ['frame_ms', 'frame time']];
      const axes = choice('axis', 'cost', costs, state.axis, (value) => {
        state.axis = value;
        redraw.forEach((draw) => draw());
        caption();
      });
      const plot = element('div', { class: 'plot tall', tabindex: 0, role: 'application',
        'aria-describedby': 'sweep-keys' });
      const text = element('figcaption', { class: 'numbered' });
      const caption = () => {
        const what = state.axis === 'triangles' ? 'triangles' : 'frame time';
        plot.setAttribute('aria-label', `Chart of the sweep: FLIP over ${what}`);
        text.textContent = `FLIP over ${what}, both logarithmic. `
          + 'Band: the Pareto front, the points that no other beats in both. ';
        text.append(element('span', { class: 'hint' },
          'Hover over a point, or use the arrow keys, for its \u03c4 and figures.'));
      };
      caption();
      section.append(element('div', { class: 'controls' }, axes.node),
        element('figure', { class: 'chart' }, legend(curves.map(({ index }) => index)), plot, text),
        element('p', { class: 'unseen', id: 'sweep-keys' },
          'Left and right move along a curve, up and down to another.'));
      sweepKeys(plot, createChart('sweep', plot, () => sweepOption(plot)));
    }
    sweepTables(section);
  }

  function sweepKeys(plot, chart) {
    let [curve, place] = [0, -1];
    function point(toCurve, toPlace) {
      const visible = curves.filter(({ index }) => !hidden.has(index));
      if (visible.length === 0) return;
      curve = (toCurve + visible.length) % visible.length;
      const chosen = visible[curve];
      place = Math.max(0, Math.min(chosen.points.length - 1, toPlace));
      chart.dispatchAction({ type: 'showTip', seriesIndex: curves.indexOf(chosen), dataIndex: place });
      const shown = [...chosen.points].sort((a, b) => a[state.axis] - b[state.axis])[place];
      speak(`${configurations[chosen.index].name}, tau ${shown.tau}: ${pointTexts(shown).join(', ')}`);
    }
    listenForKeys(plot, {
      ArrowLeft: () => point(curve, place - 1),
      ArrowRight: () => point(curve, place + 1),
      ArrowUp: () => point(curve - 1, Math.max(place, 0)),
      ArrowDown: () => point(curve + 1, Math.max(place, 0)),
      Escape: () => chart.dispatchAction({ type: 'hideTip' }),
    });
    plot.addEventListener('blur', () => chart.dispatchAction({ type: 'hideTip' }));
  }

  function sweepTables(section) {
    const rows = curves.map(({ index }) => index);
    const nameOf = (index) => configurations[index].name;
    const pair = element('div', { class: 'pair' });
    const budgets = sweep.triangles_at_flip ?? [];
    if (budgets.length) {
      const columns = budgets.map(({ flip, triangles }) => {
        const at = (i) => triangles[nameOf(i)] ?? null;
        const comparable = (i) => i !== baseline && at(i) != null && at(baseline) > 0;
        return { head: `FLIP \u2264 ${flip}`, better: -1, key: at, cell: (i) => count(at(i)),
          note: (i) => (comparable(i) ? `\u00d7 ${ratio(at(i) / at(baseline))}` : null) };
      });
      pair.append(tableFigure('Triangles at equal FLIP',
        `Triangles that a FLIP takes${rows.length > 1 ? '; below them the ratio to the baseline' : ''}.`,
        configurationTable(columns, rows), 'narrow'));
    }
    const equal = sweep.flip_at_triangles;
    if (equal?.rows?.length) {
      const columns = equal.rows.map(({ tau, triangles, flip }) => {
        const at = (i) => flip[nameOf(i)] ?? null;
        return { head: count(triangles), sub: `\u03c4 ${tau}`, better: -1, key: at, cell: (i) => small(at(i)) };
      });
      pair.append(tableFigure('FLIP at equal triangles',
        element('span', null, 'FLIP at the triangles of ', named(equal.of), ', with \u03c4 as in the head.'),
        configurationTable(columns, rows), 'narrow'));
    }
    const outside = configurations.map((_, i) => i).filter((i) => !rows.includes(i)).map(nameOf);
    section.append(pair, element('p', null, `${NONE}: the curve does not reach there, and nothing is extrapolated. `
      + 'Where even the coarsest point has a smaller FLIP, its triangles are given.'));
    if (outside.length) {
      section.append(element('p', null, 'Without \u03c4, and so not in the sweep: ',
        outside.map((name, k) => [k > 0 ? ', ' : '', named(name)]), '.'));
    }
    const head = ['configuration', '\u03c4', 'triangles', 'frame time, ms', 'FLIP', 'PSNR, dB', 'SSIM']
      .map((text, k) => element('th', { scope: 'col', class: k ? null : 'corner' }, text));
    const body = element('tbody', { class: 'rows' });
    for (const { index, points } of curves) {
      points.forEach((p, k) => {
        const psnr = p.psnr == null ? 'equal' : decibel(p.psnr);
        const texts = [String(p.tau), count(p.triangles), milliseconds(p.frame_ms), small(p.flip), psnr, small(p.ssim)];
        body.append(element('tr', null,
          k > 0 ? null : element('th', { scope: 'rowgroup', rowspan: points.length, class: 'corner' }, owner(index)),
          texts.map((text) => element('td', null, text))));
      });
    }
    const table = element('table', null, element('thead', null, element('tr', null, head)), body);
    section.append(element('details', { open: !chartsLibrary }, element('summary', null, 'All points of the sweep'),
      tableFigure('All points of the sweep', 'Means over the kept frames.', table)));
  }

  // Pictures -----------------------------------------------------------------

  const REFERENCE = '-1';
  const LAYERS = [['image', 'picture'], ['error', 'error map'], ['lod', 'LOD map']];
  const MOST_RADIOS = 12;
  const LARGEST_ZOOM = 4;
  // Swaps a second: half of what three flashes a second would be.
  const FASTEST = 3;
  const layerText = (key) => LAYERS.find(([layer]) => layer === key)[1];
  const clamp = (v, low, high) => Math.max(low, Math.min(high, v));

  function ramp(kind, title, ...ends) {
    return element('div', { class: 'ramp' }, element('span', null, title), element('i', { class: kind }),
      element('div', null, ends.map((text) => element('span', null, text))));
  }

  /// Two pictures on top of each other, behind a split or in turn.
  class Viewer {
    constructor(section) {
      const chosen = candidate();
      const flipOf = (k) => valueAt(chosen, 'flip', k.frame) ?? -1;
      this.section = section;
      this.at = kept.reduce((worst, k, i) => (flipOf(k) > flipOf(kept[worst]) ? i : worst), 0);
      this.left = kept[0].reference ? REFERENCE : String(baseline);
      this.right = String(chosen);
      this.layer = 'image';
      this.mode = 'split';
      this.split = 50;  // percent
      this.zoom = 1;
      this.pan = [0, 0];  // of the picture's corner, in sizes of the stage
      this.shown = 'right';
      this.automatic = !calm;
      this.rate = 2;
      this.timer = 0;
      this.buildStage();
      section.append(
        element('div', { class: 'controls' }, this.frameControl(), this.sideControl('left'), this.sideControl('right')),
        element('div', { class: 'controls' },
          this.layerControl(), this.zoomControl(), this.modeControl(), this.flickerControl()),
        element('figure', { class: 'viewer' }, this.easel, this.scales, this.note),
        element('p', { class: 'unseen', id: 'stage-keys' },
          'Arrow keys move the split, or the zoomed picture; plus and minus zoom; space swaps in flicker mode.'));
      this.listenToPointer();
      this.listenToKeys();
      this.draw();
    }

    get frame() {
      return kept[this.at].frame;
    }

    state() {
      const { frame, layer, mode, split, shown, rate, zoom } = this;
      return {
        frame, layer, mode, split, shown, rate, zoom, pan: [...this.pan], flickering: this.timer !== 0,
        left: this.picture('left').name, right: this.picture('right').name,
      };
    }

    // What is shown

    buildStage() {
      this.sides = {};
      for (const side of ['right', 'left']) {
        const image = element('img', { alt: '', draggable: 'false' });
        const missing = element('p', { hidden: true });
        const layer = element('div', { class: `layer ${side}` }, image, missing);
        this.sides[side] = { image, missing, layer, tag: element('div', { class: `tag ${side}` }) };
      }
      const { left, right } = this.sides;
      this.handle = element('div', {
        class: 'handle', role: 'slider', tabindex: 0, 'aria-valuemin': 0, 'aria-valuemax': 100,
        'aria-orientation': 'horizontal', 'aria-label': 'Split between the left and the right picture',
      });
      this.stage = element('div', { class: 'stage', role: 'group', tabindex: 0, 'aria-describedby': 'stage-keys' },
        right.layer, left.layer, this.handle);
      this.stage.style.aspectRatio = `${summary.width} / ${summary.height}`;
      const tags = element('div', { class: 'tags' }, left.tag, right.tag);
      this.easel = element('div', { class: 'easel' }, tags, this.stage);
      // Picture and controls fit into the window together.
      this.easel.style.maxWidth = `min(100%, ${((70 * summary.width) / summary.height).toFixed(2)}vh)`;
      this.scales = element('div', { class: 'scales' });
      this.note = element('figcaption', { class: 'numbered' });
    }

    /// The reference has neither error nor levels: it is shown itself.
    picture(side) {
      const shot = kept[this.at];
      if (this[side] === REFERENCE) return { name: 'reference', uri: shot.reference, layer: 'image' };
      const index = Number(this[side]);
      const { name } = configurations[index];
      return { name, index, uri: shot.pictures.find((p) => p.name === name)?.[this.layer] ?? null, layer: this.layer };
    }

    figures(index) {
      const at = (key) => valueAt(index, key, this.frame);
      const [flip, psnr, triangles] = [at('flip'), at('psnr'), at('triangles')];
      const parts = flip == null ? [] : [`FLIP ${small(flip)}`, psnr == null ? 'equal' : `${decibel(psnr)} dB`];
      if (triangles != null) parts.push(`${count(triangles)} tri.`);
      return parts.join(' \u00b7 ');
    }

    drawSide(side) {
      const { image, missing, tag, layer } = this.sides[side];
      const shown = this.picture(side);
      if (shown.uri && image.getAttribute('src') !== shown.uri) image.src = shown.uri;
      image.alt = `${shown.name}, frame ${this.frame}, ${layerText(shown.layer)}`;
      image.hidden = !shown.uri;
      missing.hidden = Boolean(shown.uri);
      missing.textContent = `no ${layerText(this.layer)} of ${shown.name} was kept`;
      image.style.transform = `translate(${this.pan.map((p) => `${p * 100}%`)}) scale(${this.zoom})`;
      const figures = shown.index == null ? '' : this.figures(shown.index);
      tag.replaceChildren(this.layer === 'image' ? shown.name : `${shown.name}: ${layerText(shown.layer)}`,
        figures ? element('small', null, figures) : '');
      const flicker = this.mode === 'flicker';
      tag.classList.toggle('shown', flicker && this.shown === side);
      layer.style.visibility = flicker && this.shown !== side ? 'hidden' : 'visible';
      layer.style.clipPath = !flicker && side === 'left' ? `inset(0 ${100 - this.split}% 0 0)` : 'none';
    }

    draw() {
      const flicker = this.mode === 'flicker';
      this.pan = this.pan.map((p) => clamp(p, 1 - this.zoom, 0));
      this.drawSide('left');
      this.drawSide('right');
      this.easel.classList.toggle('flicker', flicker);
      this.stage.classList.toggle('zoomed', this.zoom > 1);
      this.stage.classList.toggle('split', !flicker && this.zoom === 1);
      this.stage.setAttribute('aria-label',
        `Pictures of frame ${this.frame}: ${this.picture('left').name} and ${this.picture('right').name}`);
      this.handle.hidden = flicker;
      this.handle.style.left = `${this.split}%`;
      this.handle.setAttribute('aria-valuenow', this.split.toFixed(0));
      this.handle.setAttribute('aria-valuetext', `${this.split.toFixed(0)} % left`);
      this.flickerControls.hidden = !flicker;
      this.scales.replaceChildren(...this.ramps());
      let hint = 'Drag the handle, or use the arrow keys, to move the split.';
      if (this.zoom > 1) hint = 'Drag the picture, or use the arrow keys, to move it.';
      if (flicker) hint = 'Space or a click on the picture swaps.';
      const note = data.pictures_note ? `${data.pictures_note.replace(/\.$/, '')}. ` : '';
      this.note.replaceChildren(`Frame ${this.frame}. ${note}`, element('span', { class: 'hint' }, hint));
    }

    ramps() {
      if (this.layer === 'error') return [ramp('error', 'FLIP of a pixel', '0', '0.25', '0.5', '0.75', '1')];
      if (this.layer !== 'lod') return [];
      return [ramp('lod', 'level of an object', 'finest', 'coarsest'),
        ramp('occluder', 'the same, of occluders of the map', 'finest', 'coarsest')];
    }

    // What changes it

    goTo(index) {
      this.at = index;
      this.markFrame();
      this.draw();
      charts.frames?.setOption({ series: [keptMarks(chartColors())] });
    }

    /// The kept frame nearest to a frame, from elsewhere on the page.
    show(frame) {
      const found = nearest(kept.map((k) => k.frame), frame);
      this.goTo(kept.findIndex((k) => k.frame === found));
      this.section.scrollIntoView({ behavior: calm ? 'auto' : 'smooth' });
      this.stage.focus({ preventScroll: true });
    }

    splitTo(percent) {
      this.split = clamp(percent, 0, 100);
      this.draw();
    }

    move(dx, dy) {
      this.pan = [this.pan[0] + dx, this.pan[1] + dy];
      this.draw();
    }

    /// Keeps the middle of the picture where it is.
    zoomTo(zoom) {
      this.pan = this.pan.map((p) => 0.5 - ((0.5 - p) / this.zoom) * zoom);
      this.zoom = zoom;
      this.zooms.set(String(zoom));
      this.draw();
    }

    swap() {
      this.shown = this.shown === 'left' ? 'right' : 'left';
      this.drawSide('left');
      this.drawSide('right');
    }

    swapByHand() {
      this.automatic = this.automaticBox.checked = false;
      this.schedule();
      this.swap();
      speak(`${this.picture(this.shown).name} is shown`);
    }

    schedule() {
      clearInterval(this.timer);
      this.timer = this.mode === 'flicker' && this.automatic ? setInterval(() => this.swap(), 1000 / this.rate) : 0;
    }

    // Controls

    frameControl() {
      if (kept.length <= MOST_RADIOS) {
        const options = kept.map((k, i) => [String(i), String(k.frame)]);
        const radios = choice('frame', 'frame', options, String(this.at), (value) => this.goTo(Number(value)));
        this.markFrame = () => radios.set(String(this.at));
        return radios.node;
      }
      const slider = element('input', {
        type: 'range', min: 0, max: kept.length - 1, step: 1, value: this.at, 'aria-label': 'Frame',
        input: () => this.goTo(Number(slider.value)),
      });
      const output = element('output', null, String(this.frame));
      this.markFrame = () => {
        slider.value = this.at;
        slider.setAttribute('aria-valuetext', `frame ${this.frame}`);
        output.textContent = this.frame;
      };
      return element('div', { class: 'field' }, element('b', null, 'frame'), slider, output);
    }

    sideControl(side) {
      const shot = (name) => kept.some((k) => k.pictures.some((p) => p.name === name));
      const names = configurations.map((c, i) => [String(i), c.name]).filter(([, name]) => shot(name));
      if (kept[0].reference) names.unshift([REFERENCE, 'reference']);
      const select = element('select', { 'aria-label': `${side} picture`, change: () => {
        this[side] = select.value;
        this.draw();
      } }, names.map(([value, text]) => element('option', { value, selected: this[side] === value }, text)));
      return element('label', { class: 'field wide' }, element('b', null, side), select);
    }

    layerControl() {
      return choice('layer', 'layer', LAYERS, this.layer, (value) => {
        this.layer = value;
        this.draw();
      }).node;
    }

    zoomControl() {
      const options = [['1', 'fit'], ['2', '2\u00d7'], ['4', '4\u00d7']];
      this.zooms = choice('zoom', 'zoom', options, '1', (value) => this.zoomTo(Number(value)));
      return this.zooms.node;
    }

    modeControl() {
      return choice('mode', 'compare by', [['split', 'split'], ['flicker', 'flicker']], this.mode, (value) => {
        this.mode = value;
        this.draw();
        this.schedule();
      }).node;
    }

    flickerControl() {
      this.automaticBox = element('input', { type: 'checkbox', checked: this.automatic, change: () => {
        this.automatic = this.automaticBox.checked;
        this.schedule();
      } });
      const text = element('output', null, `${this.rate} Hz`);
      const rate = element('input', { type: 'range', min: 0.5, max: FASTEST, step: 0.5, value: this.rate,
        'aria-label': 'Swaps per second', input: () => {
          this.rate = clamp(Number(rate.value), 0.5, FASTEST);
          text.textContent = `${this.rate} Hz`;
          this.schedule();
        } });
      this.flickerControls = element('div', { class: 'field' },
        element('label', null, this.automaticBox, 'automatic'), rate, text,
        element('button', { type: 'button', click: () => this.swapByHand() }, 'Swap'));
      return this.flickerControls;
    }

    // Pointer and keys

    listenToPointer() {
      let drag = null;
      const splitAt = (event) => {
        const box = this.stage.getBoundingClientRect();
        this.splitTo((100 * (event.clientX - box.left)) / box.width);
      };
      this.stage.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        const splits = this.mode === 'split' && (event.target === this.handle || this.zoom === 1);
        drag = { splits, x: event.clientX, y: event.clientY, moved: false };
        this.stage.setPointerCapture(event.pointerId);
        // A finger may be about to scroll the page.
        if (splits && event.pointerType === 'mouse') splitAt(event);
        this.stage.classList.toggle('panning', !splits && this.zoom > 1);
      });
      this.stage.addEventListener('pointermove', (event) => {
        if (!drag) return;
        const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
        drag.moved ||= Math.hypot(dx, dy) > 3;
        if (drag.splits) splitAt(event);
        if (drag.splits || this.zoom === 1 || !drag.moved) return;
        const box = this.stage.getBoundingClientRect();
        this.move(dx / box.width, dy / box.height);
        [drag.x, drag.y] = [event.clientX, event.clientY];
      });
      const release = (event) => {
        if (drag && !drag.moved && this.mode === 'flicker' && event.type === 'pointerup') this.swapByHand();
        drag = null;
        this.stage.classList.remove('panning');
      };
      this.stage.addEventListener('pointerup', release);
      this.stage.addEventListener('pointercancel', release);
    }

    listenToKeys() {
      const step = (event) => (event.shiftKey ? 10 : 2);
      const by = (sign) => (event) => this.splitTo(this.split + sign * step(event));
      listenForKeys(this.handle, {
        ArrowLeft: by(-1), ArrowDown: by(-1), ArrowRight: by(1), ArrowUp: by(1),
        PageDown: () => this.splitTo(this.split - 10),
        PageUp: () => this.splitTo(this.split + 10),
        Home: () => this.splitTo(0),
        End: () => this.splitTo(100),
      });
      const arrow = (dx, dy) => (event) => {
        if (this.zoom > 1) this.move(-0.1 * dx, -0.1 * dy);
        else if (dx !== 0 && this.mode === 'split') by(dx)(event);
        else return false;  // the page may scroll
        return true;
      };
      listenForKeys(this.stage, {
        ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, -1), ArrowDown: arrow(0, 1),
        '+': () => this.zoomTo(Math.min(LARGEST_ZOOM, this.zoom * 2)),
        '=': () => this.zoomTo(Math.min(LARGEST_ZOOM, this.zoom * 2)),
        '-': () => this.zoomTo(Math.max(1, this.zoom / 2)),
      });
      this.section.addEventListener('keydown', (event) => {
        // On radio buttons and pictures the space bar has no other meaning.
        const free = event.target === this.stage || event.target.type === 'radio';
        if (event.key !== ' ' || this.mode !== 'flicker' || !free) return;
        event.preventDefault();
        this.swapByHand();
      });
    }
  }

  let viewer = null;

  function picturesSection() {
    const section = byId('pictures');
    section.hidden = kept.length === 0;
    if (kept.length > 0) viewer = new Viewer(section);
  }

  // Where time and objects go ------------------------------------------------

  // Drawing in blue, all that decides what to draw in earth colours; [fill, text].
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

  /// A bar chart and its numbers, which print and screen readers need.
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
      'Median time of each pass, times the share of frames in which it ran. Blue: drawing; earth colours: deciding '
      + 'what to draw. The sum may differ from the median frame time.', columns, rows, 'Milliseconds per frame.'));
  }

  function levelBars(section, rows) {
    const levels = (i) => configurations[i].lod_histogram_mean ?? [];
    const most = Math.max(0, ...rows.map((i) => levels(i).length));
    if (!rows.some((i) => sum(levels(i)) > 0)) return;
    const mix = (a, b, t) => Math.round(a + (b - a) * t);
    // From the dark blue of the LOD map to its light one.
    const color = (k) => {
      const t = most > 1 ? k / (most - 1) : 0;
      return [`rgb(${mix(16, 205, t)} ${mix(39, 238, t)} ${mix(160, 255, t)})`, t < 0.55 ? '#fff' : '#000'];
    };
    const parts = (i) => levels(i).map((value, k) => ({ text: String(k), value, color: color(k) }));
    const columns = Array.from({ length: most }, (_, k) => ({ head: String(k), cell: (i) => count(levels(i)[k]) }));
    const patches = configurations.some((c) => /tessellation/.test(c.options ?? ''))
      ? '; with tessellation, levels count up from the coarsest' : '';
    const chart = barChart(rows, parts, (v) => `${count(v)} objects`, 'levels');
    section.append(...barFigure('Objects per level of detail', chart,
      `Drawn objects by level, means over the frames; level 0, dark, is the finest${patches}.`,
      columns, rows, 'Drawn objects, means over the frames; columns are levels.'));
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

  // What was measured --------------------------------------------------------

  const WALL_TIME = 'Wall time between two glFinish around each pass, because timer queries are wrong on software '
    + 'renderers; the frame time is their sum. Absolute times mean nothing here, and do not carry over to a GPU; '
    + 'ratios on the same machine do mean something.';
  const GPU_TIME = 'Timestamps on the GPU around each pass; the frame time is their sum. What the CPU does besides is '
    + 'not in it.';
  const REFERENCES = {
    none: 'None: nothing was drawn, only the passes that decide what to draw were run. Times are theirs, and there is '
      + 'no error.',
    lod0: 'Every object at its finest level, culled in two phases, which loses no pixel.',
    full: 'Every object at its finest level, nothing culled.',
  };

  function explanations() {
    const { step, lead } = frames;
    const gaps = step > 1
      ? ` Every ${step}th frame was measured; ${lead} frames before it were run unmeasured, so that history is as on `
        + 'the full path.' : '';
    const planned = frames.kept?.length ?? 0;
    const spread = planned > 1 ? ` ${planned} frames, evenly spread, are kept: their pictures are on this page.` : '';
    const pairs = [
      ['Configuration', 'One way to render the scene: how objects are culled, how levels of detail are chosen, and '
        + 'with which parameters. The options below each name are those of jalousie render.'],
      ['Frames', 'All configurations run in one process, interleaved: each frame of the path is rendered by all of '
        + `them before the next one, and another one goes first each time. A frame of warm-up is not counted.${gaps}`
        + spread],
      ['Median, quartiles, ratio', 'Half of the frames lie below the median, and half between the quartiles. A ratio '
        + 'is formed in each frame, with the baseline in the same frame; its median and quartiles are shown. Quartiles '
        + 'on both sides of 1 mean: no clear difference.'],
      [capital(timeName), summary.timing === 'gpu' ? GPU_TIME : WALL_TIME],
      ['Reference', REFERENCES[summary.reference] ?? 'Unknown.'],
    ];
    if (summary.reference !== 'none') pairs.push(...errorExplanations());
    if (sweep) {
      pairs.push(['Sweep', 'The error budget \u03c4 is varied on the kept frames. Between measured points, values are '
        + 'interpolated linearly between logarithms of triangles and FLIP; outside of them nothing is claimed.']);
    }
    pairs.push(['Files beside', 'frames.csv has every value of each frame, summary.json the figures of this page.']);
    return pairs;
  }

  function errorExplanations() {
    return [
      ['PSNR, SSIM', 'PSNR over the three channels, in decibels; its mean is that of the squared errors. SSIM over '
        + 'windows of 8\u00d78 pixels, mean of red, green and blue. \u201cEqual\u201d and 1: no difference.'],
      ['FLIP', 'LDR-FLIP (Andersson et al. 2020) predicts how large a difference appears when two pictures are flipped '
        + `in place, at ${ratio(summary.pixels_per_degree)} pixels per degree of vision. Each pixel has an error `
        + 'between 0 and 1; the figure is the mean of the error map.'],
      ['Popping', 'Switches: of the objects that show at least one pixel, the share that has another level than in the '
        + 'frame before. Frozen: the camera stands still while the state advances by one frame; what changes then is '
        + 'level switches alone, given as FLIP of the pixel that changes most and as mean. Temporal FLIP: mean of '
        + '|FLIP(I\u2096, I\u2096\u208b\u2081) \u2212 FLIP(R\u2096, R\u2096\u208b\u2081)| over the pixels, with I the '
        + 'picture and R the reference: change that the reference does not have, and change that it has and the '
        + 'picture lacks. Frozen is of the kept frames; temporal FLIP of the whole path where no frame of it is left '
        + 'out, else of the kept frames too.'],
    ];
  }

  function methodSection() {
    const section = byId('method');
    const list = element('dl');
    for (const [term, text] of explanations())
      list.append(element('div', null, element('dt', null, term), element('dd', null, text)));
    section.append(list);
    if (!summary.command) return;
    const pre = element('pre', { tabindex: 0, 'aria-label': 'Command' }, summary.command);
    const button = element('button', { type: 'button', class: 'plain', click: async () => {
      button.textContent = (await copy(summary.command, pre)) ? 'Copied' : 'Selected';
      speak(button.textContent);
      setTimeout(() => { button.textContent = 'Copy'; }, 1500);
    } }, 'Copy');
    section.append(element('h3', null, 'To repeat it'), element('div', { class: 'command' }, pre, button));
  }

  /// Some browsers give file: pages no clipboard; then the text is at least selected.
  async function copy(text, node) {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch {
      getSelection().selectAllChildren(node);
      return document.execCommand('copy');
    }
  }

  // Theme --------------------------------------------------------------------

  const PAPER_WIDTH = 960;  // pixels, of A4 and letter across

  function setTheme(name) {
    document.documentElement.dataset.theme = name;
    const other = name === 'dark' ? 'light' : 'dark';
    const button = byId('theme');
    button.textContent = other === 'dark' ? 'Dark' : 'Light';
    button.setAttribute('aria-label', `Switch to the ${other} theme`);
    redraw.forEach((draw) => draw());
  }

  function themes() {
    const system = window.matchMedia('(prefers-color-scheme: dark)');
    let chosen = null;
    const current = () => chosen ?? (system.matches ? 'dark' : 'light');
    system.addEventListener('change', () => setTheme(current()));
    byId('theme').addEventListener('click', () => {
      chosen = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
      setTheme(chosen);
    });
    window.addEventListener('beforeprint', () => {
      setTheme('light');
      // Canvases do not follow the paper by themselves, and there is no next frame in which they would be drawn.
      for (const chart of Object.values(charts)) {
        chart.resize({ width: Math.min(chart.getWidth(), PAPER_WIDTH) });
        chart.getZr().flush();
      }
    });
    window.addEventListener('afterprint', () => {
      setTheme(current());
      for (const chart of Object.values(charts)) chart.resize({ width: 'auto' });
    });
    setTheme(current());
  }

  const longest = Math.max(0, ...configurations.map((c) => c.name.length));
  document.documentElement.style.setProperty('--longest', `${longest}ch`);
  head();
  themes();
  results();
  picturesSection();  // first: the chart over the frames marks the viewer's frame
  framesSection();
  sweepSection();
  passesSection();
  methodSection();
  contents();

  window.jalousieReport = {
    charts,
    state: () => ({
      ...state, theme: document.documentElement.dataset.theme, hidden: [...hidden].map((i) => configurations[i].name),
      viewer: viewer?.state() ?? null,
    }),
  };
})();

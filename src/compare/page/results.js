// The head of the page and the table of results.

// Head ---------------------------------------------------------------------

// Without pictures only the culling passes run.
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
    summary.triangles_full ? `${count(summary.triangles_full)} triangles at the finest level` : null,
    summary.renderer,
    summary.timing === 'gpu' ? 'GPU timestamps' : 'wall time',
  ];
  byId('circumstances').append(...facts.filter(Boolean).map((fact) => element('li', null, fact)));
  if (summary.complete !== false) return;
  const banner = byId('banner');
  banner.hidden = false;
  const all = measured >= (frames.count ?? 0);
  const share = all ? 'all' : `${whole(measured)} of`;
  banner.append(element('b', null, `Interrupted after ${share} ${whole(frames.count)} frames.`),
    ` ${all ? 'Pictures or the sweep are incomplete.' : 'The figures cover the measured frames only.'}`);
}

function contents() {
  for (const section of document.querySelectorAll('main > section')) {
    if (section.hidden) continue;
    byId('contents').append(element('a', { href: `#${section.id}` }, section.querySelector('h2').textContent));
  }
}

// Results ------------------------------------------------------------------

/// Whether culling left out something that is visible.
const loses = (c) => c.lost?.pixels_most > 0;
const largestFlip = (c) => c?.error?.flip_covered?.largest ?? c?.error?.flip?.largest ?? null;
const flipName = configurations.some((c) => c.error?.flip_covered) ? 'FLIP over covered pixels' : 'FLIP';
const compared = configurations.some((c) => c.error);

/// The limit that is shown first: the error of the baseline, rounded up to two digits.
function firstLimit() {
  const error = largestFlip(base) ?? 0.05;
  const unit = 10 ** (Math.floor(Math.log10(Math.max(error, 0.001))) - 1);
  return Math.min(Math.max(Math.ceil(error / unit) * unit, 0.001), 1);
}

const costs = new Map([
  ['triangles', { noun: 'triangles', of: (c) => c.triangles_ratio.median }],
  ['time', { noun: timeName, of: (c) => c.frame_ratio.median }],
]);

/// The configurations that lose nothing and whose worst frame is within the limit.
const within = (limit) =>
  configurations.filter((c) => c.frames > 0 && !loses(c) && largestFlip(c) != null && largestFlip(c) <= limit);
/// The cheapest of some configurations; null if there are none.
const cheapest = (some, cost) =>
  (some.length === 0 ? null : some.reduce((a, b) => (cost.of(b) < cost.of(a) ? b : a)));

/// Index of the configuration whose pictures are shown first: the recommended one, or the cheapest rival of the
/// baseline, of those that lose nothing if there are any.
function subject() {
  const cost = costs.get('triangles');
  const pick = compared ? cheapest(within(firstLimit()), cost) : null;
  if (pick && pick !== base) return configurations.indexOf(pick);
  const others = configurations.filter((c) => c !== base && c.frames > 0);
  const honest = others.filter((c) => !loses(c));
  return configurations.indexOf(cheapest(honest, cost) ?? cheapest(others, cost) ?? base);
}

function leadSentence(limit, cost) {
  if (!measured) return ['Nothing has been measured yet.'];
  if (!compared) return ['Pictures were not compared, so no configuration is recommended.'];
  const start = `Within a ${flipName} of ${small(limit)} in the worst frame, `;
  const fit = within(limit);
  const c = cheapest(fit, cost);
  if (!c) return [start, 'no configuration shows every visible object.'];
  const share = cost.of(c);
  const rest = c === base
    ? [fit.length > 1 ? 'nothing is cheaper than ' : 'only ', named(c.name), ' (the baseline)',
      fit.length > 1 ? '' : ' is left', '.']
    : [named(c.name), ` is the cheapest: ${percent(share)} of the ${cost.noun} of `, named(base.name),
      ` (the baseline), with ${small(largestFlip(c))} instead of ${small(largestFlip(base))}.`];
  return [start, ...rest];
}

const several = (number, noun) => `${whole(number)} ${noun}${number === 1 ? '' : 's'}`;

/// Which configurations are never recommended, and why; null if there are none.
function losers() {
  const all = configurations.filter(loses);
  if (all.length === 0) return null;
  const texts = all.map((c, i) => [i > 0 ? ', ' : '', named(c.name),
    ` (up to ${several(c.lost.objects_most, 'object')}, ${several(c.lost.pixels_most, 'pixel')} in a frame)`]);
  return ['Not recommended, because culling leaves out what is visible: ', ...texts, '.'];
}

/// The sentence with its error limit and its cost, which the reader can change.
function recommendation() {
  const lead = byId('lead');
  const setting = { limit: firstLimit(), cost: 'triangles' };
  const shown = element('output', { for: 'limit' });
  const show = () => {
    lead.replaceChildren(...leadSentence(setting.limit, costs.get(setting.cost)));
    shown.textContent = small(setting.limit);
  };
  show();
  if (!measured || !compared) return;
  const input = element('input', { type: 'range', id: 'limit', min: -3, max: 0, step: 0.01,
    value: Math.log10(setting.limit), 'aria-label': `largest ${flipName}` });
  input.addEventListener('input', () => {
    setting.limit = Number((10 ** Number(input.value)).toPrecision(2));
    show();
  });
  const cost = choice('cost', 'Cost', [['triangles', 'triangles'], ['time', timeName]], setting.cost, (value) => {
    setting.cost = value;
    show();
  });
  lead.after(element('div', { class: 'limit' },
    element('label', { for: 'limit' }, `Largest ${flipName}, worst frame`), input, shown, cost.node));
}

/// The sweep's result in one sentence, at the first of three FLIP values that the baseline's curve reaches.
function equalQuality() {
  const rows = sweep?.triangles_at_flip ?? [];
  const order = [1, 2, 0].map((i) => rows[i]).filter(Boolean);
  for (const row of order) {
    const own = row.triangles[base.name];
    const others = Object.entries(row.triangles)
      .filter(([name, v]) => name !== base.name && v != null && !loses(configurations[indexOf.get(name)] ?? {}));
    if (own == null || own <= 0 || others.length === 0) continue;
    const [name, least] = others.reduce((a, b) => (b[1] < a[1] ? b : a));
    const start = `At a FLIP of ${row.flip}, `;
    if (least >= own) return [start, 'no configuration needs fewer triangles than ', named(base.name), '.'];
    return [start, named(name), ` needs ${percent(least / own)} of the triangles of `, named(base.name), '.'];
  }
  return null;
}

/// Columns of the table of results, in groups. Columns without any value are left out.
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
    // The PSNR of equal pictures is null; it counts as the best.
    const get = (key) => of((c) => (c.error?.[measure] ? c.error[measure][key] ?? Infinity : null));
    const text = (key) => (i) => (get(key)(i) === Infinity ? 'equal' : format(get(key)(i)));
    const [mean, extreme] = [text('mean'), text(worst)];
    return {
      group: 'Error against the reference', head, better, key: get('mean'), cell: mean,
      note: (i) => (configurations[i].frames > 1 && extreme(i) !== mean(i) ? `${sign}\u2009${extreme(i)}` : null),
    };
  };
  const queries = (head, key, format = whole) => {
    const get = of((c) => c.queries?.[key]?.median);
    return { group: 'Occlusion queries', head, better: -1, key: get, cell: (i) => (get(i) == null ? '' : format(get(i))) };
  };
  const faces = (head, key) => {
    const get = of((c) => (c.faces && c.triangles.median > 0 ? c.faces[key].median / c.triangles.median : null));
    return { group: 'Back faces', head, better: key === 'faces_culled' ? 1 : -1, key: get,
      cell: (i) => (get(i) == null ? '' : percent(get(i))) };
  };
  const lost = (head, key) => ({
    group: 'Lost', head, better: -1, key: of((c) => c.lost?.[key]), cell: (i) => whole(of((c) => c.lost?.[key])(i)),
  });
  return [
    lost('objects', 'objects_most'),
    lost('pixels', 'pixels_most'),
    spread('Triangles', 'median', 'triangles', count),
    shareOf('Triangles', 'triangles_ratio'),
    spread(capital(timeName), 'ms', 'frame_ms', milliseconds),
    shareOf(capital(timeName), 'frame_ratio'),
    spread('Drawn', 'commands', 'draws', count),
    spread('Drawn', 'objects', 'drawn', count),
    spread('Drawn', 'per visible', 'drawn_per_visible', ratio),
    queries('queries', 'queries'),
    queries('waits', 'query_waits'),
    queries('round trips', 'query_round_trips'),
    queries('state changes', 'query_switches'),
    queries('CPU ms', 'query_decision_ns', (ns) => small(ns / 1e6)),
    faces('culled', 'faces_culled'),
    faces('left whole', 'faces_whole'),
    error('FLIP', 'flip', 'largest', '\u2264', small, -1),
    error('covered', 'flip_covered', 'largest', '\u2264', small, -1),
    error('PSNR', 'psnr', 'least', '\u2265', decibel, 1),
    error('SSIM', 'ssim', 'least', '\u2265', small, 1),
    error('Butteraugli', 'butteraugli', 'largest', '\u2264', small, -1),
    plain('Popping', 'switches', (c) => c.popping?.switches_per_visible_object),
    plain('Popping', 'frozen', (c) => c.popping?.frozen_flip_largest,
      (c) => (c.popping?.frozen_flip_mean > 0 ? `mean ${small(c.popping.frozen_flip_mean)}` : null)),
    plain('Popping', 'temporal', (c) => c.popping?.temporal_flip),
  ].filter((column) => configurations.some((_, i) => column.key(i) != null));
}

function results() {
  recommendation();
  for (const sentence of [losers(), equalQuality()].filter(Boolean))
    byId('results').append(element('p', { class: 'second' }, sentence));
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
    const title = element('th', { scope: 'row' }, owner(index), notes ? element('small', null, notes) : null,
      loses(c) ? element('small', { class: 'loses' }, 'loses visible objects') : null);
    const options = element('td', { colspan: columns.length + 1 }, element('code', null, c.options ?? ''));
    table.append(element('tbody', null,
      element('tr', null, title, columns.map((column, k) => cell(column, index, marks[k]))),
      c.options ? element('tr', { class: 'options' }, options) : null));
  }
  const many = measured > 1;
  const text = [many ? `Medians over ${whole(measured)} frames, with the quartiles below.` : 'One frame.'];
  if (rows.length > 1) {
    const where = many ? ' in the same frame' : '';
    text.push(`Ratios are to the baseline${where}. The best value of each column is marked.`);
  }
  text.push(compared
    ? `Errors are means${many ? ', with the worst frame below' : ''}; \u201ccovered\u201d is the FLIP over the pixels that `
      + 'show an object. Smaller is better for FLIP, larger for PSNR (dB) and SSIM. Lost: what culling left out in the '
      + 'worst frame although nothing hides it.'
    : 'Pictures were not compared, so the table has no errors and no popping.');
  if (columns.some((c) => c.group === 'Popping'))
    text.push('Popping: LOD switches per visible object and frame; FLIP of the worst pixel while the camera is frozen; '
      + 'temporal FLIP. \u201cHow it was measured\u201d explains them.');
  if (columns.some((c) => c.head === 'per visible'))
    text.push('Per visible: objects drawn over objects with a visible pixel.');
  if (columns.some((c) => c.group === 'Occlusion queries'))
    text.push('Waits: answers that no later answer had shown to be there. Round trips: waits for the newest query, with '
      + 'nothing left to do. CPU ms: the decision alone.');
  byId('results').append(tableFigure('Results', text.join(' '), table));
}

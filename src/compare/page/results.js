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

/// The configuration that the first sentence is about: the one with the fewest triangles, other than the baseline.
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
      summary.triangles_full ? ` of ${count(summary.triangles_full)} at the finest level` : '',
      flip == null ? '. Pictures were not compared.' : `, with a FLIP of ${small(flip)}.`];
  }
  const share = c.triangles_ratio.median;
  const parts = share < 0.995
    ? [named(c.name), ` draws ${percent(share)} of the triangles of `, named(base.name), ' (the baseline)']
    : ['No configuration draws fewer triangles than ', named(base.name), ' (the baseline); ', named(c.name),
      ` draws ${percent(share)} of them`];
  const time = c.frame_ratio;
  const differs = time.q3 < 1 || time.q1 > 1;
  if (time.median > 0 && differs) parts.push(` in ${percent(time.median)} of its ${timeName}`);
  else if (time.median > 0) parts.push(`, with no clear difference in ${timeName} (median ${percent(time.median)})`);
  const [flip, baseFlip] = [meanFlip(c), meanFlip(base)];
  if (flip == null) parts.push('. Pictures were not compared.');
  else if (small(flip) === small(baseFlip)) parts.push(`, with the same FLIP (${small(flip)}).`);
  else parts.push(`, with a FLIP of ${small(flip)}${baseFlip == null ? '' : ` instead of ${small(baseFlip)}`}.`);
  return parts;
}

/// The sweep's result in one sentence, at the first of three FLIP values that the baseline's curve reaches.
function equalQuality() {
  const rows = sweep?.triangles_at_flip ?? [];
  const order = [1, 2, 0].map((i) => rows[i]).filter(Boolean);
  for (const row of order) {
    const own = row.triangles[base.name];
    const others = Object.entries(row.triangles).filter(([name, v]) => name !== base.name && v != null);
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
    error('Butteraugli', 'butteraugli', 'largest', '\u2264', small, -1),
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
  const text = [many ? `Medians over ${whole(measured)} frames, with the quartiles below.` : 'One frame.'];
  if (rows.length > 1) {
    const where = many ? ' in the same frame' : '';
    text.push(`Ratios are to the baseline${where}. The best value of each column is marked.`);
  }
  text.push(compared
    ? `Errors are means${many ? ', with the worst frame below' : ''}. Smaller is better for FLIP, larger for PSNR (dB) `
      + 'larger for PSNR (dB) and SSIM.'
    : 'Pictures were not compared, so the table has no errors and no popping.');
  if (columns.some((c) => c.group === 'Popping'))
    text.push('Popping: LOD switches per visible object and frame; FLIP of the worst pixel while the camera is frozen; '
      + 'temporal FLIP. \u201cHow it was measured\u201d explains them.');
  byId('results').append(tableFigure('Results', text.join(' '), table));
}

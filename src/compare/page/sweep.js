// Error over cost: the chart and the tables of the sweep.

// Error over cost ----------------------------------------------------------

const curves = (sweep?.curves ?? []).filter((curve) => indexOf.has(curve.name))
  .map((curve) => ({ index: indexOf.get(curve.name), points: curve.points }));

/// Points that no other point beats in both cost and FLIP.
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
  // An error of 0 has no logarithm: such points are drawn at the foot of the chart.
  const foot = positive.length ? Math.min(...positive) / 2 : 1e-4;
  const flips = all.map((p) => Math.max(p.flip, foot));
  const place = (p) => [Math.log10(Math.max(p[cost], 1e-6)), Math.log10(Math.max(p.flip, foot))];
  const room = Math.max(3, Math.floor(node.clientWidth / 75));
  const lines = curves.map(({ index, points }) => {
    const color = variable(`--series-${styleOf(index)}`);
    return {
      id: `c${index}`, name: `c${index}`, type: 'line', z: 4,
      data: [...points].sort((a, b) => a[cost] - b[cost]).map((point) => ({ value: place(point), point })),
      symbol: `path://${SYMBOLS[markOf(index)]}`, symbolSize: 10, showSymbol: true, showAllSymbol: true,
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
  ...(p.butteraugli == null ? [] : [`Butteraugli ${small(p.butteraugli)}`]),
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
    'Each configuration rendered the kept frames with several error budgets \u03c4 (in pixels). Each point is a mean '
    + 'over these frames. Curves further down and to the left are better: they have less error for less work.'));
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
        + 'The wide band is the Pareto front: points that no other point beats in both. ';
      text.append(element('span', { class: 'hint' },
        'Hover over a point or use the arrow keys to see its \u03c4 and figures.'));
    };
    caption();
    section.append(element('div', { class: 'controls' }, axes.node),
      element('figure', { class: 'chart' }, legend(curves.map(({ index }) => index)), plot, text),
      element('p', { class: 'unseen', id: 'sweep-keys' },
        'Left and right move along a curve; up and down change to another curve.'));
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
      `Triangles needed for a FLIP${rows.length > 1 ? ', with the ratio to the baseline below' : ''}.`,
      configurationTable(columns, rows), 'narrow'));
  }
  const equal = sweep.flip_at_triangles;
  if (equal?.rows?.length) {
    const columns = equal.rows.map(({ tau, triangles, flip }) => {
      const at = (i) => flip[nameOf(i)] ?? null;
      return { head: count(triangles), sub: `\u03c4 ${tau}`, better: -1, key: at, cell: (i) => small(at(i)) };
    });
    pair.append(tableFigure('FLIP at equal triangles',
      element('span', null, 'FLIP at the triangle counts that ', named(equal.of), ' has at the \u03c4 in the head.'),
      configurationTable(columns, rows), 'narrow'));
  }
  const outside = configurations.map((_, i) => i).filter((i) => !rows.includes(i)).map(nameOf);
  section.append(pair, element('p', null, `${NONE}: outside the measured range of the curve; nothing is extrapolated. `
    + 'If the coarsest point already has a smaller FLIP, the table gives its triangles.'));
  if (outside.length) {
    section.append(element('p', null, 'Not in the sweep, because they do not use \u03c4: ',
      outside.map((name, k) => [k > 0 ? ', ' : '', named(name)]), '.'));
  }
  const masked = curves.some(({ points }) => points.some((p) => p.butteraugli != null));
  const head = ['configuration', '\u03c4', 'triangles', 'frame time, ms', 'FLIP', 'PSNR, dB', 'SSIM',
    ...(masked ? ['Butteraugli'] : [])]
    .map((text, k) => element('th', { scope: 'col', class: k ? null : 'corner' }, text));
  const body = element('tbody', { class: 'rows' });
  for (const { index, points } of curves) {
    points.forEach((p, k) => {
      const psnr = p.psnr == null ? 'equal' : decibel(p.psnr);
      const texts = [String(p.tau), count(p.triangles), milliseconds(p.frame_ms), small(p.flip), psnr, small(p.ssim),
        ...(masked ? [small(p.butteraugli)] : [])];
      body.append(element('tr', null,
        k > 0 ? null : element('th', { scope: 'rowgroup', rowspan: points.length, class: 'corner' }, owner(index)),
        texts.map((text) => element('td', null, text))));
    });
  }
  const table = element('table', null, element('thead', null, element('tr', null, head)), body);
  section.append(element('details', { open: !chartsLibrary }, element('summary', null, 'All points of the sweep'),
    tableFigure('All points of the sweep', 'Means over the kept frames.', table)));
}

// The chart over the frames of the path.

// Along the path -----------------------------------------------------------

const ALL_SCALES = ['linear', 'log', 'ratio'];
const digits = (v) => String(Number(v.toFixed(5)));
// [key of the series, label, axis, format, format of ticks, scales, whether the axis may start above zero]
const QUANTITIES = [
  ['triangles', 'triangles', 'triangles per frame', count, countTick, ALL_SCALES],
  ['frame_ms', timeName, `${timeName}, ms`, milliseconds, brief, ALL_SCALES],
  ['flip', 'FLIP', 'FLIP, mean over the frame', small, brief, ['linear', 'log']],
  ['psnr', 'PSNR', 'PSNR, dB', decibel, digits, ['linear'], true],
  ['ssim', 'SSIM', 'SSIM', small, digits, ['linear'], true],
  ['butteraugli', 'Butteraugli', 'Butteraugli, 3-norm over the frame', small, brief, ['linear', 'log']],
  ['drawn', 'drawn objects', 'objects drawn', count, countTick, ALL_SCALES],
  ['culled_frustum', 'outside the frustum', 'objects outside the frustum', count, countTick, ['linear']],
  ['culled_occlusion', 'culled by occlusion', 'objects culled by occlusion', count, countTick, ['linear']],
  ['draws', 'draws', 'draw commands', count, countTick, ALL_SCALES],
  ['switches', 'switches', 'LOD switches per visible object', small, brief, ['linear']],
  ['temporal_flip', 'temporal FLIP', 'temporal FLIP, mean over the frame', small, brief, ['linear', 'log']],
].map(([key, label, long, format, tick, scales, floating]) => ({ key, label, long, format, tick, scales, floating }))
  .filter(({ key }) => series.some((s) => s[key]?.some((v) => v != null)));
const quantityOf = (key) => QUANTITIES.find((q) => q.key === key);

function valueAt(index, key, frame) {
  const s = series[index];
  return s.at.has(frame) ? s[key]?.[s.at.get(frame)] ?? null : null;
}

/// The value that the chart shows of one configuration at one frame, before the logarithm.
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
    // A few marks per line, staggered, so that the lines can be told apart.
    const offset = Math.floor((stride * k) / shown.length);
    const single = values.get(index).length < 3;
    return {
      id: `c${index}`, name: `c${index}`, type: 'line', z: index === baseline ? 3 : 4,
      data: values.get(index).map(([frame, v]) => [frame, scaled(v)]),
      symbol: (_, p) => (single || p.dataIndex % stride === offset ? `path://${SYMBOLS[markOf(index)]}` : 'none'),
      symbolSize: 9, showSymbol: true, showAllSymbol: true, connectNulls: false,
      lineStyle: { color, width: allFrames.length > 400 ? 1.2 : 1.8, type: dashOf(index) },
      itemStyle: { color }, emphasis: { disabled: true },
    };
  });
  const selected = {};
  shown.forEach((index) => { selected[`c${index}`] = !hidden.has(index); });
  // On touch screens, dragging scrolls the page.
  const coarse = window.matchMedia('(pointer: coarse)').matches;
  // On narrow screens the tooltip would cover the chart: it is placed below.
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

/// Marks the frames with pictures by lines and triangles at the foot; the frame in the viewer has a larger triangle.
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
      measured ? 'Only one frame was measured; the table above holds its figures.' : 'Nothing has been measured yet.'));
  }
  if (!chartsLibrary && (several || sweep)) {
    section.append(element('p', null,
      'The program was built without the charts library, so this report has no charts. '
      + 'frames.csv holds the values of each frame.'));
  }
  if (!several || !chartsLibrary) return;
  state.quantity = QUANTITIES[0].key;
  const medians = configurations.map((c) => c.triangles?.median).filter((v) => v > 0);
  // On a linear scale, a configuration that draws everything would press the others onto the axis.
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
    `Left and right move from frame to frame. Plus and minus zoom; 0 shows all frames.${
      kept.length ? ' Enter shows the nearest pictures.' : ''}`);
  section.append(keys);
  // The library handles every wheel event, even without Ctrl, when it does not zoom; these must scroll the page.
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
    const over = state.scale === 'ratio' ? `, as a ratio to ${base.name} in the same frame` : '';
    caption.textContent = `${long}${over}. `;
    if (quantity.key === 'psnr') caption.append('Gaps: frames whose picture equals the reference. ');
    hints.textContent = `${kept.length ? 'Arrows on the axis mark frames with pictures; click for the nearest. ' : ''}`
      + 'Zoom with Ctrl and the wheel, with the slider, or with + and \u2212; the arrow keys move along the path.';
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

/// Keyboard control of the chart over the frames.
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

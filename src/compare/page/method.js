// How it was measured; the theme; the start of the page; the state that tests read.

// How it was measured ------------------------------------------------------

const WALL_TIME = 'Each pass is timed by wall time between two glFinish, because timer queries are wrong on software '
  + 'renderers. The frame time is the sum over the passes. Compare times only as ratios on this machine: absolute '
  + 'times of a software renderer do not carry over to a GPU.';
const GPU_TIME = 'Each pass is timed by GPU timestamps. The frame time is the sum over the passes; it does not '
  + 'contain time that only the CPU spends.';
const REFERENCES = {
  none: 'No reference. Only the passes that decide what to draw were run and timed; there are no pictures and no '
    + 'errors.',
  lod0: 'Every object at its finest level, with two-phase culling, which never culls a visible pixel.',
  full: 'Every object at its finest level, without culling.',
};

function explanations() {
  const { step, lead } = frames;
  const gaps = step > 1
    ? ` Every ${step}th frame was measured. ${lead} frames before each of them were rendered without being measured, `
      + 'so that the history is as on the whole path.'
    : ` Up to ${lead} frames before the first one were rendered without being measured.`;
  const planned = frames.kept?.length ?? 0;
  const spread = planned > 1 ? ` The pictures of ${planned} frames, evenly spread, were kept for this page.` : '';
  const pairs = [
    ['Configuration', 'One way to render the scene: how objects are culled, how levels of detail are chosen, and '
      + 'with which parameters. The options below each name are options of jalousie render.'],
    ['Frames', 'All configurations run in one process. Each frame of the path is rendered by all configurations before '
      + 'the next frame; the first configuration changes from frame to frame. One warm-up frame of each configuration '
      + `is not measured.${gaps}${spread}`],
    ['Median, quartiles, ratio', 'Half of the frames lie below the median; half lie between the quartiles. A ratio '
      + 'compares a configuration with the baseline in the same frame; the table shows the median and quartiles of '
      + 'these ratios. If the quartiles lie on both sides of 1, there is no clear difference.'],
    [capital(timeName), summary.timing === 'gpu' ? GPU_TIME : WALL_TIME],
    ['Reference', REFERENCES[summary.reference] ?? 'Unknown.'],
  ];
  if (summary.reference !== 'none') pairs.push(...errorExplanations());
  if (sweep) {
    pairs.push(['Sweep', 'The kept frames were rendered with several values of the error budget \u03c4, in pixels. '
      + 'Between measured points, values are interpolated linearly between logarithms of triangles and FLIP. Nothing '
      + 'is extrapolated.']);
  }
  pairs.push(['Other files', 'frames.csv holds every value of each frame, summary.json the figures of this page.']);
  return pairs;
}

function errorExplanations() {
  return [
    ['PSNR', 'Peak signal-to-noise ratio over red, green and blue, in decibels. Its mean over frames is the PSNR of '
      + 'the mean squared error. \u201cEqual\u201d: the pictures do not differ.'],
    ['SSIM', 'Structural similarity (Wang et al. 2004) in windows of 8\u00d78 pixels, mean of red, green and blue. 1: '
      + 'the pictures do not differ.'],
    ['FLIP', 'LDR-FLIP (Andersson et al. 2020) predicts the difference that a viewer sees when two pictures alternate '
      + `in place, at ${ratio(summary.pixels_per_degree)} pixels per degree of visual angle. Each pixel has an error `
      + 'between 0 and 1; the figure is the mean of this error map.'],
    ...(configurations.some((c) => c.error?.butteraugli) ? [['Butteraugli', 'Distance of libjxl with a model of masking: '
      + 'an error in a busy part of the picture counts less. The figure is the 3-norm over the pixels for a display of '
      + '80 cd/m\u00b2. 0: the pictures do not differ; about 1: a difference that viewers just notice.']] : []),
    ...(configurations.some((c) => c.worst_objects) ? [['Objects', 'The frame with the largest '
      + 'FLIP over covered pixels was rendered again for each configuration. A pixel counts for the object that it shows; '
      + 'where it shows the background or an object at its finest level, or where the object of the reference has no '
      + 'pixel in the picture, it counts for the object of the reference. Deviation: largest distance of a level from the finest one, projected to pixels, '
      + 'as the file states it; allowed: by the level rule.']] : []),
    ['Popping: switches', 'Of the objects with at least one visible pixel, the share that has another level than in '
      + 'the frame before.'],
    ['Popping: frozen', 'The camera is frozen while the renderer advances by one frame. The two pictures differ only '
      + 'by LOD switches. The table gives the FLIP of the pixel that changes most, with the mean below. Measured at '
      + 'the kept frames.'],
    ['Popping: temporal', 'Temporal FLIP is the mean of |FLIP(I\u2096, I\u2096\u208b\u2081) \u2212 FLIP(R\u2096, '
      + 'R\u2096\u208b\u2081)| over the pixels, with I the picture and R the reference. It counts change that the '
      + 'reference does not have, and change of the reference that the picture does not have. Measured at all frames '
      + 'if none is left out, otherwise at the kept frames.'],
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
  section.append(element('h3', null, 'Command'), element('div', { class: 'command' }, pre, button));
}

/// Some browsers do not let file: pages use the clipboard; the text is then selected and copied by the old command.
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
    // Canvases do not adapt to the paper's width by themselves, and no animation frame follows that would draw them.
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
picturesSection();  // before the chart over the frames, which marks the viewer's frame
framesSection();
sweepSection();
objectsSection();
passesSection();
methodSection();
contents();

window.jalousieReport = {
  charts,
  state: () => ({
    ...state, theme: document.documentElement.dataset.theme, hidden: [...hidden].map((i) => configurations[i].name),
    viewer: viewer?.state() ?? null, objects: objectTable?.state() ?? null,
  }),
};

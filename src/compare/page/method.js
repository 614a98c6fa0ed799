// What was measured; the theme; what tests may ask.

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

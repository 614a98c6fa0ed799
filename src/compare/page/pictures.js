// The picture viewer: two pictures behind a movable split or in turn, with zoom.

// Pictures -----------------------------------------------------------------

const REFERENCE = '-1';
const LAYERS = [['image', 'picture'], ['error', 'error map'], ['lod', 'LOD map']];
const MOST_RADIOS = 12;
const LARGEST_ZOOM = 4;
// Swaps per second. Two swaps are one flash; more than three flashes per second can cause seizures.
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
    const chosen = subject();
    const flipOf = (k) => valueAt(chosen, 'flip', k.frame) ?? -1;
    this.section = section;
    this.at = kept.reduce((worst, k, i) => (flipOf(k) > flipOf(kept[worst]) ? i : worst), 0);
    this.left = kept[0].reference ? REFERENCE : String(baseline);
    this.right = String(chosen);
    this.layer = 'image';
    this.mode = 'split';
    this.split = 50;  // percent
    this.splitChosen = false;  // by the reader; until then it stands on the subject
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
        'Arrow keys move the split or the zoomed picture. Plus and minus zoom. Space swaps in flicker mode.'));
    this.listenToPointer();
    this.listenToKeys();
    this.splitAtSubject();
    this.draw();
  }

  /// Puts the split where half of the right picture's error is on each side, unless the reader has moved it.
  splitAtSubject() {
    if (this.splitChosen) return;
    const side = [this.right, this.left].find((value) => value !== REFERENCE);
    const { name } = configurations[Number(side ?? baseline)];
    const share = kept[this.at].pictures.find((p) => p.name === name)?.subject;
    this.split = Math.round(100 * clamp(share ?? 0.5, 0.05, 0.95));
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

  // Display

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
    // Picture and controls should fit into the window together.
    this.easel.style.maxWidth = `min(100%, ${((70 * summary.width) / summary.height).toFixed(2)}vh)`;
    this.scales = element('div', { class: 'scales' });
    this.note = element('figcaption', { class: 'numbered' });
  }

  /// The reference has no error map and no LOD map: its picture is shown instead.
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
    missing.textContent = `The report has no ${layerText(this.layer)} of ${shown.name}.`;
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
    let hint = 'Drag the handle or use the arrow keys to move the split.';
    if (this.zoom > 1) hint = 'Drag the picture or use the arrow keys to move it.';
    if (flicker) hint = 'Press space or click on the picture to swap.';
    const note = data.pictures_note ? `${data.pictures_note.replace(/\.$/, '')}. ` : '';
    this.note.replaceChildren(`Frame ${this.frame}. ${note}`, element('span', { class: 'hint' }, hint));
  }

  ramps() {
    if (this.layer === 'error') return [ramp('error', 'FLIP of a pixel', '0', '0.25', '0.5', '0.75', '1')];
    if (this.layer !== 'lod') return [];
    return [ramp('lod', 'level of an object', 'finest', 'coarsest'),
      ramp('occluder', 'level of an occluder', 'finest', 'coarsest')];
  }

  // Changes of state

  goTo(index) {
    this.at = index;
    this.markFrame();
    this.splitAtSubject();
    this.draw();
    charts.frames?.setOption({ series: [keptMarks(chartColors())] });
  }

  /// Shows the kept frame nearest to a frame, and scrolls to it.
  show(frame) {
    const found = nearest(kept.map((k) => k.frame), frame);
    this.goTo(kept.findIndex((k) => k.frame === found));
    this.section.scrollIntoView({ behavior: calm ? 'auto' : 'smooth' });
    this.stage.focus({ preventScroll: true });
  }

  splitTo(percent) {
    this.split = clamp(percent, 0, 100);
    this.splitChosen = true;
    this.draw();
  }

  move(dx, dy) {
    this.pan = [this.pan[0] + dx, this.pan[1] + dy];
    this.draw();
  }

  /// Zooms around the middle of the stage.
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
      this.splitAtSubject();
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
      // A touch may be the start of scrolling.
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
      // Radio buttons and the pictures do not use the space bar themselves.
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

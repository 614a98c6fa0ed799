// Checks a report's page in a browser: node page_check.mjs REPORT/index.html [--shots DIR]
// Prints "ok NAME" or "FAIL NAME: why" per check; exit code 1 if any failed, 2 on wrong usage, 77 without a browser.
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Browser, sleep } from '../support/browser.mjs';

const WIDE = { width: 1280, height: 800 };
const NARROW = { width: 390, height: 844 };
const MOST_SECONDS = 90;
const KEYS = {
  Tab: '\uE004', Enter: '\uE007', Escape: '\uE00C', Space: ' ', Left: '\uE012', Right: '\uE014', Home: '\uE011',
  End: '\uE010',
};

// Arguments -----------------------------------------------------

const args = process.argv.slice(2);
const shotsAt = args.indexOf('--shots');
const shots = shotsAt >= 0 ? args.splice(shotsAt, 2)[1] : null;
if (args.length !== 1 || (shotsAt >= 0 && !shots) || !existsSync(args[0])) {
  console.error('usage: node page_check.mjs REPORT/index.html [--shots DIR]');
  process.exit(2);
}
const page = pathToFileURL(resolve(args[0])).href;

// The browser ----------------------------------------------------------------

const browser = new Browser(MOST_SECONDS, ['--disable-gpu']);
const command = (...words) => browser.command(...words);
const run = (...words) => browser.run(...words);
const devtools = (...words) => browser.devtools(...words);

// Input ----------------------------------------------------------------------

async function element(selector) {
  const found = await command('/element', { using: 'css selector', value: selector });
  return Object.values(found)[0];
}
async function click(selector) {
  await run('document.querySelector(arguments[0]).scrollIntoView({ block: "center" })', selector);
  await command(`/element/${await element(selector)}/click`);
}
async function press(...keys) {
  const actions = keys.flatMap((key) =>
    [{ type: 'keyDown', value: KEYS[key] ?? key }, { type: 'keyUp', value: KEYS[key] ?? key }]);
  await command('/actions', { actions: [{ type: 'key', id: 'keys', actions }] });
}
const focus = (selector) =>
  run('const e = document.querySelector(arguments[0]); e.scrollIntoView({ block: "center" }); e.focus();', selector);

/// Drags from one place to another, both in shares of the element's box.
async function drag(selector, from, to) {
  const box = await run(`const e = document.querySelector(arguments[0]);
    e.scrollIntoView({ block: "center", behavior: "instant" });
    const b = e.getBoundingClientRect(); return { x: b.x, y: b.y, width: b.width, height: b.height };`, selector);
  const at = ([x, y], duration) => ({ type: 'pointerMove', origin: 'viewport', duration,
    x: Math.round(box.x + x * box.width), y: Math.round(box.y + y * box.height) });
  await command('/actions', { actions: [{ type: 'pointer', id: 'mouse', parameters: { pointerType: 'mouse' },
    actions: [at(from, 0), { type: 'pointerDown', button: 0 }, at(to, 60), { type: 'pointerUp', button: 0 }] }] });
}
const texts = (selector) =>
  run('return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)', selector);
const state = () => run('return window.jalousieReport.state()');
const size = (viewport) =>
  devtools('Emulation.setDeviceMetricsOverride', { ...viewport, deviceScaleFactor: 1, mobile: false });
const media = (features) => devtools('Emulation.setEmulatedMedia',
  { features: Object.entries(features).map(([name, value]) => ({ name, value })) });

/// Waits until a probe returns true, for at most two seconds; returns its last answer.
async function eventually(probe) {
  for (let i = 0; i < 40; ++i) {
    if (await probe()) return true;
    await sleep(50);
  }
  return probe();
}

async function open() {
  await command('/url', { url: page });
  for (let i = 0; i < 50; ++i) {
    if (await run('return document.readyState === "complete" && Boolean(window.jalousieReport)')) return;
    await sleep(100);
  }
  throw new Error('the page\'s script did not come to its end');
}

async function shoot(name, viewport) {
  if (!shots) return;
  mkdirSync(shots, { recursive: true });
  await run('window.scrollTo(0, 0); document.activeElement?.blur();');
  await sleep(150);
  const height = await run('return document.documentElement.scrollHeight');
  const picture = await devtools('Page.captureScreenshot', { format: 'png', captureBeyondViewport: true,
    clip: { x: 0, y: 0, width: viewport.width, height, scale: 1 } });
  writeFileSync(join(shots, `${name}.png`), Buffer.from(picture.data, 'base64'));
}

// Checks ---------------------------------------------------------------------

let failures = 0;
async function check(name, body) {
  try {
    await body();
    console.log(`ok ${name}`);
  } catch (error) {
    ++failures;
    console.log(`FAIL ${name}: ${error.message}`);
  }
}
function expect(condition, text) {
  if (!condition) throw new Error(text);
}

async function noOverflow() {
  const [scroll, inner, widest] = await run(`const wide = [...document.querySelectorAll('body *')]
      .filter((e) => !e.closest('.scroll, .unseen, .stage') && e.getBoundingClientRect().right > innerWidth + 1)
      .map((e) => e.tagName.toLowerCase() + '.' + e.className);
    return [document.documentElement.scrollWidth, innerWidth, wide[0] ?? ''];`);
  expect(scroll <= inner, `${scroll} px in a window of ${inner} px, ${widest}`);
}

/// Points with a finite value per configuration's series: { frames: [120, 120], ... }.
const chartPoints = () =>
  run(`return Object.fromEntries(Object.entries(window.jalousieReport.charts).map(([id, chart]) => [id,
  chart.getOption().series.filter((s) => s.id.startsWith('c'))
    .map((s) => s.data.filter((d) => (d.value ?? d).every((v) => Number.isFinite(v))).length)]));`);

async function content(facts) {
  await check('headings', async () => {
    const levels = await run(`return [...document.querySelectorAll('h1, h2, h3')].filter((h) => !h.closest('[hidden]'))
      .map((h) => [Number(h.tagName[1]), h.textContent.trim()])`);
    expect(levels.filter(([level]) => level === 1).length === 1, 'not one h1');
    expect(levels.every(([, text]) => text), 'an empty heading');
    expect(levels.every(([level], i) => i === 0 || level <= levels[i - 1][0] + 1), 'a level is left out');
  });
  await check('results table', async () => {
    const rows = await texts('#results tbody th[scope=row] .owner span');
    expect(JSON.stringify(rows) === JSON.stringify(facts.names), `rows ${rows}`);
    const options = await texts('#results .options code');
    expect(JSON.stringify(options) === JSON.stringify(facts.options.filter(Boolean)), 'options are not shown');
  });
  await check('recommendation', async () => {
    const { losers, marked, named, strict, loose } = await run(`
      const { summary } = JSON.parse(document.getElementById('data').textContent);
      const lead = document.getElementById('lead');
      const first = () => lead.querySelector('.name')?.textContent ?? null;
      const input = document.getElementById('limit');
      const at = (value) => {
        if (!input) return first();
        input.value = value;
        input.dispatchEvent(new Event('input'));
        return first();
      };
      const before = input?.value;
      const shown = { losers: summary.configurations.filter((c) => c.lost?.pixels_most > 0).map((c) => c.name),
        marked: [...document.querySelectorAll('#results .loses')].map((n) => n.closest('th').querySelector('.owner').textContent),
        named: first(), strict: at(-3), loose: at(0) };
      at(before);
      return shown;`);
    for (const name of [named, strict, loose]) expect(!losers.includes(name), `${name} loses objects and is recommended`);
    expect(JSON.stringify(losers) === JSON.stringify(marked), `marked ${marked}, losing ${losers}`);
  });
  await check('no broken numbers', async () => {
    const found = await run(`const main = document.querySelector('main').cloneNode(true);
      for (const given of main.querySelectorAll('.owner, .name, .legend, .tag, code, pre, option')) given.remove();
      return /\\b(NaN|undefined|null|Infinity)\\b|\\[object/.exec(main.textContent)?.[0] ?? '';`);
    expect(!found, `"${found}" in the text`);
  });
  await check('command', async () =>
    expect((await run('return document.querySelector("pre").textContent')) === facts.command, 'another command'));
  await check('links inside the page', async () => {
    const broken = await run(`return [...document.querySelectorAll('a[href^="#"]')].map((a) => a.hash)
      .filter((h) => !document.querySelector(h) || document.querySelector(h).hidden)`);
    expect(broken.length === 0, `to nowhere: ${broken}`);
    const loaded = await run('return performance.getEntriesByType("resource").map((e) => e.name)');
    const outward = loaded.filter((name) => !name.startsWith('data:'));
    expect(outward.length === 0, `loads ${outward[0]}`);
  });
  if (!facts.complete)
    await check('banner', async () =>
      expect(await run('return !document.getElementById("banner").hidden'), 'an interrupted report does not say so'));
}

async function frameChart(facts) {
  if (facts.frames < 2) return;
  if (!facts.library) {
    await check('missing charts are explained', async () =>
      expect(/without the charts library/.test(await run('return document.querySelector("#frames").innerText')),
        'no sentence about it'));
    return;
  }
  await check('chart over the frames', async () => {
    const points = (await chartPoints()).frames ?? [];
    expect(points.length === facts.names.length && points.every((n) => n > 0), `points ${JSON.stringify(points)}`);
  });
  await check('quantities', async () => {
    const keys = await run('return [...document.querySelectorAll("input[name=quantity]")].map((e) => e.value)');
    expect(keys.length > 1, 'none to choose');
    for (const key of keys) {
      await click(`input[name=quantity][value=${key}]`);
      expect((await state()).quantity === key, `${key} was not chosen`);
      expect((await chartPoints()).frames.some((n) => n > 0), `${key} has no points`);
    }
    await click(`input[name=quantity][value=${keys[0]}]`);
  });
  await check('logarithmic scale', async () => {
    await click('input[name=scale][value=log]');
    expect((await state()).scale === 'log', 'not chosen');
    expect((await chartPoints()).frames.some((n) => n > 0), 'no points');
    await click('input[name=scale][value=linear]');
  });
  await check('legend', async () => {
    await click('#frames .legend button');
    expect((await state()).hidden[0] === facts.names[0], 'nothing hidden');
    const shown = await run('return window.jalousieReport.charts.frames.getOption().legend[0].selected.c0');
    expect(shown === false, 'still in the chart');
    await click('#frames .legend button');
    expect((await state()).hidden.length === 0, 'not shown again');
  });
  await check('chart by keyboard', async () => {
    await focus('#frames .plot');
    await press('Right', 'Right');
    const spoken = await run('return document.getElementById("spoken").textContent');
    const shown = await run('return document.querySelector("#frames .tip")?.textContent ?? ""');
    expect(spoken.startsWith('Frame ') && shown.includes(facts.names[0]), `spoken "${spoken}", shown "${shown}"`);
    await press('+');
    const zoom = await run('const z = jalousieReport.charts.frames.getOption().dataZoom[0]; return z.end - z.start');
    expect(Math.abs(zoom - 50) < 1, `${zoom} % shown after +`);
    await press('0');
    if (facts.kept.length > 0) {
      await press('End', 'Enter');
      expect(await run('return document.activeElement.classList.contains("stage")'),
        'Enter does not lead to the pictures');
    } else {
      await press('Escape');
    }
  });
  await check('wheel on the chart', async () => {
    const turn = async (modifiers) => {
      const box = await run(`const e = document.querySelector('#frames .plot');
        e.scrollIntoView({ block: 'center', behavior: 'instant' });
        const b = e.getBoundingClientRect(); return { x: b.x + b.width / 2, y: b.y + b.height / 2 };`);
      await devtools('Input.dispatchMouseEvent', { type: 'mouseMoved', ...box });
      const before = (await look())[0];
      await devtools('Input.dispatchMouseEvent', { type: 'mouseWheel', ...box, deltaX: 0, deltaY: -120, modifiers });
      await sleep(100);
      return before;
    };
    const look = () => run('return [scrollY, jalousieReport.charts.frames.getOption().dataZoom[0].start]');
    // Input right after a page has loaded may be dropped: turned again until something moves.
    expect(await eventually(async () => { const before = await turn(0); return (await look())[0] < before; }),
      'does not scroll the page');
    expect((await look())[1] === 0, 'zooms without Ctrl');
    expect(await eventually(async () => { await turn(2); return (await look())[1] > 0; }), 'with Ctrl does not zoom');
    await focus('#frames .plot');
    await press('0');
  });
  if (facts.kept.length > 0) {
    await check('click on the chart', async () => {
      for (const [share, frame] of [[0.97, facts.kept.at(-1)], [0.07, facts.kept[0]]]) {
        if (facts.kept.length < 2 && share < 0.5) continue;
        await drag('#frames .plot', [share, 0.4], [share, 0.4]);
        expect(await eventually(async () => (await state()).viewer.frame === frame), `does not lead to frame ${frame}`);
        await run('window.scrollTo({ top: 0, behavior: "instant" })');
      }
    });
  }
}

async function sweepChart(facts) {
  if (!facts.sweep) {
    await check('no sweep, no section', async () =>
      expect(await run('return document.getElementById("sweep").hidden'), 'it is there'));
    return;
  }
  await check('sweep tables', async () => {
    const tables = await run('return document.querySelectorAll("#sweep figure.data tbody tr").length');
    expect(tables >= 2 * facts.sweep, `${tables} rows`);
  });
  if (!facts.library) return;
  await check('sweep chart', async () => {
    const points = (await chartPoints()).sweep ?? [];
    expect(points.length === facts.sweep && points.every((n) => n > 0), `points ${JSON.stringify(points)}`);
    const before = await run('return JSON.stringify(window.jalousieReport.charts.sweep.getOption().series[0].data)');
    await click('input[name=axis][value=frame_ms]');
    const after = await run('return JSON.stringify(window.jalousieReport.charts.sweep.getOption().series[0].data)');
    expect(before !== after && (await state()).axis === 'frame_ms', 'the other axis shows the same');
    await click('input[name=axis][value=triangles]');
    await focus('#sweep .plot');
    await press('Right');
    const shown = await run('return document.querySelector("#sweep .tip")?.innerText ?? ""');
    expect(/FLIP/.test(shown), `tooltip "${shown}"`);
  });
}

async function pictures(facts) {
  if (facts.kept.length === 0) {
    await check('no pictures, no viewer', async () =>
      expect(await run('return document.getElementById("pictures").hidden'), 'it is there'));
    return;
  }
  const sources = () =>
    run('return [...document.querySelectorAll(".stage img")].map((e) => e.src.length + e.src.slice(-200))');
  await check('pictures decode', async () => {
    const widths = await run(`return Promise.all([...document.querySelectorAll('.stage img')]
      .map((e) => e.decode().then(() => e.naturalWidth)))`);
    expect(widths.every((w) => w > 0), `widths ${widths}`);
  });
  await check('split on the subject', async () => {
    const { viewer } = await state();
    const subject = await run(`const { kept } = JSON.parse(document.getElementById('data').textContent);
      return kept.find((k) => k.frame === arguments[0]).pictures.find((p) => p.name === arguments[1]).subject;`,
    viewer.frame, viewer.right);
    const expected = 100 * Math.min(Math.max(subject, 0.05), 0.95);
    expect(Math.abs(viewer.split - expected) < 0.51, `${viewer.split} % instead of ${expected} %`);
  });
  await check('split by keyboard', async () => {
    await focus('.handle');
    const before = (await state()).viewer.split;
    await press('Right', 'Right', 'Right');
    const [after, clip] = [(await state()).viewer.split,
      await run('return document.querySelector(".layer.left").style.clipPath')];
    expect(after > before, `${before} to ${after}`);
    expect(clip.includes(`${100 - after}%`), `clipped by ${clip}`);
    await press('Home');
    expect((await state()).viewer.split === 0, 'Home is not 0');
  });
  await check('split by pointer', async () => {
    await drag('.stage', [0.0, 0.5], [0.7, 0.6]);
    const { split } = (await state()).viewer;
    expect(Math.abs(split - 70) < 1, `${split} %`);
    await drag('.handle', [0.5, 0.5], [-3, 0.5]);
    expect((await state()).viewer.split < 68, 'the handle does not follow');
  });
  await check('layers', async () => {
    const picture = (await sources())[0];
    for (const layer of ['error', 'lod', 'image']) {
      await click(`input[name=layer][value=${layer}]`);
      expect((await state()).viewer.layer === layer, `${layer} was not chosen`);
      const now = (await sources())[0];
      expect((now !== picture) === (layer !== 'image'), `${layer} shows the wrong picture`);
      const scale = await run('return document.querySelectorAll(".scales .ramp").length');
      expect((scale > 0) === (layer !== 'image'), `${layer}: ${scale} scales`);
    }
  });
  if (facts.kept.length > 1) {
    await check('frames', async () => {
      const before = (await state()).viewer.frame;
      await focus('input[name=frame]:checked, #pictures input[aria-label=Frame]');
      await press(before === facts.kept.at(-1) ? 'Left' : 'Right');
      const after = (await state()).viewer.frame;
      const shown = await run('return document.querySelector(".stage img").alt');
      expect(before !== after && shown.includes(`frame ${after}`), `frame ${after}, picture: ${shown}`);
    });
  }
  await check('left and right', async () => {
    const before = (await state()).viewer;
    await run(`const s = document.querySelector('select[aria-label="left picture"]');
      s.value = [...s.options].find((o) => !o.selected).value; s.dispatchEvent(new Event('change'));`);
    const after = (await state()).viewer;
    expect(before.left !== after.left && before.right === after.right, `${after.left} | ${after.right}`);
    const tags = await texts('.tag');
    expect(tags[0].startsWith(after.left) && tags[1].startsWith(after.right), `labels ${tags}`);
  });
  await check('zoom and pan', async () => {
    await click('input[name=zoom][value="4"]');
    await drag('.stage', [0.3, 0.5], [0.2, 0.4]);
    const { zoom, pan, split } = (await state()).viewer;
    expect(zoom === 4 && Math.abs(pan[0] + 1.6) < 0.02 && Math.abs(pan[1] + 1.6) < 0.02, `zoom ${zoom} at ${pan}`);
    const rendering = await run('return getComputedStyle(document.querySelector(".stage img")).imageRendering');
    expect(rendering === 'pixelated', `image-rendering ${rendering}`);
    await focus('.stage');
    await press('Right');
    expect((await state()).viewer.pan[0] < pan[0] && (await state()).viewer.split === split,
      'arrows do not move the picture');
    await click('input[name=zoom][value="1"]');
    expect((await state()).viewer.pan.every((p) => p === 0), 'fit is not centred');
  });
  await check('flicker', async () => {
    await click('input[name=mode][value=flicker]');
    expect((await state()).viewer.flickering, 'does not run');
    const { shown: first } = (await state()).viewer;
    expect(await eventually(async () => (await state()).viewer.shown !== first), 'one picture stays');
    await focus('.stage');
    const shown = () => run('return getComputedStyle(document.querySelector(".layer.left")).visibility');
    await press('Space');
    const before = await shown();
    await press('Space');
    expect((await shown()) !== before, 'space does not swap');
    expect(!(await state()).viewer.flickering, 'goes on by itself after a swap by hand');
    const fastest = await run('return Number(document.querySelector("input[aria-label=\'Swaps per second\']").max)');
    expect(fastest <= 6, `${fastest} swaps per second are more than 3 flashes`);
    await click('input[name=mode][value=split]');
  });
}

async function objects(facts) {
  if (facts.listed === 0) {
    await check('no objects, no section', async () =>
      expect(await run('return document.getElementById("objects").hidden'), 'it is there'));
    return;
  }
  const numbers = () => run(`return [...document.querySelectorAll('#objects tbody tr')].map((row) =>
    [Number(/no\\. (\\d+)$/.exec(row.querySelector('th small').textContent)[1]), row.cells[1].textContent,
      Number(row.cells[3].textContent.replaceAll(',', ''))]);`);
  const order = () => run(`return [...document.querySelectorAll('#objects th[aria-sort]')]
    .map((e) => e.getAttribute('aria-sort'))`);
  await check('objects, worst first', async () => {
    const rows = await numbers();
    const { shown } = (await state()).objects;
    expect(rows.length > 0 && rows.length === shown.length, `${rows.length} rows, ${shown.length} shown`);
    expect(rows.every((row, i) => i === 0 || Number(row[1]) <= Number(rows[i - 1][1])), 'not by error');
    expect(rows.every((row, i) => row[0] === shown[i]), 'other objects');
    expect((await order()).filter((o) => o !== 'none').join() === 'descending', `order ${await order()}`);
  });
  await check('objects by another column', async () => {
    const button = '#objects button[data-column="2"]';
    await click(button);
    const down = (await numbers()).map((row) => row[2]);
    expect(down.every((v, i) => i === 0 || v <= down[i - 1]), `pixels ${down.slice(0, 5)}`);
    await click(button);
    const up = (await numbers()).map((row) => row[2]);
    expect(up.every((v, i) => i === 0 || v >= up[i - 1]), `pixels ${up.slice(0, 5)}`);
    expect(await run('return document.activeElement.dataset.column') === '2', 'the focus is lost');
    await click('#objects button[data-column="-1"]');
    expect((await order())[0] === 'ascending', 'names do not start with A');
    await click('#objects button[data-column="0"]');
  });
  await check('search for objects', async () => {
    const [[number]] = await numbers();
    const type = (text) => run(`const e = document.getElementById('object-search'); e.value = arguments[0];
      e.dispatchEvent(new Event('input'));`, text);
    await type(String(number));
    expect((await numbers()).some((row) => row[0] === number), 'a number is not found');
    await type('no such object');
    expect((await numbers()).length === 0, 'something is found');
    expect((await texts('#objects figcaption'))[0].includes('0 rows found'), 'it does not say so');
    await type('');
    expect((await numbers()).length > 0, 'nothing comes back');
  });
  await check('all objects', async () => {
    const before = (await numbers()).length;
    const { hidden, count } = await run(`const b = document.querySelector('#objects > .controls:last-child button');
      return { hidden: b.hidden, count: Number(/\\d[\\d,]*/.exec(b.textContent)?.[0].replaceAll(',', '')) };`);
    if (hidden) return;
    await click('#objects > .controls:last-child button');
    expect((await numbers()).length === count && count > before, `${(await numbers()).length} of ${count}`);
  });
}

/// A table that is wider than the window says so, keeps its first column, and scrolls to its last one.
async function narrowTables() {
  await check('wide tables at 390', async () => {
    const look = () => run(`return [...document.querySelectorAll('.scroll')].filter((e) => e.checkVisibility())
      .filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => ({ shade: getComputedStyle(e.parentElement, '::after')
        .opacity, hint: e.parentElement.previousElementSibling.checkVisibility()
          && getComputedStyle(e.parentElement.previousElementSibling).visibility === 'visible', box: e.getBoundingClientRect().left,
        first: e.querySelector('th[scope=row]').getBoundingClientRect().left }))`);
    const scroll = (share) => run(`for (const e of document.querySelectorAll('.scroll'))
      e.scrollLeft = arguments[0] * (e.scrollWidth - e.clientWidth);`, share);
    expect((await look()).length > 0, 'no table is wider than the window');
    expect(await eventually(async () => (await look()).every((t) => t.hint && t.shade === '1')), 'nothing says so');
    await scroll(0.5);
    expect((await look()).every((t) => Math.abs(t.first - t.box) < 1.5), 'the first column scrolls away');
    await scroll(1);
    expect(await eventually(async () => (await look()).every((t) => !t.hint && t.shade === '0')), 'no end is seen');
    await scroll(0);
  });
}

async function wholePage(facts) {
  await check('bars', async () => {
    const bars = await run('return document.querySelectorAll("#passes .bar").length');
    expect(facts.measured === 0 || bars >= facts.names.length, `${bars} bars`);
  });
  await check('focus by Tab', async () => {
    // Tab goes on from the last focus, blurred or not: start over.
    await run(`const b = document.body; window.scrollTo(0, 0); b.tabIndex = -1; b.focus();
      b.removeAttribute('tabindex');`);
    const expected = await run(`const seen = new Set();
      return [...document.querySelectorAll('a[href], button, select, input, summary, [tabindex="0"]')]
      .filter((e) => e.checkVisibility() && !(e.type === 'radio' && seen.size === seen.add(e.name).size)).length`);
    const stops = [];
    for (let i = 0; i < expected + 5; ++i) {
      await press('Tab');
      const stop = await run(`const e = document.activeElement; if (e === document.body) return null;
        const outlined = (s) => s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) > 0;
        const marked = [e, e.nextElementSibling].some((n) => n && outlined(getComputedStyle(n)))
          || e.classList.contains('handle');
        const last = e.closest('#method') && e.tagName === 'BUTTON';
        return { what: e.id || e.className || e.tagName + (e.name ?? ''), marked, last };`);
      if (!stop) break;
      stops.push(stop);
      if (stop.last) break;
    }
    expect(stops.length >= expected - 1,
      `${stops.length} stops for ${expected} controls, the last at ${stops.at(-1)?.what}`);
    const bare = stops.find((stop) => !stop.marked);
    expect(!bare, `no visible focus on ${bare?.what}`);
  });
  await check('copy', async () => {
    await click('.command button');
    const text = () => run('return document.querySelector(".command button").textContent');
    expect(await eventually(async () => (await text()) !== 'Copy'), 'nothing happens');
  });
  await check('theme', async () => {
    const look = () =>
      run('return [getComputedStyle(document.body).backgroundColor, document.documentElement.dataset.theme]');
    const before = await look();
    await click('#theme');
    const after = await look();
    expect(before[0] !== after[0] && before[1] !== after[1], `still ${after}`);
    for (const [id, points] of Object.entries(await chartPoints()))
      expect(points.some((n) => n > 0), `${id} is empty after it`);
  });
  await shoot('dark-1280', WIDE);
  await click('#theme');
}

async function main() {
  await browser.start();
  await size(WIDE);
  await media({ 'prefers-color-scheme': 'light' });
  let opened = false;
  await check('opens', async () => {
    await open();
    opened = true;
  });
  if (opened) {
    const facts = await run(`const d = JSON.parse(document.getElementById('data').textContent), s = d.summary;
      const frames = [...new Set(d.series.flatMap((x) => x.frame))];
      return { names: s.configurations.map((c) => c.name), options: s.configurations.map((c) => c.options),
        command: s.command, complete: s.complete, frames: frames.length,
        measured: Math.max(0, ...s.configurations.map((c) => c.frames)),
        kept: d.kept.map((k) => k.frame), sweep: s.sweep?.curves?.length ?? 0, library: Boolean(window.echarts),
        listed: s.configurations.filter((c) => c.worst_objects?.rows.length).length };`);
    await check('no overflow at 1280', noOverflow);
    await shoot('light-1280', WIDE);
    await content(facts);
    await frameChart(facts);
    await sweepChart(facts);
    await pictures(facts);
    await objects(facts);
    await wholePage(facts);
    await size(NARROW);
    await sleep(200);
    await check('no overflow at 390', noOverflow);
    await narrowTables();
    if (facts.kept.length > 0) {
      await check('split by pointer at 390', async () => {
        await drag('.stage', [0.9, 0.3], [0.25, 0.3]);
        expect(Math.abs((await state()).viewer.split - 25) < 2, `${(await state()).viewer.split} %`);
      });
    }
    await shoot('light-390', NARROW);
    await check('preferences', async () => {
      await media({ 'prefers-color-scheme': 'dark', 'prefers-reduced-motion': 'reduce' });
      await open();
      expect((await state()).theme === 'dark', 'prefers-color-scheme: dark is not followed');
      if (facts.kept.length === 0) return;
      await click('input[name=mode][value=flicker]');
      expect(!(await state()).viewer.flickering, 'flickers in spite of prefers-reduced-motion');
    });
    await shoot('dark-390', NARROW);
  }
  await check('console', async () => {
    const all = await command('/se/log', { type: 'browser' });
    const entries = all.filter(({ level }) => level === 'SEVERE' || level === 'WARNING');
    expect(entries.length === 0, `${entries.length} messages, the first: ${entries[0]?.message}`);
  });
}

try {
  await main();
} catch (error) {
  ++failures;
  console.log(`FAIL run: ${error.message}`);
}
await browser.end(failures > 0 ? 1 : 0);

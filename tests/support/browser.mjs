// A headless Chromium that tests drive through chromedriver (WebDriver).
import { spawn } from 'node:child_process';
import { accessSync, constants, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';

/** Exit code of a check that cannot run on this machine. */
export const SKIPPED = 77;

export const sleep = (ms) => new Promise((done) => { setTimeout(done, ms); });

function program(variable, ...names) {
  const runs = (file) => {
    try {
      accessSync(file, constants.X_OK);
      return true;
    } catch {
      return false;
    }
  };
  const given = process.env[variable];
  const folders = ['/usr/bin', ...(process.env.PATH ?? '').split(delimiter)];
  const files = given ? [given, ...folders.map((f) => join(f, given))]
    : names.flatMap((name) => folders.map((f) => join(f, name)));
  return files.find(runs) ?? null;
}

/** One browser window. Ends the process with SKIPPED where there is no browser, and after `seconds` with code 1. */
export class Browser {
  constructor(seconds, options = []) {
    this.driverProgram = program('CHROMEDRIVER', 'chromedriver');
    this.browserProgram = program('CHROMIUM', 'chromium', 'chromium-browser', 'google-chrome');
    if (!this.driverProgram || !this.browserProgram) {
      const missing = this.driverProgram ? 'chromium' : 'chromedriver';
      console.log(`skipped: ${missing} not found (Debian packages chromium and chromium-driver)`);
      process.exit(SKIPPED);
    }
    this.folder = mkdtempSync(join(tmpdir(), 'browser-'));
    this.options = ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--hide-scrollbars', '--no-first-run',
      `--user-data-dir=${join(this.folder, 'profile')}`, ...options];
    this.driver = null;
    this.session = null;
    for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'])
      process.on(signal, () => {
        this.stop();
        process.exit(1);
      });
    setTimeout(() => {
      console.log(`FAIL time: not done after ${seconds} s`);
      this.stop();
      process.exit(1);
    }, seconds * 1000).unref();
  }

  async start() {
    // A process group of its own, so that the check can end the driver together with its browser.
    this.driver = spawn(this.driverProgram, ['--port=0'], { detached: true, stdio: ['ignore', 'pipe', 'ignore'] });
    const port = await new Promise((done, fail) => {
      let text = '';
      this.driver.on('error', fail);
      this.driver.on('exit', () => fail(new Error('chromedriver ended')));
      this.driver.stdout.on('data', (part) => {
        text += part;
        const found = /successfully on port (\d+)\./.exec(text);
        if (found) done(found[1]);
      });
    });
    this.address = `http://127.0.0.1:${port}`;
    const made = await this.request('POST', '/session', { capabilities: { alwaysMatch: {
      browserName: 'chrome',
      'goog:loggingPrefs': { browser: 'ALL' },
      'goog:chromeOptions': { binary: this.browserProgram, args: this.options },
    } } });
    this.session = made.sessionId;
  }

  async request(method, path, body) {
    const response = await fetch(this.address + path,
      { method, body: body && JSON.stringify(body), headers: { 'content-type': 'application/json' } });
    const { value } = await response.json();
    if (value?.error) throw new Error(`${value.error}: ${value.message.split('\n')[0]}`);
    return value;
  }

  command(path, body = {}) {
    return this.request('POST', `/session/${this.session}${path}`, body);
  }

  /** Runs the body of a function in the page. */
  run(script, ...values) {
    return this.command('/execute/sync', { script, args: values });
  }

  /** The same for a body that ends by calling its last argument. */
  runAsync(script, ...values) {
    return this.command('/execute/async', { script, args: values });
  }

  devtools(cmd, params = {}) {
    return this.command('/goog/cdp/execute', { cmd, params });
  }

  stop() {
    if (this.driver?.pid) {
      try {
        process.kill(-this.driver.pid, 'SIGKILL');
      } catch { /* gone already */ }
    }
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
  }

  /** Ends the browser and the process. */
  async end(code) {
    if (this.session)
      await Promise.race([this.request('DELETE', `/session/${this.session}`).catch(() => {}), sleep(3000)]);
    this.stop();
    process.exit(code);
  }
}

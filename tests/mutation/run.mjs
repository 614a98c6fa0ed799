// Proves that the tests notice: node run.mjs [--only NAME]... [--again] [--json FILE] [--list]
// Copies the working tree to build/mutate/source, builds it, and repeats for each entry of mutations.json: change one
// place, build the test that should notice, run it, and expect it to fail. The working tree itself is never changed.
// Exit code 0 if every mutation was caught, 1 if one was not, 2 for a wrong command line.
// Results are kept in build/mutate/results.json: an interrupted run goes on where it stopped while no file changes.
import { execFileSync, spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, lstatSync, mkdirSync, readFileSync, readlinkSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const WORK = join(ROOT, 'build/mutate');
const SOURCE = join(WORK, 'source');
const BUILD = join(SOURCE, 'build/dev');
const RESULTS = join(WORK, 'results.json');
const TIMEOUT_MS = 600000;  // of one run of a test

const mutations = JSON.parse(readFileSync(join(ROOT, 'tests/mutation/mutations.json'), 'utf8'));

function fail(message) {
  console.error(`mutate: ${message}`);
  process.exit(2);
}

function parseOptions(words) {
  const options = { only: [], again: false, json: null, list: false };
  const value = (name) => words.shift() ?? fail(`${name} needs a value`);
  while (words.length > 0) {
    const word = words.shift();
    if (word === '--only') options.only.push(value(word));
    else if (word === '--json') options.json = value(word);
    else if (word === '--again') options.again = true;
    else if (word === '--list') options.list = true;
    else fail(`unknown option ${word}; known are --only NAME, --again, --json FILE and --list`);
  }
  for (const name of options.only) {
    if (!mutations.some((mutation) => mutation.name === name)) fail(`no mutation is named ${name}; see --list`);
  }
  return options;
}

// The copy -------------------------------------------------------------------

/** Makes SOURCE equal to the files that git knows or would add. Equal files keep their time. @return digest of all */
function copyTree() {
  const list = (...options) => execFileSync('git', ['-C', ROOT, 'ls-files', '-z', ...options], { maxBuffer: 1 << 28 })
    .toString().split('\0').filter((name) => name !== '');
  const names = [...new Set([...list('--cached'), ...list('--others', '--exclude-standard')])].sort();
  const digest = createHash('sha256');
  const kept = [];
  for (const name of names) {
    const from = join(ROOT, name);
    if (!existsSync(from) && !lstatSync(from, { throwIfNoEntry: false })) continue;
    kept.push(name);
    const to = join(SOURCE, name);
    mkdirSync(dirname(to), { recursive: true });
    const info = lstatSync(from);
    if (info.isSymbolicLink()) {
      rmSync(to, { force: true });
      symlinkSync(readlinkSync(from), to);
      continue;
    }
    const content = readFileSync(from);
    digest.update(`${name}\0${content.length}\0`).update(content);
    if (!existsSync(to) || !readFileSync(to).equals(content)) writeFileSync(to, content, { mode: info.mode });
  }
  const listFile = join(WORK, 'files.json');
  const before = existsSync(listFile) ? JSON.parse(readFileSync(listFile)) : [];
  for (const name of before.filter((old) => !kept.includes(old))) rmSync(join(SOURCE, name), { force: true });
  writeFileSync(listFile, JSON.stringify(kept));
  return digest.digest('hex');
}

// Building and testing -------------------------------------------------------

/** @return what went wrong, or null */
function build(targets) {
  const made = spawnSync('cmake', ['--build', BUILD, '--target', ...targets], { encoding: 'utf8', maxBuffer: 1 << 28 });
  return made.status === 0 ? null : `${made.stdout}${made.stderr}`.split('\n').slice(-40).join('\n');
}

/** @return { passed, outcome, tests }: tests is the number of those that ran and passed */
function runTests({ target, tests }) {
  const made = spawnSync(join(BUILD, 'bin', target), [`--gtest_filter=${tests}`], {
    encoding: 'utf8', maxBuffer: 1 << 28, timeout: TIMEOUT_MS, killSignal: 'SIGKILL',
    env: { ...process.env, LP_NUM_THREADS: '1', GTEST_COLOR: 'no' },
  });
  if (made.error?.code === 'ETIMEDOUT') return { passed: false, outcome: 'caught (timeout)', tests: 0 };
  const ran = Number(made.stdout.match(/^\[  PASSED  \] (\d+) test/m)?.[1] ?? 0);
  if (made.status === 0) return { passed: true, outcome: 'SURVIVED', tests: ran };
  const failed = made.stdout.match(/^\[  FAILED  \] (\S+?)(,| \()/m)?.[1];
  return { passed: false, outcome: `caught by ${failed ?? `${target} (signal ${made.signal})`}`, tests: ran };
}

/** The tests of a mutation must pass before they can catch anything. Each pair of target and tests runs once. */
function checkUnmutated(chosen) {
  const pairs = new Map(chosen.map((mutation) => [`${mutation.target} ${mutation.tests}`, mutation]));
  for (const [pair, mutation] of pairs) {
    const { passed, tests } = runTests(mutation);
    if (!passed || tests === 0) {
      console.error(`mutate: ${pair}: ${passed ? 'no test runs' : 'fails without a mutation'}`);
      process.exit(1);
    }
  }
}

/** @return the outcome; only one that starts with "caught" is good */
function tryMutation(mutation) {
  const path = join(SOURCE, mutation.file);
  const original = readFileSync(path, 'utf8');
  if (original.split(mutation.from).length !== 2) return 'DOES NOT APPLY';
  try {
    writeFileSync(path, original.replace(mutation.from, () => mutation.to));
    if (build([mutation.target]) !== null) return 'DOES NOT BUILD';
    return runTests(mutation).outcome;
  } finally {
    writeFileSync(path, original);
  }
}

// The run --------------------------------------------------------------------

const options = parseOptions(process.argv.slice(2));
const chosen = mutations.filter(({ name }) => options.only.length === 0 || options.only.includes(name));
if (options.list) {
  for (const { name, file, breaks } of chosen) console.log(`${name.padEnd(28)} ${file.padEnd(44)} ${breaks}`);
  process.exit(0);
}
mkdirSync(SOURCE, { recursive: true });
const tree = copyTree();
const stored = existsSync(RESULTS) ? JSON.parse(readFileSync(RESULTS, 'utf8')) : {};
const results = stored.tree === tree && !options.again ? stored : { tree, outcomes: {} };
const open = chosen.filter(({ name }) => !(name in results.outcomes));
if (open.length > 0) {
  execFileSync('cmake', ['-S', SOURCE, '--preset', 'dev', '-DJALOUSIE_BUILD_BENCH=OFF'], { cwd: SOURCE, stdio: 'ignore' });
  const broken = build([...new Set(open.map(({ target }) => target))]);
  if (broken !== null) {
    console.error(`mutate: does not build without a mutation:\n${broken}`);
    process.exit(1);
  }
  checkUnmutated(open);
}
for (const mutation of open) {
  const start = Date.now();
  const outcome = tryMutation(mutation);
  results.outcomes[mutation.name] = { outcome, seconds: Math.round((Date.now() - start) / 1000) };
  writeFileSync(RESULTS, JSON.stringify(results, null, 2));
}

const caught = chosen.filter(({ name }) => results.outcomes[name].outcome.startsWith('caught'));
for (const { name, file } of chosen) {
  const { outcome, seconds } = results.outcomes[name];
  console.log(`${name.padEnd(28)} ${file.padEnd(44)} ${String(seconds).padStart(4)} s  ${outcome}`);
}
for (const { name, breaks } of chosen.filter((mutation) => !caught.includes(mutation)))
  console.log(`not caught: ${name}: ${breaks}`);
console.log(`${caught.length} of ${chosen.length} caught`);
if (options.json) {
  const report = chosen.map((mutation) => ({ ...mutation, ...results.outcomes[mutation.name] }));
  writeFileSync(options.json, `${JSON.stringify({ mutations: report, caught: caught.length }, null, 2)}\n`);
}
process.exit(caught.length === chosen.length ? 0 : 1);

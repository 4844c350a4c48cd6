// The benchmark: every contender gives all overlapping pairs of the same moving boxes, frame after frame; or answers the
// same questions.
//   npm run bench -- --scenes uniform2d,mixed2d,uniform3d --n 100000
//   npm run bench -- --queries                   questions instead of pairs, into results/<machine>-queries.json
//   npm run bench -- --coherence                 what an update costs when little changes, into results/<machine>-coherence.json
//   npm run bench -- --full                      all there is, within 35 minutes, into results/<machine>.json
//   npm run bench -- --techniques all            every technique on every scene, within 20 minutes, no peers
//   npm run bench -- --compare before.json after.json
//   npm run bench -- --markdown [results.json]   its tables; or docs/figures.md, out of all this machine's results
// One process per contender and case, pairs checked before anything is timed, rounds in turns. See README.md.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { bundle } from '../scripts/bundle.mjs';
import { compile } from '../scripts/compile.mjs';
import { loadCases, questionCases } from './cases.mjs';
import { coherence, rows } from './coherence.mjs';
import { coherenceLine } from './coherence-table.mjs';
import { compare } from './compare.mjs';
import { libraryFigures } from './library-figures.mjs';
import { machine, machineName } from './machine.mjs';
import { figures, markdown } from './markdown.mjs';
import { race, start } from './race.mjs';
import { guessTime } from './statistics.mjs';
import { table } from './table.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
/** How much of the time given may be overrun, as a share. */
const grace = 0.15;
/** Every technique is also held against the others with so few boxes. */
const few = 100;
const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    full: { type: 'boolean', default: false },
    queries: { type: 'boolean', default: false },
    coherence: { type: 'boolean', default: false },
    minutes: { type: 'string' },
    scenes: { type: 'string' },
    n: { type: 'string' },
    techniques: { type: 'string' },
    peers: { type: 'string' },
    traces: { type: 'string' },
    rounds: { type: 'string' },
    frames: { type: 'string', default: '200' },
    budget: { type: 'string', default: '500' },
    slowest: { type: 'string', default: '1000' },
    seed: { type: 'string', default: '1' },
    json: { type: 'string' },
    compare: { type: 'boolean', default: false },
    markdown: { type: 'boolean', default: false },
  },
});
/** Every technique on every scene, instead of against others. */
const everyTechnique = options.techniques === 'all';
const kind = everyTechnique ? '-techniques' : options.queries ? '-queries' : options.coherence ? '-coherence' : '';
const fileOf = (ending) => `${here}results/${machineName}${ending}.json`;
const resultsFile = fileOf(kind);
const whole = options.full || everyTechnique;
const list = (text) => text.split(',').filter(Boolean);
const read = (file) => JSON.parse(readFileSync(file, 'utf8'));
const readIfThere = (file) => (existsSync(file) ? read(file) : undefined);

if (options.compare) {
  if (positionals.length !== 2) fail('--compare takes two files of results: before and after.');
  console.log(compare(read(positionals[0]), read(positionals[1])));
  process.exit();
}
if (options.markdown) {
  const [full, techniques, coherence] = ['', '-techniques', '-coherence'].map(fileOf).map(readIfThere);
  const given = positionals.map((file) => markdown(read(file), loadCases()));
  console.log(given.length > 0 ? given.join('\n\n') : figures({ full, techniques, coherence }, loadCases()));
  process.exit();
}

function fail(message) {
  console.error(message);
  process.exit(1);
}

function refuseUnknown(what, names, known) {
  const unknown = names.find((name) => !known.includes(name));
  if (unknown !== undefined) fail(`No ${what} is called "${unknown}": expected one of ${known.join(', ')}.`);
}

if (!existsSync(`${here}node_modules`)) {
  execFileSync('npm', ['ci', '--no-audit', '--no-fund'], { cwd: here, stdio: ['ignore', 'ignore', 'inherit'] });
}
await bundle('bench/library.ts', 'build/bench/library.mjs');
writeFileSync(`${here}../build/bench/sort.wasm`, await compile('bench/floors/sort.cpp'));

const [frames, slowest, seed] = [options.frames, options.slowest, options.seed].map(Number);
const rounds = Number(options.rounds ?? 3);
if (options.coherence) {
  await playAll();
  process.exit();
}
const pairCases = loadCases(options.traces);
const cases = new Map([...pairCases, ...questionCases()]);
const headline = ['uniform2d', 'mixed2d', 'uniform3d'];
const usual = everyTechnique
  ? [...pairCases.keys()]
  : options.full
    ? [...cases.keys()]
    : options.queries
      ? [...questionCases().keys()]
      : headline;
const scenes = options.scenes ? list(options.scenes) : usual;
refuseUnknown('scene', scenes, [...cases.keys()]);
const counts = options.n ? list(options.n).map(Number) : undefined;
/** Boxes a case is run with, ascending, since what is too slow for few is not tried with more. */
const countsOf = (item) => {
  if (item.recording) return [0];
  if (counts) return counts;
  if (everyTechnique) return [...new Set([few, ...item.counts])];
  return options.full || item.question ? item.counts : [100_000];
};

const contenders = await describeAll();
const settings = { rounds, frames, slowest, seed };
const minutes = Number(options.minutes ?? (everyTechnique ? 20 : options.full ? 35 : Infinity));
const races = await raceAll();
const record = { date: new Date().toISOString(), machine, versions: versions(), settings, everyTechnique, races };
if (options.full) record.library = await libraryFigures();
if (everyTechnique) console.log(`${markdown(record, cases)}\n`);
save(options.json ?? (whole || options.queries ? resultsFile : undefined), record);

function save(output, record) {
  if (!output) return;
  mkdirSync(dirname(output), { recursive: true });
  writeFileSync(output, `${JSON.stringify(record, rounded, 1)}\n`);
  console.log(`Written to ${output}`);
}

/** What an update costs when little changes; some rows alone are not written unless told where. */
async function playAll() {
  const all = rows(loadCases(), options.traces);
  const wanted = (given, value) => !given || list(given).includes(String(value));
  const chosen = all.filter(
    ({ name, scene, trick, count }) => wanted(options.scenes, trick ?? scene ?? name) && wanted(options.n, count),
  );
  if (chosen.length === 0) fail(`No row is of scene "${options.scenes}" with ${options.n ?? 'any number of'} boxes.`);
  const done = await coherence(chosen, { seed, rounds }, (row) => console.log(coherenceLine(row)));
  const record = { date: new Date().toISOString(), machine, settings: { rounds, seed }, coherence: done };
  console.log(`\n${markdown(record, loadCases())}\n`);
  save(options.json ?? (chosen.length === all.length ? resultsFile : undefined), record);
}

/** Every contender that was asked for, each variant of a peer one of its own, with what it can do. */
async function describeAll() {
  const known = { peers: peersIn('peers'), askers: peersIn('askers') };
  const asked = options.peers !== undefined ? list(options.peers) : everyTechnique ? [] : undefined;
  refuseUnknown('peer', asked ?? [], [...known.peers, ...known.askers]);
  const all = [];
  const runner = start();
  const modules = Object.entries(known).flatMap(([folder, peers]) =>
    ['broadphase', ...peers]
      .filter((peer) => peer === 'broadphase' || !asked || asked.includes(peer))
      .map((peer) => ({ peer, module: `./${folder}/${peer}.mjs` })),
  );
  for (const { peer, module } of modules) {
    const { variants, dimensions, answers, npm, error } = await runner.ask('describe', module);
    if (error) fail(`${peer}: ${error}`);
    if (peer === 'broadphase' && !answers && options.techniques !== undefined && !everyTechnique) {
      refuseUnknown('technique', list(options.techniques), variants);
      variants.splice(0, variants.length, ...list(options.techniques));
    }
    for (const variant of variants) {
      // JSON turns an undefined variant into null.
      const name = variant ? (peer === 'broadphase' ? variant : `${peer} (${variant})`) : peer;
      all.push({ name, peer, variant: variant ?? undefined, module, dimensions, answers, npm });
    }
  }
  runner.stop();
  if (everyTechnique) return all;
  const floor = { name: 'radix sort floor', peer: 'floor', module: './floors/sort.mjs', dimensions: [2, 3], npm: null };
  return [...all, floor];
}

/** The names of the adapters in a folder, without our own. */
function peersIn(folder) {
  const names = readdirSync(here + folder).map((file) => file.slice(0, -'.mjs'.length));
  return names.filter((name) => name !== 'broadphase').sort();
}

async function raceAll() {
  const plan = scenes.flatMap((name) => countsOf(cases.get(name)).map((count) => ({ item: cases.get(name), count })));
  const end = performance.now() + minutes * 60_000;
  console.log(`${machine.cpu}, ${machine.cores} cores, ${machine.system}, Node ${machine.node}\n`);
  let overhead = 0;
  const done = [];
  for (const [k, { item, count }] of plan.entries()) {
    const ready = contenders.filter(
      ({ dimensions, answers }) =>
        dimensions.includes(dimensionsOf(item)) && (item.question ? answers?.includes(item.question) : !answers),
    );
    if (performance.now() > end + grace * minutes * 60_000) {
      console.log(`Out of time before ${item.name}, ${count}: run it alone, or give more --minutes.`);
      break;
    }
    const { entering, left } = sift(ready, item, count, done);
    // What is left of the time is shared out evenly; getting ready takes its part of a share first.
    const shares = plan.slice(k).length * Math.max(1, entering.length);
    const share = (end - performance.now()) / shares;
    const budget = Math.max(30, Math.min(Number(options.budget), (share - overhead) / rounds));
    const began = performance.now();
    const { results, ...facts } = await race(entering, { item, count, seed }, { ...settings, budget });
    overhead = Math.max(0, (performance.now() - began) / Math.max(1, entering.length) - rounds * budget);
    const { name: scene, question, still } = item;
    done.push({ scene, question, still, dimensions: dimensionsOf(item), ...facts, results: [...results, ...left] });
    console.log(`${table(done.at(-1))}\n`);
  }
  return done;
}

function dimensionsOf({ name }) {
  return name.includes('3d') ? 3 : 2;
}

/** Leaves out who, by its times for fewer boxes of the same scene, would take too long. */
function sift(ready, item, count, done) {
  const entering = [];
  const left = [];
  const before = done.filter(({ scene }) => scene === item.name);
  for (const contender of ready) {
    const { name, peer, variant } = contender;
    const found = before.map((race) => race.results.find((result) => result.name === name));
    const earlier = found.at(-1);
    const points = before.map((race, k) => ({ count: race.count, ms: found[k]?.figures?.median }));
    const guess = guessTime(points, count);
    if (earlier?.skipped) left.push({ name, peer, variant, skipped: earlier.skipped });
    else if (guess > slowest)
      left.push({
        name,
        peer,
        variant,
        skipped: `over ${Math.round(guess / 100) / 10} s a frame, by its ${before.at(-1).count.toLocaleString('en')}`,
      });
    else entering.push(contender);
  }
  return { entering, left };
}

function versions() {
  const { dependencies } = read(`${here}package.json`);
  const own = read(`${here}../package.json`).version;
  const found = { broadphase: own };
  for (const { peer, npm } of contenders) if (npm !== null) found[peer] = dependencies[npm ?? peer];
  return found;
}

/** Six digits are plenty. */
function rounded(_key, value) {
  return typeof value === 'number' && !Number.isInteger(value) ? Number(value.toPrecision(6)) : value;
}

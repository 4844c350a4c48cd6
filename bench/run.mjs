// The benchmark: every contender gives all overlapping pairs of the same moving boxes, frame after frame.
//   npm run bench -- --scenes uniform2d,mixed2d,uniform3d --n 100000
// One process per contender and scene, pairs checked before anything is timed, rounds in turns. See README.md.
import { execFileSync, fork } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { bundle } from '../scripts/bundle.mjs';
import { compile } from '../scripts/compile.mjs';
import { summary } from './statistics.mjs';
import { table } from './table.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const peerNames = readdirSync(`${here}peers`)
  .map((file) => file.replace('.mjs', ''))
  .filter((name) => name !== 'broadphase');

const { values: options } = parseArgs({
  options: {
    scenes: { type: 'string', default: 'uniform2d,mixed2d,uniform3d' },
    n: { type: 'string', default: '100000' },
    techniques: { type: 'string' },
    peers: { type: 'string', default: peerNames.join(',') },
    rounds: { type: 'string', default: '5' },
    frames: { type: 'string', default: '20' },
    seed: { type: 'string', default: '1' },
    json: { type: 'string' },
  },
});

const list = (text) => text.split(',').filter(Boolean);
const [rounds, frames, seed] = [options.rounds, options.frames, options.seed].map(Number);
/** The longest a round may take, beyond its first two frames, so that a slow peer does not hold up the rest. */
const roundBudget = 1500;
const warmUpBudget = 500;

if (!existsSync(`${here}node_modules`)) {
  execFileSync('npm', ['ci', '--no-audit', '--no-fund'], { cwd: here, stdio: ['ignore', 'ignore', 'inherit'] });
}
const { BroadPhase, sceneNames } = await import(await bundle('bench/library.ts', 'build/bench/library.mjs'));
writeFileSync(`${here}../build/bench/sort.wasm`, await compile('bench/floors/sort.cpp'));

const techniques = options.techniques === undefined ? BroadPhase.techniques : list(options.techniques);
/** Above this many boxes brute force takes seconds a frame: it then runs only where it is asked for by name. */
const mostForBruteForce = 20_000;
const contenders = [
  ...techniques.map((technique) => ({ name: technique, module: './peers/broadphase.mjs', technique })),
  ...list(options.peers).map((name) => ({ name, module: `./peers/${name}.mjs` })),
  { name: 'radix sort floor', module: './floors/sort.mjs' },
];
refuseUnknown('technique', techniques, BroadPhase.techniques);
refuseUnknown('peer', list(options.peers), peerNames);
refuseUnknown('scene', list(options.scenes), sceneNames);

function refuseUnknown(what, names, known) {
  const unknown = names.find((name) => !known.includes(name));
  if (unknown === undefined) return;
  console.error(`No ${what} is called "${unknown}": expected one of ${known.join(', ')}.`);
  process.exit(1);
}

/** A contender in a process of its own: asks it one thing at a time. */
function start({ name, module, technique }) {
  const child = fork(`${here}contender.mjs`, { stdio: ['ignore', 'inherit', 'inherit', 'ipc'] });
  return {
    name,
    settings: { module, technique },
    rounds: [],
    ask: (action, value) =>
      new Promise((resolve) => {
        const ended = (code, signal) => resolve({ error: `its process ended (${signal ?? code})` });
        child.once('exit', ended);
        child.once('message', (answer) => {
          child.off('exit', ended);
          resolve(answer);
        });
        child.send([action, value]);
      }),
    stop: () => child.kill(),
  };
}

async function race(scene, count) {
  const setting = { scene, count, seed };
  const reference = start({ name: 'reference', module: './floors/reference.mjs' });
  const { checked: expected, error } = await reference.ask('prepare', { ...reference.settings, ...setting });
  reference.stop();
  if (error) throw new Error(error);

  const running = [];
  const results = [];
  for (const contender of contenders) {
    if (contender.technique === 'brute-force' && !options.techniques && count > mostForBruteForce) continue;
    const runner = start(contender);
    const result = { name: contender.name };
    results.push(result);
    const { checked, unable, error } = await runner.ask('prepare', { ...runner.settings, ...setting });
    const wrong = checked?.findIndex((fingerprint, frame) => fingerprint !== expected[frame]) ?? -1;
    if (unable || error) {
      result.problem = unable ?? firstLine(error);
      runner.stop();
      continue;
    }
    if (wrong >= 0)
      result.problem = `WRONG: ${pairsIn(checked[wrong])} of ${pairsIn(expected[wrong])} pairs in frame ${wrong + 1}`;
    await runner.ask('warmUp', warmUpBudget);
    running.push({ runner, result });
  }
  for (let round = 0; round < rounds; round++) {
    for (const { runner, result } of running) {
      const { times, error } = await runner.ask('round', { frames, budget: roundBudget });
      if (times) runner.rounds.push(times);
      else result.problem = firstLine(error);
    }
  }
  for (const { runner, result } of running) {
    runner.stop();
    if (runner.rounds.length === rounds) result.figures = summary(runner.rounds);
  }
  return { scene, count, pairs: Number(pairsIn(expected[0])), results };
}

const firstLine = (text) => text.split('\n')[0];

const pairsIn = (fingerprint) => fingerprint.split(' ')[0];

const machine = {
  cpu: os.cpus()[0]?.model.trim() ?? 'unknown',
  cores: os.cpus().length,
  memory: os.totalmem(),
  system: `${os.platform()} ${os.arch()}`,
  node: process.version,
};
console.log(`${machine.cpu}, ${machine.cores} cores, ${machine.system}, Node ${machine.node}\n`);

const races = [];
for (const count of list(options.n).map(Number)) {
  for (const scene of list(options.scenes)) {
    races.push(await race(scene, count));
    console.log(`${table(races.at(-1))}\n`);
  }
}
if (options.json) {
  mkdirSync(dirname(options.json), { recursive: true });
  const record = { date: new Date().toISOString(), machine, settings: { rounds, frames, seed }, races };
  writeFileSync(options.json, `${JSON.stringify(record, null, 2)}\n`);
}

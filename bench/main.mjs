// The benchmark: what a game does in a frame, in the same frames for all. README.md says how, and what all this writes.
//   npm run bench                           all kinds within half an hour, into results/, docs/figures.md and README.md
//   npm run bench -- --full                 with more sizes and contenders, for some hours
//   npm run bench -- --motions flock,hail   rows of a kind alone, printed; --json file writes them down
//   npm run bench -- --native               libraries of C++ and Rust, where they are at hand, into the same results
//   npm run bench -- --compare main         what changed beyond the noise since main; or two files
//   npm run bench -- --figures              rewrites the documents from the recorded results
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { bundle } from '../scripts/bundle.mjs';
import { machineName } from './harness/machine.mjs';
import { compare } from './report/compare.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
/** In the order of a run. */
const kinds = ['objects', 'cold', 'once', 'movers', 'motions', 'queries', 'scenes', 'native'];
/** Runs only when it is asked for: what it needs is not everywhere. */
const onRequest = ['native'];

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    ...Object.fromEntries(kinds.map((kind) => [kind, { type: 'boolean', default: false }])),
    full: { type: 'boolean', default: false },
    count: { type: 'string' },
    dimensions: { type: 'string' },
    set: { type: 'string' },
    by: { type: 'string' },
    frames: { type: 'string' },
    json: { type: 'string' },
    compare: { type: 'boolean', default: false },
    figures: { type: 'boolean', default: false },
  },
});
const list = (text) => text?.split(',').filter(Boolean);
const numbers = (text) => list(text)?.map(Number);
const read = (file) => JSON.parse(readFileSync(file, 'utf8'));

/** Results from a file, or those of this machine that a branch or commit has. */
function resultsOf(place) {
  if (existsSync(place)) return read(place);
  try {
    const file = `bench/results/${machineName}.json`;
    return JSON.parse(
      execFileSync('git', ['show', `${place}:${file}`], { cwd: here, maxBuffer: 2 ** 28, stdio: 'pipe' }),
    );
  } catch {
    console.error(`--compare: ${place} is no file, and no branch or commit with results of this machine.`);
    process.exit(1);
  }
}

if (options.compare) {
  if (positionals.length < 1 || positionals.length > 2) {
    console.error('--compare takes what was before, a file of results, branch or commit, and perhaps what came after.');
    process.exit(1);
  }
  console.log(compare(...[positionals[0], positionals[1] ?? `${here}results/${machineName}.json`].map(resultsOf)));
  process.exit();
}

if (!existsSync(`${here}node_modules`)) {
  execFileSync('npm', ['ci', '--no-audit', '--no-fund'], { cwd: here, stdio: ['ignore', 'ignore', 'inherit'] });
}
await bundle('bench/library.ts', 'build/bench/library.mjs');
const { run, writeDocuments } = await import('./harness/run.mjs');

const asked = kinds.filter((kind) => options[kind]);
if (!options.figures) {
  const everything = asked.length === 0;
  await run({
    kinds: everything ? kinds.filter((kind) => !onRequest.includes(kind)) : asked,
    everything,
    json: options.json,
    selection: {
      names: positionals.length > 0 ? positionals.flatMap(list) : undefined,
      set: options.set,
      counts: numbers(options.count),
      dimensions: numbers(options.dimensions),
      by: list(options.by),
      // Rows of a kind that is asked for are all there are; a run of everything makes do with the usual ones.
      full: options.full || (everything ? false : undefined),
      frames: options.frames === undefined ? undefined : Number(options.frames),
    },
  });
}
if (options.figures) writeDocuments();

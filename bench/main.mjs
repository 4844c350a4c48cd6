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
import { bundle } from '../scripts/bundle.mjs';
import { machineName } from './harness/machine.mjs';
import { kinds, Mistake, parsed } from './harness/options.mjs';
import { compare } from './report/compare.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
/** Runs only when it is asked for: what it needs is not everywhere. */
const onRequest = ['native'];

const list = (text) => text?.split(',').filter(Boolean);
const numbers = (text) => list(text)?.map(Number);
const read = (file) => JSON.parse(readFileSync(file, 'utf8'));

try {
  await main(parsed(process.argv.slice(2)));
} catch (error) {
  if (!(error instanceof Mistake)) throw error;
  console.error(`${error.message}. bench/README.md says what there is.`);
  process.exitCode = 1;
}

async function main({ options, names }) {
  if (options.help) console.log(readFileSync(`${here}README.md`, 'utf8').split('\n## ')[0]);
  else if (options.compare) console.log(compared(names));
  else if (options.figures) (await harness()).writeDocuments();
  else await race(options, names);
}

function compared(places) {
  if (places.length < 1 || places.length > 2) {
    throw new Mistake(
      `--compare: got ${places.length} names, expected what was before (a file of results, branch or commit), and perhaps what came after`,
    );
  }
  return compare(...[places[0], places[1] ?? `${here}results/${machineName}.json`].map(resultsOf));
}

/** Results from a file, or those of this machine that a branch or commit has. */
function resultsOf(place) {
  if (existsSync(place)) return read(place);
  try {
    const file = `bench/results/${machineName}.json`;
    return JSON.parse(
      execFileSync('git', ['show', `${place}:${file}`], { cwd: here, maxBuffer: 2 ** 28, stdio: 'pipe' }),
    );
  } catch {
    throw new Mistake(`--compare: ${place} is no file, and no branch or commit with results of this machine`);
  }
}

async function race(options, names) {
  const asked = kinds.filter((kind) => options[kind]);
  const everything = asked.length === 0;
  const { run } = await harness();
  await run({
    kinds: everything ? kinds.filter((kind) => !onRequest.includes(kind)) : asked,
    everything,
    json: options.json,
    selection: {
      names: names.length > 0 ? names.flatMap(list) : undefined,
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

/** What runs rows and writes documents, once its packages are installed and the library is bundled for it. */
async function harness() {
  if (!existsSync(`${here}node_modules`)) {
    execFileSync('npm', ['ci', '--no-audit', '--no-fund'], { cwd: here, stdio: ['ignore', 'ignore', 'inherit'] });
  }
  await bundle('bench/library.ts', 'build/bench/library.mjs');
  return import('./harness/run.mjs');
}

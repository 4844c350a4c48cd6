// Runs rows, one after another, and saves the results after each, so that an interrupted run keeps its rows.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { figuresPage, headlineOf, putFigures, worthOf } from '../report/documents.mjs';
import { headOf, textOf } from '../report/text.mjs';
import { whole } from '../report/words.mjs';
import { machine, machineName } from './machine.mjs';
import { Mistake } from './options.mjs';
import { race } from './race.mjs';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const resultsFile = path(`../results/${machineName}.json`);
const read = (file) => JSON.parse(readFileSync(file, 'utf8'));
/** A run of everything begins no row after this many minutes. */
const mostMinutes = 29;

/**
 * @param order `kinds` to run, and the `selection` of their rows. `everything` goes into results/, or else into `json` if
 *   that is given; without `full` it ends within half an hour
 * @throws Mistake if there is no such row
 */
export async function run({ kinds, everything, json, selection }) {
  const chosen = await choose(kinds, selection);
  const added = !everything && isWhole(kinds, selection) && existsSync(resultsFile);
  const output = json ?? (everything || added ? resultsFile : undefined);
  const fresh = { date: new Date().toISOString(), commit: commit(), machine, versions: versions(), rows: [] };
  const record = added
    ? { ...withoutKinds(read(resultsFile), kinds), native: { date: fresh.date, commit: fresh.commit } }
    : fresh;
  const end = everything && !selection.full ? performance.now() + mostMinutes * 60_000 : Infinity;
  console.log(`${machine.cpu}, ${machine.cores} cores, ${machine.system}, Node ${machine.node}; milliseconds.`);
  for (const { kind, title, play, rows, unable } of chosen) {
    if (unable) console.log(`\n${title}: ${unable}`);
    console.log(`\n${title}: ${rows.length} rows\n${headOf(kind)}`);
    for (const row of rows) {
      if (performance.now() > end) {
        record.cut = `Not measured for lack of time: ${kind}, from ${row.name}${row.count ? `, ${whole(row.count)} boxes` : ''} on.`;
        console.log(record.cut);
        if (output) save(output, record);
        break;
      }
      record.rows.push(await played(play, row));
      console.log(textOf(record.rows.at(-1)));
      if (output) save(output, record);
    }
  }
  if (output) console.log(`\nWritten to ${output}`);
  if (output === resultsFile) writeDocuments();
}

/** What will run of each kind. */
async function choose(kinds, selection) {
  const chosen = [];
  const known = new Set();
  for (const kind of kinds) {
    const { title, rows, play = race, prepare } = await import(`../kinds/${kind}.mjs`);
    const unable = await prepare?.();
    const all = await rows({ ...selection, names: undefined });
    for (const { name } of all) known.add(name);
    const wanted = unable ? [] : shortened(await rows(selection), selection.frames);
    chosen.push({ kind, title, play, rows: wanted, unable });
  }
  const asked = kinds.map((kind) => `--${kind}`).join(', ');
  for (const name of selection.names ?? []) {
    if (!known.has(name)) throw new Mistake(`${asked}: got the name ${name}, expected one of ${[...known].join(', ')}`);
  }
  if (chosen.every(({ rows, unable }) => rows.length === 0 && !unable)) {
    throw new Mistake(`${asked}: no row has all that was asked for`);
  }
  return chosen;
}

/** Native libraries are raced separately, if they are installed; their rows are added to existing results. */
const isWhole = (kinds, { names, counts, frames }) => kinds.join() === 'native' && !(names ?? counts ?? frames);

const withoutKinds = (record, kinds) => ({ ...record, rows: record.rows.filter(({ kind }) => !kinds.includes(kind)) });

/** A row that fails is saved with its error, and the others go on. */
async function played(play, row) {
  try {
    return await play(row);
  } catch (error) {
    const { kind, name, dimensions, count } = row;
    return { kind, name, dimensions, count, error: String(error?.message ?? error), contenders: [] };
  }
}

/** To check that everything runs: so few frames do not show speed. */
const shortened = (rows, frames) =>
  frames === undefined
    ? rows
    : rows.map((row) => ({ ...row, plan: { warmUp: Math.min(frames, row.plan?.warmUp ?? 0), timed: frames } }));

/** Replaces the file in one step, so that a reader never sees half of it. */
function save(output, record) {
  mkdirSync(dirname(output), { recursive: true });
  writeFileSync(`${output}.part`, `${JSON.stringify(record, rounded, 1)}\n`);
  renameSync(`${output}.part`, output);
}

/** Five digits are plenty. */
const rounded = (_key, value) =>
  typeof value === 'number' && !Number.isInteger(value) ? Number(value.toPrecision(5)) : value;

/** Writes docs/figures.md and the tables of README.md and worth-it.md from the results of this machine. */
export function writeDocuments() {
  const record = read(resultsFile);
  writeFileSync(path('../../docs/figures.md'), `${figuresPage(record)}\n`);
  const texts = { '../../README.md': headlineOf, '../../docs/guides/worth-it.md': worthOf };
  for (const [file, figuresOf] of Object.entries(texts)) {
    writeFileSync(path(file), putFigures(readFileSync(path(file), 'utf8'), figuresOf(record)));
  }
  console.log('Written: docs/figures.md, and the tables of README.md and of docs/guides/worth-it.md.');
}

function commit() {
  try {
    return execFileSync('git', ['rev-parse', '--short', 'HEAD'], { cwd: path('..'), encoding: 'utf8' }).trim();
  } catch {
    return undefined;
  }
}

/** The versions of the installed packages. */
function versions() {
  const { dependencies } = read(path('../package.json'));
  return { broadphase: read(path('../../package.json')).version, ...dependencies };
}

// `broadphase join`: every overlapping pair of a file of boxes that may be larger than memory.
import { once } from 'node:events';
import { stat } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { Worker } from 'node:worker_threads';
import { type Command, exitCode, type Input, named, UsageError } from './arguments.ts';
import { checkWritable, FileError } from './files.ts';
import { loadDuckDB } from './join/duckdb.ts';
import { DataError, openSource, type Source } from './join/source.ts';
import { type Plan, type TileStore, Work } from './join/work.ts';
import { type Found, workerMark } from './join/worker.ts';
import { bytes, counted, number, progressBar } from './terminal.ts';

/** The share of the allowed memory for DuckDB; the rest is for Node and the tiles that are searched. */
const databaseShare = 0.35;
/** Memory of Node and of a thread without any boxes. */
const nodeBytes = 110e6;
const threadBytes = 25e6;
/** Memory per box while its tile is searched: as read, as sent, in the kernel, and its pairs. */
const boxBytes = 400;
/** The most boxes in a tile on average. */
const mostPerTile = 250_000;
/** How much fuller than the average a tile may be. */
const fullest = 4;

const units: Record<string, number> = { '': 1, kb: 1e3, mb: 1e6, gb: 1e9, kib: 2 ** 10, mib: 2 ** 20, gib: 2 ** 30 };

function readMemory(input: Input): number {
  const text = input.text('memory') ?? '1GB';
  const [, value, unit = ''] = /^([\d.]+)\s*([a-z]*)$/i.exec(text) ?? [];
  const memory = Number(value) * (units[unit.toLowerCase()] ?? Number.NaN);
  if (!(memory >= 400e6)) throw new UsageError(`--memory is ${named(text)}, expected a size from 400MB, such as 1GB`);
  return memory;
}

function readColumns(input: Input): string[] | undefined {
  const columns = input.text('columns')?.split(',');
  if (columns && columns.length !== 4 && columns.length !== 6) {
    throw new UsageError(
      `--columns has ${columns.length} names, expected 4 or 6, separated by commas: minima, then maxima`,
    );
  }
  return columns;
}

export const joinCommand: Command = {
  summary: 'find every overlapping pair in a Parquet or CSV file of boxes',
  operands: { boxes: 'a Parquet or CSV file', pairs: 'the Parquet file to write' },
  options: {
    blue: {
      value: 'file',
      help: 'a second file: find pairs of a box of each file, instead of pairs within the first',
    },
    columns: {
      value: 'names',
      help: 'the columns of the corners (minX,minY,maxX,maxY, or minX,minY,minZ,maxX,maxY,maxZ)',
    },
    memory: { value: 'size', help: 'approximate memory to use (1GB)' },
    threads: { value: 'n', help: 'number of threads that search tiles (one per core)' },
    tile: { value: 'n', help: 'approximate number of boxes in a tile (250000, or as many as --memory allows)' },
    fresh: { help: 'start again, even if an interrupted join could be continued' },
  },
  async run(input, terminal) {
    const started = performance.now();
    const memory = readMemory(input);
    const columns = readColumns(input);
    const threads = input.number('threads', { least: 1, most: 256, whole: true }) ?? availableParallelism();
    const tile = input.number('tile', { least: 1, most: 2 ** 24, whole: true }) ?? mostPerTile;
    const [path, result] = input.operands;
    const paths = [path, ...(input.has('blue') ? [input.text('blue')!] : [])];
    const fit = Math.floor((memory * (1 - databaseShare) - nodeBytes - threads * threadBytes) / threads / boxBytes);
    if (fit < 1000)
      throw new UsageError(`--memory is too little for ${threads} threads; expected more memory or fewer threads`);
    for (const each of paths) await mustExist(each);
    await checkWritable('<pairs>', result, paths, 'an input');
    if (/\.(csv|tsv|json)(\.gz)?$/i.test(result)) {
      throw new UsageError(`<pairs> is ${result}, expected a name that ends in .parquet: it is a Parquet file`);
    }

    const work = await Work.open(loadDuckDB(), `${result}.join`, memory * databaseShare, threads);
    const progress = progressBar(terminal);
    try {
      const sources = await openSources(work, paths, columns);
      const perTile = Math.min(tile, fit);
      const plan = await planOf(work, sources, perTile, input.has('fresh'), (what) => progress.show(what, 0, 1));
      mustFit(work, plan, perTile);
      const done = await work.done();
      let pairs = [...done.values()].reduce((sum, count) => sum + count, 0);
      let searched = done.size;
      await searchTiles(work, plan, done, threads, (found) => {
        pairs += found;
        progress.show('tiles', ++searched, plan.sizes.length);
      });
      progress.show('writing the result', 1, 1);
      await work.finish(result);
      progress.end();
      const seconds = (performance.now() - started) / 1000;
      const peak = process.resourceUsage().maxRSS * 1024;
      const [tiles, resumed] = [plan.sizes.length, done.size];
      const facts = { pairs, boxes: plan.counts, dimensions: plan.dimensions, tiles, resumed, threads, seconds, peak };
      terminal.out(input.has('json') ? `${JSON.stringify({ path: result, ...facts })}\n` : told(result, facts));
      return exitCode.ok;
    } catch (error) {
      progress.end();
      work.close();
      throw error;
    }
  },
};

interface Facts {
  pairs: number;
  boxes: readonly number[];
  dimensions: number;
  tiles: number;
  resumed: number;
  seconds: number;
  peak: number;
}

function told(path: string, { pairs, boxes, dimensions, tiles, resumed, seconds, peak }: Facts): string {
  const went = resumed > 0 ? `, ${resumed} of them by an earlier run` : '';
  const [last] = boxes.slice(-1);
  const all = [...boxes.slice(0, -1).map(number), counted(last, 'box')].join(' and ');
  return (
    `${path}: ${counted(pairs, 'pair')} of ${all} in ${dimensions}D\n` +
    `${counted(tiles, 'tile')}${went}, ${number(seconds)} s, at most ${bytes(peak)} of memory\n`
  );
}

/** The plan of an earlier run of the same join, or else a new one. */
async function planOf(
  work: Work,
  sources: readonly Source[],
  perTile: number,
  fresh: boolean,
  say: (what: string) => void,
): Promise<Plan> {
  const job = JSON.stringify([1, sources.map(({ version }) => version), perTile]);
  return (fresh ? undefined : await work.resume(job)) ?? work.prepare(job, sources, perTile, say);
}

function mustFit(work: Work, plan: Plan, perTile: number): void {
  const most = plan.sizes.reduce((a, b) => Math.max(a, b), 0);
  const limit = fullest * Math.max(perTile, 1000);
  if (most <= limit) return;
  work.forget();
  throw new DataError(
    `${number(most)} boxes overlap one tile, expected no more than ${number(limit)}: they are too dense or too large for --memory`,
  );
}

/** Searches the tiles that are not done, in `threads` threads. */
async function searchTiles(
  work: Work,
  plan: Plan,
  done: ReadonlyMap<number, number>,
  threads: number,
  found: (pairs: number) => void,
): Promise<void> {
  const left = plan.sizes.flatMap((_, tile) => (done.has(tile) ? [] : tile));
  const stores = await Promise.all(Array.from({ length: Math.min(threads, left.length) }, () => work.tileStore(plan)));
  await Promise.all(stores.map((store) => searchAll(store, plan, left, found)));
}

async function mustExist(path: string): Promise<void> {
  await stat(path).catch((error: Error) => {
    throw new FileError(`cannot read ${path}: ${error.message}`);
  });
}

async function openSources(work: Work, paths: readonly string[], columns: string[] | undefined): Promise<Source[]> {
  const sources: Source[] = [];
  for (const path of paths) sources.push(await openSource(work.db, path, columns));
  const [red, blue] = sources;
  if (blue && blue.dimensions !== red.dimensions) {
    throw new DataError(
      `${red.path} has boxes in ${red.dimensions}D and ${blue.path} in ${blue.dimensions}D, expected the same`,
    );
  }
  return sources;
}

/** Searches tiles, in one thread, until none is left. */
async function searchAll(store: TileStore, plan: Plan, left: number[], done: (pairs: number) => void): Promise<void> {
  const worker = new Worker(new URL(import.meta.url), {
    workerData: { mark: workerMark, dimensions: plan.dimensions },
  });
  try {
    for (let tile = left.shift(); tile !== undefined; tile = left.shift()) {
      const asked = await store.read(tile);
      const answers = messagesOf(worker, asked, [asked.rows.buffer, asked.boxes.buffer]);
      done(await store.write(tile, answers));
    }
  } finally {
    await worker.terminate();
  }
}

/** The messages of a thread, up to the last one; the thread waits for a request before each. Throws its errors. */
async function* messagesOf(worker: Worker, ask: object, transfer: ArrayBufferLike[]): AsyncGenerator<Found> {
  worker.postMessage(ask, transfer as ArrayBuffer[]);
  for (;;) {
    const [found] = (await once(worker, 'message')) as [Found];
    yield found;
    if (found.last) return;
    worker.postMessage('more');
  }
}

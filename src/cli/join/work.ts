// The progress of a join: a DuckDB database beside the result. It holds the boxes by tile, the pairs found, and which
// tiles are done. The pairs of a tile and its mark "done" are one transaction, so a join that was killed can continue
// from the tiles that are done.
import { existsSync, rmSync } from 'node:fs';
import { corners } from '../../errors.ts';
import { FileError } from '../files.ts';
import { type Connection, type DuckDB, type Instance, quoted } from './duckdb.ts';
import { checkSource, reading, type Source, sampleSource } from './source.ts';
import { chooseTiles, type Tiles, tileOf } from './tiles.ts';
import type { Found, Tile } from './worker.ts';

/** The largest sample of boxes for choosing the cuts. */
const sampleSize = 20_000;
/** Rows in a chunk of DuckDB. */
const chunkRows = 2048;

export interface Plan extends Tiles {
  dimensions: 2 | 3;
  /** Boxes in each file. */
  counts: number[];
  /** Boxes in each tile, including those that begin in other tiles. */
  sizes: number[];
}

export class Work {
  readonly #duckdb: DuckDB;
  readonly #instance: Instance;
  readonly db: Connection;
  readonly #path: string;
  #planned = false;

  private constructor(duckdb: DuckDB, instance: Instance, db: Connection, path: string) {
    this.#duckdb = duckdb;
    this.#instance = instance;
    this.db = db;
    this.#path = path;
  }

  /** Opens the database at this path, or creates it. */
  static async open(duckdb: DuckDB, path: string, memory: number, threads: number): Promise<Work> {
    const options = {
      memory_limit: `${Math.round(memory / 1e6)}MB`,
      threads: String(threads),
      temp_directory: `${path}.tmp`,
      preserve_insertion_order: 'true',
    };
    const instance = await duckdb.DuckDBInstance.create(path, options).catch((error: Error) => {
      const reason = error.message.split('\n')[0];
      throw new FileError(`cannot save progress in ${path}: ${reason}: is another join of the same name running?`);
    });
    return new Work(duckdb, instance, await instance.connect(), path);
  }

  /** The plan in the database, if it is for this job. */
  async resume(job: string): Promise<Plan | undefined> {
    await this.db.run('create table if not exists job (job varchar, plan varchar)');
    const [row] = (await this.db.runAndReadAll('select job, plan from job')).getRows() as string[][];
    this.#planned = row?.[0] === job;
    return this.#planned ? (JSON.parse(row[1]) as Plan) : undefined;
  }

  /** Checks the files, and puts their boxes into tiles of about `perTile` each. */
  async prepare(job: string, sources: readonly Source[], perTile: number, say: (what: string) => void): Promise<Plan> {
    const { dimensions } = sources[0];
    for (const table of ['job', 'placed', 'pairs', 'done']) await this.db.run(`drop table if exists ${table}`);
    const counts: number[] = [];
    const sample: number[] = [];
    for (const source of sources) {
      say(`reading ${source.path}`);
      counts.push(await checkSource(this.db, source));
    }
    const total = counts.reduce((sum, count) => sum + count, 0);
    for (const [k, source] of sources.entries()) {
      const size = Math.ceil((sampleSize * counts[k]) / Math.max(1, total));
      if (size > 0) for (const value of await sampleSource(this.db, source, size)) sample.push(value);
    }
    const tiles = chooseTiles(sample, dimensions, Math.max(1, Math.ceil(total / perTile)));
    say('sorting boxes into tiles');
    const [low, high] = [corners[dimensions][tiles.axis], corners[dimensions][tiles.axis + dimensions]];
    const both = sources
      .map(({ sql }, colour) => `select ${colour}::utinyint as colour, * from ${sql}`)
      .join(' union all ');
    const seen = `unnest(range(${tileOf(low, tiles.cuts)}, ${tileOf(high, tiles.cuts)} + 1))::integer as tile`;
    const files = sources.map(({ path }) => path).join(', ');
    await reading(files, () =>
      this.db.run(`create table placed as select ${seen}, * from (${both}) order by tile, colour`),
    );
    const rows = (await this.db.runAndReadAll('select tile, count(*)::double from placed group by tile')).getRows();
    const sizes = Array.from({ length: tiles.cuts.length + 1 }, () => 0);
    for (const [tile, size] of rows) sizes[tile as number] = size as number;
    const plan = { ...tiles, dimensions, counts, sizes };
    await this.db.run('create table pairs (a double, b double)');
    await this.db.run('create table done (tile integer, pairs double)');
    await this.db.run('create table job (job varchar, plan varchar)');
    await this.db.run(`insert into job values (${quoted(job)}, ${quoted(JSON.stringify(plan))})`);
    await this.db.run('checkpoint');
    this.#planned = true;
    return plan;
  }

  /** The tiles that are done, with their numbers of pairs. */
  async done(): Promise<Map<number, number>> {
    return new Map((await this.db.runAndReadAll('select tile, pairs from done')).getRows() as [number, number][]);
  }

  /** A connection that reads tiles and stores their pairs, concurrently with others. */
  async tileStore(plan: Plan): Promise<TileStore> {
    return new TileStore(this.#duckdb, await this.#instance.connect(), plan);
  }

  /** Writes the result, and removes the database. */
  async finish(result: string): Promise<void> {
    const copy = `copy (select a::bigint as a, b::bigint as b from pairs) to ${quoted(result)} (format parquet)`;
    await this.db.run(copy).catch((error: Error) => {
      throw new FileError(`cannot write ${result}: ${error.message.split('\n')[0]}`);
    });
    this.#planned = false;
    this.close();
  }

  /** Drops the plan, so that no later run continues it. */
  forget(): void {
    this.#planned = false;
  }

  /** Closes the database. It stays for a later run if it has a plan; otherwise it is removed. */
  close(): void {
    this.db.closeSync();
    this.#instance.closeSync();
    if (this.#planned) return;
    for (const end of ['', '.wal', '.tmp']) {
      if (existsSync(this.#path + end)) rmSync(this.#path + end, { recursive: true });
    }
  }
}

/** One of several connections that read tiles and store their pairs. */
export class TileStore {
  readonly #duckdb: DuckDB;
  readonly #db: Connection;
  readonly #plan: Plan;

  constructor(duckdb: DuckDB, db: Connection, plan: Plan) {
    this.#duckdb = duckdb;
    this.#db = db;
    this.#plan = plan;
  }

  async read(tile: number): Promise<Tile> {
    const { dimensions, axis, cuts, sizes, counts } = this.#plan;
    const width = 2 * dimensions;
    const rows = new Float64Array(sizes[tile]);
    const boxes = new Float64Array(width * sizes[tile]);
    const colours = counts.length > 1 ? new Uint8Array(sizes[tile]) : undefined;
    const names = corners[dimensions].join();
    const result = await this.#db.stream(`select ${names}, row, colour from placed where tile = ${tile}`);
    let at = 0;
    for (let chunk = await result.fetchChunk(); chunk?.rowCount; chunk = await result.fetchChunk()) {
      for (let k = 0; k < width; k++) {
        const values = chunk.getColumnValues(k) as number[];
        for (let n = 0; n < values.length; n++) boxes[(at + n) * width + k] = values[n];
      }
      rows.set(chunk.getColumnValues(width) as number[], at);
      colours?.set(chunk.getColumnValues(width + 1) as number[], at);
      at += chunk.rowCount;
    }
    // Boxes that begin at infinity are in the last tile, which is unbounded.
    const [from, to] = [cuts[tile - 1] ?? -Infinity, cuts[tile] ?? Number.NaN];
    return { rows, boxes, colours, axis, from, to };
  }

  /** Stores the pairs of a tile, all or nothing. Returns how many there are. */
  async write(tile: number, pairs: AsyncIterable<Found>): Promise<number> {
    const { DOUBLE, DuckDBDataChunk } = this.#duckdb;
    await this.#db.run('begin transaction');
    const appender = await this.#db.createAppender('pairs');
    let count = 0;
    for await (const { first, second } of pairs) {
      for (let at = 0; at < first.length; at += chunkRows) {
        const size = Math.min(chunkRows, first.length - at);
        const chunk = DuckDBDataChunk.create([DOUBLE, DOUBLE], size);
        chunk.setColumnValues(0, Array.from(first.subarray(at, at + size)));
        chunk.setColumnValues(1, Array.from(second.subarray(at, at + size)));
        appender.appendDataChunk(chunk);
        count += size;
      }
    }
    appender.closeSync();
    await this.#db.run(`insert into done values (${tile}, ${count})`);
    await this.#db.run('commit');
    return count;
  }
}

// A file of boxes, read with DuckDB: which columns are the corners, which row is not a box, and a sample.
import { stat } from 'node:fs/promises';
import { corners } from '../../errors.ts';
import { UsageError } from '../arguments.ts';
import { FileError } from '../files.ts';
import { type Connection, named, quotedPath } from './duckdb.ts';

/** The contents of a file are wrong. */
export class DataError extends Error {}

/** A file of boxes. */
export interface Source {
  path: string;
  dimensions: 2 | 3;
  /** SQL: a table with the columns row (a double, counted from 0) and the corners (doubles; null for anything else). */
  sql: string;
  /** SQL: the same, with the corners as they are in the file. */
  raw: string;
  /** A value that changes when the file does. */
  version: string;
}

/** Runs SQL that reads files of the user: reports their errors as such, not as faults of this program. */
export async function reading<Result>(what: string, run: () => Promise<Result>): Promise<Result> {
  try {
    return await run();
  } catch (error) {
    const [first] = (error as Error).message.split(/\n(?=\n|Possible |The search )/); // the rest is how to call DuckDB
    const message = first!.replace(/\nOriginal Line:.*/, '').replace(/\.?\n/g, ', ');
    if (/out of memory/i.test(message)) throw new FileError(`${what}: ${message}: raise --memory, or free disk space`);
    throw new DataError(`${what}: ${message}`);
  }
}

/**
 * Opens a file of boxes.
 * @param columns the names of the corners, or undefined for minX, minY, (minZ,) maxX, maxY(, maxZ)
 */
export async function openSource(db: Connection, path: string, columns: string[] | undefined): Promise<Source> {
  const { size, mtimeMs } = await stat(path).catch((error: Error) => {
    throw new FileError(`cannot read ${path}: ${error.message}`);
  });
  const parquet = /\.(parquet|pq)$/i.test(path);
  if (!parquet && !/\.(csv|tsv)(\.gz)?$/i.test(path)) {
    throw new UsageError(`${path}: expected a name that ends in .parquet, .csv or .tsv (these also with .gz)`);
  }
  // Of CSV all columns are read as text. DuckDB would choose their types by the first rows, and round decimals in later
  // rows of what it took for integers.
  const plain = parquet ? `read_parquet(${quotedPath(path)}` : `read_csv(${quotedPath(path)}, all_varchar=true`;
  const { names } = await reading(path, async () => {
    const rows = (await db.runAndReadAll(`describe select * from ${plain})`)).getRows();
    return { names: rows.map(([name]) => String(name)) };
  });
  const find = (wanted: string) => names.find((name) => name.toLowerCase() === wanted.toLowerCase());
  const dimensions = columns ? ((columns.length / 2) as 2 | 3) : corners[3].every(find) ? 3 : 2;
  const wanted = columns ?? corners[dimensions];
  for (const name of wanted) {
    if (find(name) === undefined) {
      const isOneLine = names.length === 1 && /[,;\t|]/.test(names[0]!);
      const areNumbered = names.every((given, k) => given === `column${k}`); // by DuckDB, for want of names
      const among = `${names.join(', ')}${areNumbered ? ' (no row of names, or rows that differ in length)' : ''}`;
      const why = isOneLine
        ? 'its rows differ in their number of columns, or its separator is unknown'
        : `no column ${name}, expected it among ${among}; --columns names others`;
      throw new DataError(`${path}: ${why}`);
    }
  }
  const table = (pick: (column: string) => string) => {
    const picked = wanted.map((name, k) => `${pick(named(find(name)!))} as ${corners[dimensions][k]}`).join(', ');
    if (parquet) return `(select file_row_number::double as row, ${picked} from ${plain}, file_row_number=true))`;
    return `(select (row_number() over () - 1)::double as row, ${picked} from ${plain}))`;
  };
  const version = `${path} ${size} ${mtimeMs} ${wanted.join()}`;
  return { path, dimensions, sql: table((name) => `try_cast(${name} as double)`), raw: table((name) => name), version };
}

/**
 * Reads a whole file once, and returns the number of boxes in it.
 * @throws DataError that names the first row that is not a box
 */
export async function checkSource(db: Connection, { path, dimensions, sql, raw }: Source): Promise<number> {
  const names = corners[dimensions];
  const wrong = names
    .map((name) => `${name} is null or isnan(${name})`)
    .concat(Array.from({ length: dimensions }, (_, axis) => `${names[axis]} > ${names[axis + dimensions]}`))
    .join(' or ');
  const [[count, bad]] = await reading(path, async () =>
    (await db.runAndReadAll(`select count(*)::double, min(row) filter (where ${wrong}) from ${sql}`)).getRows(),
  );
  if (bad === null) return count as number;
  const query = (table: string) => `select ${names.join()} from ${table} where row = ${bad}`;
  const [box] = (await db.runAndReadAll(query(sql))).getRows();
  const [given] = (await db.runAndReadAll(query(raw))).getRows();
  const place = `${path}: row ${(bad as number).toLocaleString('en')} (counted from 0)`;
  for (const [k, value] of box.entries()) {
    if (value !== null && !Number.isNaN(value)) continue;
    const shown = given[k] === null ? 'empty' : String(given[k]);
    throw new DataError(`${place}: ${names[k]} is ${shown}, expected a number`);
  }
  const axis = names.findIndex((_, k) => (box[k] as number) > (box[k + dimensions] as number));
  throw new DataError(
    `${place}: ${names[axis]} ${box[axis]} is above ${names[axis + dimensions]} ${box[axis + dimensions]}, expected minima not above maxima`,
  );
}

/** A sample of the boxes of a file, as a flat array. */
export async function sampleSource(
  db: Connection,
  { path, dimensions, sql }: Source,
  count: number,
): Promise<number[]> {
  const query = `select ${corners[dimensions].join()} from ${sql} using sample reservoir(${count} rows) repeatable (1)`;
  return reading(path, async () => (await db.runAndReadAll(query)).getRows().flat() as number[]);
}

// The part of DuckDB's Node API that the join uses. The package is not a dependency: users who join files install it.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const packageName = '@duckdb/node-api';

export interface Chunk {
  readonly rowCount: number;
  getColumnValues(column: number): unknown[];
  setColumnValues(column: number, values: readonly unknown[]): void;
}

export interface Connection {
  run(sql: string): Promise<unknown>;
  runAndReadAll(sql: string): Promise<{ getRows(): unknown[][]; columnNames(): string[] }>;
  stream(sql: string): Promise<{ fetchChunk(): Promise<Chunk | null> }>;
  createAppender(table: string): Promise<{ appendDataChunk(chunk: Chunk): void; closeSync(): void }>;
  closeSync(): void;
}

export interface Instance {
  connect(): Promise<Connection>;
  closeSync(): void;
}

export interface DuckDB {
  DuckDBInstance: { create(path: string, options: Record<string, string>): Promise<Instance> };
  DuckDBDataChunk: { create(types: readonly unknown[], rowCount: number): Chunk };
  DOUBLE: unknown;
}

/** The package is not installed. */
export class MissingPackage extends Error {}

/**
 * Finds the package beside this one, or else in the project of the current folder.
 * @throws MissingPackage that says how to install it
 */
export function loadDuckDB(): DuckDB {
  for (const from of [import.meta.url, pathToFileURL(join(process.cwd(), 'package.json')).href]) {
    const require = createRequire(from);
    try {
      require.resolve(packageName);
    } catch {
      continue;
    }
    return require(packageName) as DuckDB;
  }
  throw new MissingPackage(
    `join needs the package ${packageName}, which is not installed; install it beside this one: npm install ${packageName}`,
  );
}

/** A text as an SQL literal. */
export const quoted = (text: string): string => `'${text.replaceAll("'", "''")}'`;

/** A path as an SQL literal: DuckDB takes `*`, `?` and `[` in it for patterns, unless each is a class of its own. */
export const quotedPath = (path: string): string => quoted(path.replace(/[*?[]/g, '[$&]'));

/** The name of a column as an SQL identifier. */
export const named = (column: string): string => `"${column.replaceAll('"', '""')}"`;

// Files of boxes: random ones, written by DuckDB.
import { DuckDBInstance } from '@duckdb/node-api';

/** Runs SQL in an in-memory database, and returns the rows of the last result. */
export async function ask(sql, options = {}) {
  const instance = await DuckDBInstance.create(':memory:', options);
  const connection = await instance.connect();
  try {
    return (await connection.runAndReadAll(sql)).getRows();
  } finally {
    connection.closeSync();
    instance.closeSync();
  }
}

/**
 * Writes a Parquet or CSV file of boxes that are 5 to 15 wide.
 * @param density the total area of the boxes, divided by the area of their world
 */
export async function writeBoxes(path, count, { density = 1, seed = 0.25, dimensions = 2 } = {}) {
  const world = ((count * 10 ** dimensions) / density) ** (1 / dimensions);
  const axes = ['X', 'Y', 'Z'].slice(0, dimensions);
  const random = axes.map((axis) => `random() * ${world} as min${axis}, 5 + 10 * random() as size${axis}`);
  const corners = [
    ...axes.map((axis) => `"min${axis}"`),
    ...axes.map((axis) => `min${axis} + size${axis} as "max${axis}"`),
  ];
  const boxes = `select ${corners.join(', ')} from (select ${random.join(', ')} from range(${count}))`;
  // One thread: the same seed gives the same boxes.
  await ask(`select setseed(${seed}); copy (${boxes}) to '${path}'`, { threads: '1' });
}

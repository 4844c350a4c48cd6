// The same by DuckDB alone, with SPATIAL_JOIN of its spatial extension. Prints its peak memory.
// node spatial.mjs <extension> <boxes> <pairs> <memory> <folder to spill to, or nothing for none>
import { DuckDBInstance } from '@duckdb/node-api';

const [extension, boxes, pairs, memory, spill] = process.argv.slice(2);
try {
  const instance = await DuckDBInstance.create(':memory:', {
    memory_limit: memory,
    temp_directory: spill,
    allow_unsigned_extensions: 'true',
  });
  const connection = await instance.connect();
  await connection.run(`load '${extension}'`);
  await connection.run(`
    create table boxes as
      select file_row_number as row, minX, minY, maxX, maxY, st_makeenvelope(minX, minY, maxX, maxY) as shape
      from read_parquet('${boxes}', file_row_number=true)`);
  // With any condition besides the one on shapes, DuckDB does not use its spatial join. It finds each pair twice,
  // and each box with itself.
  await connection.run(`
    create table found as
      select one.row as a, other.row as b
      from boxes one join boxes other on st_intersects(one.shape, other.shape)`);
  await connection.run(`copy (from found where a < b) to '${pairs}'`);
  console.log(process.resourceUsage().maxRSS * 1024);
} catch (error) {
  console.error(error.message.split('\n')[0]);
  process.exitCode = 1;
}

// Every overlapping pair of a Parquet file of boxes, by `broadphase join`:
//
//   npm i && npm start
//   npm start -- --boxes 10000000 --memory 1GB
//
// With --spatial <file>, DuckDB's own spatial join runs on the same file, with the same memory, and has to find the
// same pairs. The file is the spatial extension for the installed DuckDB; the wheel of duckdb-extension-spatial on
// PyPI contains it. With --no-spill it must not spill to disk, and with --limit <seconds> it is stopped after that
// time.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { ask, writeBoxes } from './boxes.mjs';

const { values } = parseArgs({
  options: {
    boxes: { type: 'string', default: '1000000' },
    memory: { type: 'string', default: '1GB' },
    density: { type: 'string', default: '1' },
    spatial: { type: 'string' },
    'no-spill': { type: 'boolean', default: false },
    limit: { type: 'string', default: '300' },
  },
});
const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const command = fileURLToPath(new URL('dist/cli.js', import.meta.resolve('broadphase/package.json')));
const folder = mkdtempSync(join(tmpdir(), 'broadphase-join-'));
const [boxes, ours, theirs] = ['boxes', 'ours', 'theirs'].map((name) => join(folder, `${name}.parquet`));
const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(1)} s`;

/** Runs a part of this program in a process of its own, so that its memory can be measured. */
function alone(timeout, file, ...args) {
  return spawnSync(process.execPath, [file, ...args], { cwd: path('.'), encoding: 'utf8', timeout });
}

try {
  console.log(`${Number(values.boxes).toLocaleString('en')} boxes:`);
  await writeBoxes(boxes, Number(values.boxes), { density: Number(values.density) });
  const started = performance.now();
  const { stdout, stderr, status } = alone(
    undefined,
    command,
    'join',
    boxes,
    ours,
    '--memory',
    values.memory,
    '--json',
  );
  if (status !== 0) throw new Error(stderr);
  const { pairs, tiles, peak } = JSON.parse(stdout);
  const facts = `${pairs.toLocaleString('en')} pairs in ${tiles} tiles, at most ${(peak / 1e6).toFixed(0)} MB`;
  console.log(`  broadphase join: ${seconds(started)}, ${facts}`);

  if (values.spatial) {
    const began = performance.now();
    const spill = values['no-spill'] ? '' : `${theirs}.tmp`;
    const args = [values.spatial, boxes, theirs, values.memory, spill];
    const { status, stdout, stderr, error } = alone(1000 * values.limit, path('spatial.mjs'), ...args);
    if (error) console.log(`  DuckDB's spatial join: no answer in ${seconds(began)}`);
    else if (status !== 0) console.log(`  DuckDB's spatial join: failed after ${seconds(began)}: ${stderr.trim()}`);
    else {
      console.log(`  DuckDB's spatial join: ${seconds(began)}, at most ${(Number(stdout) / 1e6).toFixed(0)} MB`);
      const [[missing, extra]] = await ask(
        `select (select count(*) from (from '${ours}' except from '${theirs}')),
                (select count(*) from (from '${theirs}' except from '${ours}'))`,
      );
      console.log(`  pairs that only the one has: ${missing}, only the other: ${extra}`);
    }
  }
} finally {
  rmSync(folder, { recursive: true });
}

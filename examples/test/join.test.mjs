// `broadphase join` as a process: its pairs are those of the reference, even after it was killed; errors say what is
// wrong.
import { spawn } from 'node:child_process';
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, test, vi } from 'vitest';
import { bundle } from '../../scripts/bundle.mjs';
import { keysOf, referencePairs } from '../../test/support/reference.ts';

const here = fileURLToPath(new URL('../apart/join-duckdb', import.meta.url)); // where the command finds DuckDB
const installed = Boolean(process.env.CI) || existsSync(join(here, '../node_modules/@duckdb/node-api'));
const folder = mkdtempSync(join(tmpdir(), 'broadphase-join-'));
const file = (name) => join(folder, name);
vi.setConfig({ testTimeout: 120_000 }); // most start DuckDB and worker threads several times
let command;
let duck;

/** Runs the command; `during` is called with the process. */
async function run(args, { cwd = here, during } = {}) {
  const started = spawn(process.execPath, [command, 'join', ...args], { cwd });
  let [out, err] = ['', ''];
  started.stdout.on('data', (data) => {
    out += data;
  });
  started.stderr.on('data', (data) => {
    err += data;
  });
  during?.(started);
  const code = await new Promise((resolve) => started.on('close', resolve));
  return { code, out, err };
}

const pairsIn = async (path) => keysOf((await duck.ask(`select a::double, b::double from '${path}'`)).flat()).sort();
const boxesIn = async (path, dimensions = 2) => {
  const names = dimensions === 2 ? 'minX, minY, maxX, maxY' : 'minX, minY, minZ, maxX, maxY, maxZ';
  return Float64Array.from((await duck.ask(`select ${names} from '${path}'`)).flat());
};

/** A CSV of boxes of integers, none of which overlap, and then others. */
function manyWith(...rows) {
  const lines = Array.from({ length: 50_000 }, (_, k) => `${20 * k},0,${20 * k + 10},10\n`);
  const texts = ['minX,minY,maxX,maxY\n', ...lines, ...rows.flatMap((row) => [row, '\n'])];
  return Buffer.concat(texts.map((text) => Buffer.from(text)));
}

beforeAll(async () => {
  command = await bundle('src/cli/index.ts', 'build/cli/join.mjs');
  if (!installed) return;
  duck = await import('../apart/join-duckdb/boxes.mjs');
  await duck.writeBoxes(file('boxes.parquet'), 40_000);
});
afterAll(() => rmSync(folder, { recursive: true }));

describe.skipIf(!installed)('broadphase join', () => {
  test('finds the pairs of the reference, in one tile and in many', async () => {
    const expected = referencePairs(await boxesIn(file('boxes.parquet')), 2);
    for (const more of [[], ['--tile', '900', '--memory', '500MB', '--threads', '3']]) {
      const { code, out, err } = await run([file('boxes.parquet'), file('pairs.parquet'), '--json', ...more]);
      expect([code, err]).toEqual([0, '']);
      expect(JSON.parse(out)).toMatchObject({ pairs: expected.length, boxes: [40_000], tiles: more.length ? 45 : 1 });
      expect(await pairsIn(file('pairs.parquet'))).toEqual(expected);
      expect(existsSync(file('pairs.parquet.join'))).toBe(false);
    }
  });

  test('finds those of 3D, of CSV, and of boxes that are huge, endless, points, or touch', async () => {
    await duck.writeBoxes(file('solid.csv'), 3000, { dimensions: 3, density: 2 });
    await run([file('solid.csv'), file('solid.parquet'), '--tile', '500']);
    const expected = referencePairs(await boxesIn(file('solid.csv'), 3), 3);
    expect(expected.length).toBeGreaterThan(1000);
    expect(await pairsIn(file('solid.parquet'))).toEqual(expected);

    const odd = `select case when k % 97 = 0 then '-Infinity'::double else x end as "minX", y as "minY",
      case when k % 89 = 0 then 'Infinity'::double when k % 31 = 0 then x + 400 when k % 7 = 0 then x else x + 3 end as "maxX",
      y + k % 4 as "maxY" from (select range as k, (range * 37) % 500 as x, (range * 11) % 490 / 10 as y from range(3000))`;
    await duck.ask(`copy (${odd}) to '${file('odd.parquet')}'`);
    const { out } = await run([file('odd.parquet'), file('odd-pairs.parquet'), '--tile', '300', '--json']);
    expect(JSON.parse(out).tiles).toBeGreaterThan(3);
    expect(await pairsIn(file('odd-pairs.parquet'))).toEqual(referencePairs(await boxesIn(file('odd.parquet')), 2));
  });

  test('finds those of CSV as doubles, where its first rows hold integers', async () => {
    writeFileSync(file('late.csv'), manyWith('5.4,20,5.4,20', '4.6,20,4.6,20', '-5,20,Infinity,20', '5.4,20,1e99,20'));
    await run([file('late.csv'), file('late.parquet')]);
    const pairs = [50_000, 50_002, 50_000, 50_003, 50_001, 50_002, 50_002, 50_003]; // not 50,000 with 50,001
    expect(await pairsIn(file('late.parquet'))).toEqual(keysOf(pairs).sort());
  });

  test('finds those of red and blue boxes', async () => {
    await duck.writeBoxes(file('red.parquet'), 3000, { density: 0.3, seed: 0.5 });
    await duck.writeBoxes(file('blue.csv'), 3000, { density: 0.3, seed: 0.75 });
    const args = [file('red.parquet'), file('both.parquet'), '--blue', file('blue.csv'), '--tile', '700', '--json'];
    expect(JSON.parse((await run(args)).out).boxes).toEqual([3000, 3000]);
    const [red, blue] = [await boxesIn(file('red.parquet')), await boxesIn(file('blue.csv'))];
    const expected = referencePairs(Float64Array.from([...red, ...blue]), 2);
    const mixed = expected.filter((key) => Math.floor(key / 2 ** 24) < 3000 && key % 2 ** 24 >= 3000);
    const found = (await duck.ask(`select a::double, b::double from '${file('both.parquet')}'`)).flat();
    expect(keysOf(found.map((row, k) => (k % 2 ? row + 3000 : row))).sort()).toEqual(mixed);
    expect(mixed.length).toBeGreaterThan(500);
  });
});

describe.skipIf(!installed)('a run of broadphase join', () => {
  test('reads the file of that name, though it looks like a pattern', async () => {
    for (const [name, like] of [
      ['a[1]', 'a1'],
      ['a*', 'abc'],
      ['a?', 'ax'],
      ['[[]*?', '[yz'],
    ]) {
      await duck.writeBoxes(file(`${like}.csv`), 20);
      await duck.writeBoxes(file(`${like}.parquet`), 20);
      await duck.writeBoxes(file('plain.parquet'), 30);
      await duck.writeBoxes(file('plain.csv'), 30);
      for (const end of ['csv', 'parquet']) {
        copyFileSync(file(`plain.${end}`), file(`${name}.${end}`));
        const { out } = await run([file(`${name}.${end}`), file('named.parquet'), '--json']);
        expect(JSON.parse(out).boxes, name).toEqual([30]);
      }
    }
  });

  test('goes on where it was killed', async () => {
    const args = [file('boxes.parquet'), file('killed.parquet'), '--tile', '200', '--json'];
    let resumed = 0;
    let kills = 0;
    for (let wait = 600; ; wait += 300) {
      const { code, out } = await run(args, {
        during: (started) => {
          const timer = setTimeout(() => started.kill('SIGKILL'), wait);
          started.on('close', () => clearTimeout(timer));
        },
      });
      if (code === 0) {
        ({ resumed } = JSON.parse(out));
        break;
      }
      kills++;
    }
    expect([kills > 0, resumed > 0]).toEqual([true, true]);
    expect(await pairsIn(file('killed.parquet'))).toEqual(referencePairs(await boxesIn(file('boxes.parquet')), 2));
    expect(existsSync(file('killed.parquet.join'))).toBe(false);
  });
});

const none = file('none.parquet');

/** What is said of a file in which one column of some row has another value. */
async function saidOf(change, name = 'bad.parquet') {
  const rows = `(select *, file_row_number as row from read_parquet('${file('boxes.parquet')}', file_row_number=true))`;
  const all = `select * exclude (row, file_row_number) replace (${change}) from ${rows}`;
  await duck.ask(`copy (${all}) to '${file(name)}'`);
  const { code, err } = await run([file(name), none]);
  expect(existsSync(`${none}.join`)).toBe(false);
  return [code, err];
}

/** The code and the first line of what is said. */
async function said(...args) {
  const { code, err } = await run(args);
  return [code, err.split('\n')[0]];
}

describe.skipIf(!installed)('broadphase join names what is wrong', () => {
  test('in a row', async () => {
    expect(await saidOf(`case when row = 31415 then 'NaN'::double else minX end as minX`)).toEqual([
      3,
      `broadphase: ${file('bad.parquet')}: row 31,415 (counted from 0): minX is NaN, expected a number\n`,
    ]);
    const [code, message] = await saidOf('case when row = 7 then minY - 1 else maxY end as maxY');
    expect([code, message]).toEqual([
      3,
      expect.stringMatching(/row 7 .*minY [\d.]+ is above maxY [\d.]+, expected minima/),
    ]);
    expect((await saidOf('case when row = 12 then null else maxY end as maxY', 'bad.csv'))[1]).toMatch(
      /row 12 .*maxY is empty, expected a number/,
    );
  });

  test('in a row far below those by which columns of CSV are told', async () => {
    for (const [row, what] of [
      ['n/a,0,1,1', 'row 50,000 (counted from 0): minX is n/a, expected a number'],
      ['0.6,0,0.4,1', 'row 50,000 (counted from 0): minX 0.6 is above maxX 0.4, expected minima not above maxima'],
      ['0,0,1', 'CSV Error on Line: 50002, Expected Number of Columns: 4 Found: 3'],
      [Buffer.from('Z\xfcrich,0,1,1', 'latin1'), 'This file is not utf-8 encoded.'],
    ]) {
      writeFileSync(file('deep.csv'), manyWith(row));
      expect(await said(file('deep.csv'), none)).toEqual([3, expect.stringContaining(what)]);
    }
  });

  test('in a file or an option', async () => {
    writeFileSync(file('cut.parquet'), readFileSync(file('boxes.parquet')).subarray(0, 200_000));
    writeFileSync(file('word.csv'), 'minX,minY,maxX,maxY\n0,0,1,1\n0,0,hello,1\n');
    writeFileSync(file('few.csv'), 'minX,minY\n0,0\n');
    writeFileSync(file('long.csv'), 'minX,minY,maxX,maxY\n0,0,1,1\n0,0,1,1,1\n');
    expect(await said(file('cut.parquet'), none)).toEqual([3, expect.stringMatching(/cut\.parquet: .*magic bytes/)]);
    expect(await said(file('word.csv'), none)).toEqual([
      3,
      expect.stringContaining('row 1 (counted from 0): maxX is hello'),
    ]);
    expect(await said(file('few.csv'), none)).toEqual([
      3,
      expect.stringContaining('no column maxX, expected it among minX'),
    ]);
    expect(await said(file('long.csv'), none)).toEqual([3, expect.stringContaining('rows that differ in length')]);
    expect(await said(file('absent.parquet'), none)).toEqual([4, expect.stringContaining('cannot read')]);
    expect(await said(file('boxes.parquet'), none, '--memory', '1')).toEqual([
      2,
      expect.stringContaining('--memory is 1'),
    ]);
    expect(await said(file('boxes.parquet'), file('boxes.parquet'))).toEqual([
      2,
      expect.stringContaining('is an input'),
    ]);
  });
});

test('asks for DuckDB by its name where that is missing', async () => {
  writeFileSync(file('boxes.csv'), 'minX,minY,maxX,maxY\n0,0,1,1\n');
  const { code, err } = await run([file('boxes.csv'), file('pairs.parquet')], { cwd: folder });
  expect([code, err]).toEqual([5, expect.stringContaining('npm install @duckdb/node-api')]);
});

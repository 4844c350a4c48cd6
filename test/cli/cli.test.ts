// The command, end to end in this process: what it prints, what it writes, and how it exits.
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import { BroadPhase } from 'broadphase';
import { openTrace, type Tuned } from 'broadphase/trace';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { version } from '../../package.json';
import { sceneNames } from '../../src/scenes/index.ts';
import { runCommand } from '../support/command.ts';
import { traceFile } from '../support/recordings.ts';

const folder = mkdtempSync(join(tmpdir(), 'broadphase-'));
const file = (name: string) => join(folder, name);
const small = file('small.trace');

/** Runs a command line. */
const run = (...argv: string[]) => runCommand(argv);

async function json(...argv: string[]) {
  const { code, out, err } = await run(...argv, '--json');
  return { code, err, result: JSON.parse(out) };
}

beforeAll(async () => {
  expect(await run('generate', 'mixed2d', small, '--count', '400', '--frames', '6')).toMatchObject({
    code: 0,
    err: '',
  });
});

afterAll(() => rmSync(folder, { recursive: true }));

describe('help and wrong command lines', () => {
  test.each([['--help'], ['help']])('%s lists the commands', async (argument) => {
    const { code, out } = await run(argument);
    expect(code).toBe(0);
    for (const name of ['info', 'replay', 'compare', 'tune', 'convert', 'generate', 'Exit codes']) {
      expect(out).toContain(name);
    }
  });

  test('each command explains itself', async () => {
    for (const name of ['info', 'replay', 'compare', 'tune', 'convert', 'generate']) {
      const { code, out } = await run(name, '--help');
      expect(code).toBe(0);
      expect(out).toContain(`broadphase ${name}`);
      expect(out).toContain('--json');
    }
  });

  test.each([
    [[], 'expected a command'],
    [['toString'], "unknown command 'toString'"],
    [['info'], "missing required argument 'trace'"],
    [['info', 'a', 'b'], 'but got 2'],
    [['info', small, '--colour'], '--colour'],
    [['replay', small, '--technique', 'magic'], 'no magic, expected one of brute-force'],
    [['replay', small, '--technique', 'auto,auto'], 'expected one name'],
    [['replay', small, '--cell-size', '-1'], '--cell-size'],
    [['replay', small, '--cell-size', '1,2,3'], '2 separated by commas'],
    [['replay', small, '--frames', '3..9'], 'from 0 to 5'],
    [['compare', small, '--passes', '0'], '--passes is 0'],
    [['tune', small, '--seconds', 'long'], '--seconds is long'],
    [['generate', 'mixed4d', file('x')], 'no scene mixed4d'],
    [['generate', 'mixed2d', file('x'), '--count', '1.5'], 'an integer from 0'],
  ])('%j is refused with code 2', async (argv, message) => {
    const { code, err, out } = await run(...argv);
    expect({ code, out }).toEqual({ code: 2, out: '' });
    expect(err).toContain(message);
    expect(err).toContain('--help');
  });
});

describe('files that are not traces', () => {
  test('one that is not there: code 4', async () => {
    expect(await run('info', file('nowhere'))).toMatchObject({ code: 4, err: expect.stringContaining('cannot read') });
    expect(await run('convert', small, file('no/where'))).toMatchObject({ code: 4 });
  });

  test('one that is cut off or corrupted: code 3 and the place; cut off it can be salvaged', async () => {
    const bytes = readFileSync(small);
    writeFileSync(file('cut'), bytes.subarray(0, -20));
    const { code, result, err } = await json('info', file('cut'));
    expect(code).toBe(3);
    expect(result.error).toMatchObject({ code: 3, frame: 5, offset: expect.any(Number) });
    expect(err).toContain('frame 5, byte');
    const salvaged = await json('info', file('cut'), '--salvage');
    expect(salvaged).toMatchObject({
      code: 0,
      result: { frames: 5 },
      err: expect.stringContaining('5 frames salvaged'),
    });
    bytes[100] ^= 4;
    writeFileSync(file('flipped'), bytes);
    expect(await run('replay', file('flipped'))).toMatchObject({ code: 3, err: expect.stringContaining('checksum') });
  });
});

test('info tells what is in a trace', async () => {
  const { code, result } = await json('info', traceFile('tumbler'));
  expect(code).toBe(0);
  expect(result).toMatchObject({
    dimensions: 2,
    frames: 21,
    ids: false,
    doubles: false,
    boxes: { min: 2029, max: 2029 },
  });
  expect(result.pairs.min).toBeGreaterThan(2029);
  expect(result.histograms.side.reduce((sum: number, { count }: { count: number }) => sum + count, 0)).toBe(2029);
  const { out } = await run('info', traceFile('tumbler'));
  expect(out).toMatch(/boxes +2,029/);
  expect(out).toContain('█');
});

test.each(BroadPhase.techniques)('replay verifies %s', { tags: 'long' }, async (technique) => {
  for (const name of ['smash', 'rapier3d-gravity8k'] as const) {
    const argv = ['replay', traceFile(name), '--technique', technique, '--frames', '0..1', '--verify'];
    const { code, result } = await json(...argv, '--cell-size', '3');
    expect(code).toBe(0);
    expect(result).toMatchObject({ technique, cellSize: 3, verified: true, frames: [{ index: 0 }, { index: 1 }] });
    expect(result.frames[1].pairs).toBeGreaterThan(1000);
  }
});

test('replay prints a table, and says that all is exact', async () => {
  const { code, out } = await run('replay', small, '--verify', '--cell-size', '4,8');
  expect(code).toBe(0);
  expect(out).toContain('verified: the pairs of all 6 frames are exact');
});

test('compare runs every technique, and all agree', async () => {
  const { code, result } = await json('compare', small, '--passes', '1');
  expect(code).toBe(0);
  expect(result.agree).toBe(true);
  const names = result.techniques.map(({ technique }: { technique: string }) => technique);
  expect(names.sort()).toEqual([...BroadPhase.techniques].sort());
  for (const { ms, tests, bytes } of result.techniques) {
    expect(ms.p95).toBeGreaterThanOrEqual(ms.median);
    expect(tests).toBeGreaterThan(0);
    expect(bytes).toBeGreaterThan(0);
  }
  const { out } = await run('compare', small, '--techniques', 'auto,brute-force', '--passes', '1');
  expect(out).toContain('all agree');
  expect(out).not.toContain('spatial-grid  ');
});

test('tune recommends options, as code, and writes a report that asks for nothing', async () => {
  const report = file('report.html');
  const { code, result } = await json('tune', small, '--seconds', '0', '--report', report);
  const { best, auto, code: paste, finalists, techniques, curves } = result as Tuned;
  expect(code).toBe(0);
  expect(best.ms.mean).toBeLessThanOrEqual(auto.ms.mean);
  expect(result.noise).toBeGreaterThanOrEqual(0);
  expect(finalists.filter(({ technique }) => technique === 'auto')).toHaveLength(1);
  expect(finalists.map(({ ms }) => ms.mean)).toEqual(finalists.map(({ ms }) => ms.mean).sort((a, b) => a - b));
  expect(techniques.map(({ technique }) => technique).sort()).toEqual([...BroadPhase.techniques].sort());
  expect(curves.filter(({ parameter }) => parameter === 'cellSize').map(({ technique }) => technique)).toContain(
    'spatial-grid',
  );
  expect(curves.filter(({ parameter }) => parameter === 'margin').map(({ technique }) => technique)).toContain(
    'aabb-tree',
  );
  const [, statement] = paste.split(/^import \{ BroadPhase \} from 'broadphase(?:\/all)?';\n/);
  expect(() => new Function('BroadPhase', statement)(BroadPhase)).not.toThrow();

  const page = readFileSync(report, 'utf8');
  expect(page).toContain(`default-src 'none'`);
  expect(page).toContain('<svg');
  expect(page).toMatch(/<title>frame 1\n[\s\S]*?<\/title>/); // numbers where the pointer rests
  expect(page).not.toMatch(/https?:|src=|href=|@import|url\(|<script|NaN|undefined/);
  const { out } = await run('tune', small, '--seconds', '0', '--techniques', 'brute-force');
  expect(out).toContain('new BroadPhase(');
});

test('convert goes from raw to trace and back without loss', async () => {
  const trace = file('spinner.trace.gz');
  const raw = file('spinner.bin');
  const given = file('given.bin.gz');
  expect((await run('convert', traceFile('spinner'), given)).code).toBe(0);
  expect((await json('convert', given, trace)).result).toMatchObject({ dimensions: 2 });
  expect(openTrace(gunzipSync(readFileSync(trace))).frames).toBeGreaterThan(1);
  expect((await run('convert', trace, raw)).code).toBe(0);
  expect((await run('convert', raw, `${raw}.gz`)).code).toBe(0);
  expect(Buffer.compare(gunzipSync(readFileSync(`${raw}.gz`)), readFileSync(raw))).toBe(0);
  expect(Buffer.compare(gunzipSync(readFileSync(given)), readFileSync(raw))).toBe(0);
  const first = new Float32Array(readFileSync(raw).buffer.slice(16, 32));
  const [frame] = openTrace(gunzipSync(readFileSync(trace)));
  expect([...frame.boxes.subarray(0, 4)]).toEqual([...first]);
});

test.each(sceneNames)('generate makes %s', async (name) => {
  const path = file(name);
  const { code, result } = await json('generate', name, path, '--count', '50', '--frames', '3', '--seed', '7');
  expect({ code, result }).toMatchObject({ code: 0, result: { count: 50, frames: 3 } });
  expect(openTrace(readFileSync(path))).toMatchObject({ frames: 3, dimensions: name.endsWith('3d') ? 3 : 2 });
});

test('a scene without boxes or frames can be looked at', async () => {
  for (const [count, frames] of ['00', '03', '30']) {
    const path = file(`empty-${count}-${frames}`);
    expect((await run('generate', 'uniform3d', path, '--count', count, '--frames', frames)).code).toBe(0);
    for (const command of ['info', 'replay']) expect((await run(command, path)).code).toBe(0);
    expect((await run('compare', path)).code).toBe(frames === '0' ? 3 : 0); // nothing was compared
  }
});

describe('init', () => {
  test('makes a folder with a game, which asks for this version', async () => {
    const game = file('My Game');
    const { code, out } = await run('init', game);
    expect(code).toBe(0);
    expect(out).toContain('npm start');
    const manifest = JSON.parse(readFileSync(join(game, 'package.json'), 'utf8'));
    expect(manifest).toMatchObject({ name: 'my-game', private: true, dependencies: { broadphase: `^${version}` } });
    const main = readFileSync(join(game, 'src/main.ts'), 'utf8');
    expect(main).toContain("from 'broadphase'");
    expect(main.split('\n').length).toBeLessThanOrEqual(100);
    for (const name of ['index.html', 'tsconfig.json', '.gitignore'])
      expect(readFileSync(join(game, name)).length).not.toBe(0);
  });

  test('takes a tarball', async () => {
    writeFileSync(file('broadphase.tgz'), '');
    const { result } = await json('init', file('other'), '--package', file('broadphase.tgz'));
    expect(result).toEqual({ folder: file('other'), broadphase: 'file:../broadphase.tgz' });
  });

  test('takes the tarball that the project around it has', async () => {
    const around = process.cwd();
    process.chdir(folder);
    try {
      writeFileSync('package.json', JSON.stringify({ dependencies: { broadphase: 'file:broadphase.tgz' } }, null, 2));
      const { result } = await json('init', 'inside');
      expect(result).toMatchObject({ broadphase: 'file:../broadphase.tgz' });
      writeFileSync('package.json', JSON.stringify({ dependencies: { broadphase: 'file:absent.tgz' } }, null, 2));
      expect((await json('init', 'beside')).result).toMatchObject({ broadphase: `^${version}` });
    } finally {
      process.chdir(around);
      rmSync(file('package.json'));
    }
  });

  test('leaves a folder alone that has files in it, or where the tarball is not there', async () => {
    expect(await run('init', folder)).toMatchObject({
      code: 2,
      out: '',
      err: expect.stringContaining('is not empty'),
    });
    const absent = await run('init', file('third'), '--package', file('absent.tgz'));
    expect(absent).toMatchObject({ code: 4, out: '', err: expect.stringContaining('absent.tgz') });
    expect(existsSync(file('third'))).toBe(false);
    expect(await run('init', join(small, 'inside'))).toMatchObject({ code: 4, out: '' });
  });

  test('leaves nothing behind if a file cannot be written', async () => {
    const there = file('there');
    mkdirSync(there);
    for (const parent of [file('new'), there]) {
      // A folder can be made whose files would have paths that are too long.
      let deep = parent;
      while (deep.length < 4088) deep = join(deep, 'd'.repeat(Math.min(200, 4089 - deep.length)));
      const { code, err } = await run('init', deep);
      expect([code, err.includes('cannot write')]).toEqual([4, true]);
    }
    expect(existsSync(file('new'))).toBe(false);
    expect(readdirSync(there)).toEqual([]);
  });
});

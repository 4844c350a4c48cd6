// What a stranger found in the command: inputs overwritten, other files read, and messages that mislead.
import { spawnSync } from 'node:child_process';
import {
  existsSync,
  linkSync,
  mkdirSync,
  mkdtempSync,
  openSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { TraceWriter } from 'broadphase/trace';
import { afterAll, afterEach, describe, expect, test } from 'vitest';
import { bundle } from '../../scripts/bundle.mjs';
import type { Terminal } from '../../src/cli/arguments.ts';
import { quotedPath } from '../../src/cli/join/duckdb.ts';
import { linePlot } from '../../src/cli/plots.ts';
import { reportOf } from '../../src/cli/report.ts';
import { table } from '../../src/cli/terminal.ts';
import { runCommand } from '../support/command.ts';

const folder = mkdtempSync(join(tmpdir(), 'broadphase-'));
const file = (name: string) => join(folder, name);
afterAll(() => rmSync(folder, { recursive: true }));

const run = (...argv: string[]) => runCommand(argv);

describe('join', () => {
  test('does not write over an input, whatever its name', async () => {
    const rows = 'minX,minY,maxX,maxY\n0,0,1,1\n';
    for (const name of ['boxes.csv', 'other.csv']) writeFileSync(file(name), rows);
    symlinkSync(file('boxes.csv'), file('soft.csv'));
    linkSync(file('boxes.csv'), file('hard.csv'));
    for (const result of ['boxes.csv', './boxes.csv', 'soft.csv', 'hard.csv']) {
      for (const inputs of [['boxes.csv'], ['other.csv', '--blue', `${folder}/boxes.csv`]]) {
        const [first, ...blue] = inputs;
        const given = [file(first), `${folder}/${result}`, ...blue];
        expect(await run('join', ...given), given.join(' ')).toMatchObject({
          code: 2,
          err: expect.stringContaining('which is an input; expected another file'),
        });
      }
    }
    expect(readFileSync(file('boxes.csv'), 'utf8')).toBe(rows);
  });

  test('reads the file of that name, though it looks like a pattern', () => {
    // What DuckDB makes of it is in examples/test/join.test.mjs.
    expect(quotedPath('a[1]*?{b}].csv')).toBe("'a[[]1][*][?]{b}].csv'");
    expect(quotedPath("it's.csv")).toBe("'it''s.csv'");
  });

  test('says where its result cannot be written, before the work', async () => {
    writeFileSync(file('few.csv'), 'minX,minY,maxX,maxY\n0,0,1,1\n');
    const { code, err } = await run('join', file('few.csv'), file('no/such/pairs.parquet'));
    expect(code).toBe(4);
    expect(err).toContain(`cannot write ${file('no/such/pairs.parquet')}: ENOENT`);
  });
});

describe('a recording of hours', { tags: 'long' }, () => {
  const frames = 300_000; // more arguments than fit the stack

  test('is put in a table', () => {
    const rows = Array.from({ length: frames }, (_, k) => [String(k), '1']);
    const text = table({ tableColumns: Infinity, colour: false } as Terminal, ['frame', 'boxes'], rows);
    expect(text).toContain('\n299999      1\n');
  });

  test.each([true, false])('is plotted (logarithmic: %s)', (logarithmic) => {
    const points = Array.from({ length: frames }, (_, x) => ({ x: x + 1, y: 1 + (x % 7) }));
    expect(linePlot([{ name: 'long', points }], { x: 'frame', y: 'ms', logarithmic })).toContain('<path');
  });

  test('is reported on', () => {
    const ms = { min: 1, mean: 1, median: 1, p95: 1, max: 1 };
    const auto = { technique: 'auto' as const, times: new Array<number>(frames).fill(1), ms };
    const page = reportOf('long', 2, {
      best: auto,
      auto,
      noise: 0,
      margin: 1,
      code: '',
      finalists: [auto],
      techniques: [],
      curves: [],
      frames: Array.from({ length: frames }, (_, index) => ({ index, boxes: index % 9, changed: 0, pairs: 3 })),
    });
    expect(page).toContain('8 boxes, 300,000 frames measured');
  });
});

describe.skipIf(!existsSync('/dev/full'))('a full disk', () => {
  test('is said, with the code of files, unless nobody can be told', async () => {
    const command = await bundle('src/cli/index.ts', 'build/cli/stranger.mjs');
    const full = openSync('/dev/full', 'w');
    for (const argv of [['--help'], ['--version', '--json']]) {
      const { status, stderr } = spawnSync(process.execPath, [command, ...argv], { stdio: ['ignore', full, 'pipe'] });
      expect(String(stderr)).toMatch(/^broadphase: cannot write to standard output: ENOSPC[^\n]*\n$/);
      expect(status).toBe(4);
    }
    expect(spawnSync(process.execPath, [command, 'info'], { stdio: ['ignore', 'ignore', full] }).status).toBe(4);
  });
});

test('colours are forced where nothing is a terminal, and not there else', async () => {
  const command = await bundle('src/cli/index.ts', 'build/cli/stranger.mjs');
  const { FORCE_COLOR: _, NO_COLOR: __, ...environment } = process.env;
  const isColoured = (more: object) =>
    String(spawnSync(process.execPath, [command, '--help'], { env: { ...environment, ...more } }).stdout).includes(
      '\x1b[',
    );
  expect([{ FORCE_COLOR: '1' }, { FORCE_COLOR: '0' }, { NO_COLOR: '1' }, {}].map(isColoured)).toEqual([
    true,
    false,
    false,
    false,
  ]);
});

test.each([
  ['update: out of memory: 9 more bytes are needed for 2 boxes and their pairs', 6],
  ['Array buffer allocation failed', 6],
  ['Invalid array length', 70],
])('%s: code %i, and a stack only for a fault', async (message, expected) => {
  // Stands in for a trace of gigabytes.
  const out = () => {
    throw new RangeError(message);
  };
  const { code, err } = await runCommand(['--help'], { out });
  expect(code).toBe(expected);
  if (expected === 6) expect(err).toBe(`broadphase: ${message}\n`);
  else expect(err).toContain('    at ');
});

describe('--frames', () => {
  test('frames have the numbers that they have in the recording', async () => {
    const trace = file('long.trace');
    await run('generate', 'crowd', trace, '--count', '30', '--frames', '8');
    const chosen = ['--frames', '3..5'];
    const whole = JSON.parse((await run('replay', trace, '--json')).out).frames;
    const { frames } = JSON.parse((await run('replay', trace, ...chosen, '--verify', '--json')).out);
    expect(frames.map(({ index }: { index: number }) => index)).toEqual([3, 4, 5]);
    for (const { index, pairs } of frames) expect(pairs).toBe(whole[index].pairs);
    expect((await run('replay', trace, ...chosen)).out).toMatch(/^3 +30 /m);

    const report = file('report.html');
    const { out } = await run('tune', trace, ...chosen, '--seconds', '0', '--report', report, '--json');
    expect(JSON.parse(out).frames.map(({ index }: { index: number }) => index)).toEqual([4, 5]); // the first is a start
    expect(readFileSync(report, 'utf8')).toContain('<title>frame 5\n');
  });

  test('so have those in messages', async () => {
    const writer = new TraceWriter(2);
    const header = writer.header();
    const box = Float32Array.of(0, 0, 1, 1);
    const frames = [box, box, box, Float64Array.of(0, 0, 1, 0.1)].map((boxes) => writer.frame(boxes));
    writeFileSync(file('doubles.trace'), Buffer.concat([header, ...frames, writer.end()]));
    const { code, err } = await run('convert', file('doubles.trace'), file('doubles.bin'), '--frames', '1..3');
    expect(code).toBe(2);
    expect(err).toContain('frame 3 cannot be written in the raw layout');
  });
});

describe('init', () => {
  const around = process.cwd();
  afterEach(() => process.chdir(around));

  test('takes the tarball of the project from any folder in it', async () => {
    mkdirSync(file('project/some/where'), { recursive: true });
    writeFileSync(file('project/broadphase.tgz'), '');
    const manifest = (spec: string) => JSON.stringify({ name: 'around', dependencies: { broadphase: spec } });
    writeFileSync(file('project/package.json'), manifest('file:broadphase.tgz'));
    process.chdir(file('project/some/where'));
    expect(JSON.parse((await run('init', 'game', '--json')).out).broadphase).toBe('file:../../../broadphase.tgz');
    // The nearest project that names the package decides.
    writeFileSync(file('project/some/package.json'), manifest('^0.1.0'));
    expect(JSON.parse((await run('init', 'other', '--json')).out).broadphase).toMatch(/^\^/);
  });

  test('prints lines that a shell understands', async () => {
    mkdirSync(file('shell'));
    process.chdir(file('shell'));
    for (const [name, word] of [
      ['game-1', 'game-1'],
      ['My Game', '"My Game"'],
      ['my$x', '"my\\$x"'],
    ]) {
      expect((await run('init', name)).out).toContain(`  cd ${word}\n`);
    }
  });
});

test('--salvage reads what is intact of a gzipped trace, and of a raw recording', async () => {
  await run('generate', 'crowd', file('intact.trace'), '--count', '300', '--frames', '20');
  for (const name of ['intact.trace.gz', 'intact.bin', 'intact.bin.gz']) {
    await run('convert', file('intact.trace'), file(name));
    const bytes = readFileSync(file(name));
    writeFileSync(file(`cut-${name}`), bytes.subarray(0, Math.floor(0.6 * bytes.length)));
    expect((await run('info', file(`cut-${name}`))).code).toBe(3);
    const { code, out, err } = await run('info', file(`cut-${name}`), '--salvage', '--json');
    const { frames } = JSON.parse(out);
    expect([code, frames > 5, frames < 20]).toEqual([0, true, true]);
    expect(err).toContain(`${frames} frames salvaged; trace: frame ${frames}, byte`);
  }
});

// What users of the command saw: results lost, recordings overwritten, stack traces, and texts of a parser.
import { execFileSync } from 'node:child_process';
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { readFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, posix, win32 } from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { fileSpec } from '../../src/cli/init.ts';
import { moreOfAll, verdictOf } from '../../src/cli/report.ts';
import { progressBar } from '../../src/cli/terminal.ts';
import { runCommand } from '../support/command.ts';

const folder = mkdtempSync(join(tmpdir(), 'broadphase-'));
const file = (name: string) => join(folder, name);
const small = file('small.trace');
const commands = ['info', 'replay', 'compare', 'tune', 'convert', 'generate'];

const run = (argv: string[], columns = 80, tableColumns = Infinity, colour = false) =>
  runCommand(argv, { columns, tableColumns, colour });

beforeAll(async () => {
  expect(await run(['generate', 'crowd', small, '--count', '40', '--frames', '3'])).toMatchObject({ code: 0 });
});
afterAll(() => rmSync(folder, { recursive: true }));

test('spaces around all names of --techniques are no part of a name', async () => {
  const { code, out } = await run(['compare', small, '--json', '--techniques', ' auto ,\tbrute-force ']);
  expect(code).toBe(0);
  const names: string[] = JSON.parse(out).techniques.map(({ technique }: { technique: string }) => technique);
  expect(names.sort()).toEqual(['auto', 'brute-force']); // they come by speed
});

test.each([
  ['--frames', ['info', small]],
  ['--cell-size', ['replay', small]],
  ['--seed', ['generate', 'crowd', file('none.trace')]],
  ['--memory', ['join', small, file('pairs.parquet')]],
])('an empty value of %s is called empty', async (option, argv) => {
  for (const value of ['', ' ']) {
    const { code, err } = await run([...argv, option, value]);
    expect(code).toBe(2);
    expect(err).toContain(`${option} is empty, expected`);
  }
});

describe('what would be lost is refused before the work', () => {
  test('a report that cannot be written', async () => {
    for (const path of [file('no/such/folder.html'), folder]) {
      const { code, out, err } = await run(['tune', small, '--report', path]);
      expect({ code, out }).toEqual({ code: 4, out: '' });
      expect(err).toContain(`cannot write ${path}`);
    }
  });

  test('a report or a copy that would overwrite the recording, by any name', async () => {
    const before = readFileSync(small);
    symlinkSync(small, file('link.trace'));
    for (const path of [small, file('link.trace'), join(folder, '.', 'small.trace')]) {
      for (const argv of [
        ['tune', small, '--report', path],
        ['convert', small, path, '--frames', '0..0'],
      ]) {
        expect(await run(argv)).toMatchObject({ code: 2, err: expect.stringContaining('which is the trace itself') });
      }
    }
    expect(readFileSync(small)).toEqual(before);
  });

  test('a scene that cannot be written', { timeout: 20_000 }, async () => {
    for (const path of [file('no/such/folder.trace'), folder]) {
      const much = ['--count', '100000', '--frames', '1000'];
      expect(await run(['generate', 'crowd', path, ...much])).toMatchObject({ code: 4, out: '' });
    }
  });

  test.skipIf(process.platform === 'win32')('but a pipe with a name gets all', { timeout: 20_000 }, async () => {
    const pipe = file('pipe');
    execFileSync('mkfifo', [pipe]);
    const scene = ['--count', '20000', '--frames', '5']; // enough for the reader to see if the pipe is closed before
    const plain = file('plain.trace');
    expect(await run(['generate', 'crowd', plain, ...scene])).toMatchObject({ code: 0 });
    for (const argv of [
      ['generate', 'crowd', pipe, ...scene],
      ['convert', plain, pipe],
    ]) {
      const read = readFile(pipe);
      expect(await run(argv)).toMatchObject({ code: 0 });
      expect(Buffer.compare(await read, readFileSync(plain))).toBe(0);
    }
  });

  test('checking whether a file can be written leaves nothing behind', async () => {
    mkdirSync(file('out'));
    expect(await run(['convert', small, file('out/a.bin')])).toMatchObject({ code: 0 });
    expect(await run(['tune', file('nowhere'), '--report', file('out/report.html')])).toMatchObject({ code: 4 });
    expect(existsSync(file('out/report.html'))).toBe(false);
  });
});

describe('what cannot be done is said at once', () => {
  test.each([
    [
      ['generate', 'crowd', file('x'), '--count', '16777217'],
      '--count is 16777217, expected an integer from 0 to 16777216',
    ],
    [['generate', 'crowd', file('x'), '--count', '99999999999'], '--count is 99999999999'],
    [['generate', 'crowd', file('x'), '--count', '10000000'], '600,000,000 boxes, expected at most 134,217,728 in all'],
    [['generate', 'crowd', file('x'), '--frames', '1e12'], '--frames is 1e12'],
    [['generate', 'crowd', file('x'), '--seed', '1e300'], '--seed is 1e300'],
    [['compare', small, '--passes', '1e9'], '--passes is 1e9, expected an integer from 1 to 1000'],
    [['tune', small, '--seconds', '1e9'], '--seconds is 1e9, expected a number from 0 to 3600'],
  ])('%j', async (argv, message) => {
    const begun = performance.now();
    const { code, out, err } = await run(argv as string[]);
    expect({ code, out }).toEqual({ code: 2, out: '' });
    expect(err).toContain(message);
    expect(performance.now() - begun).toBeLessThan(2000);
    expect(existsSync(file('x'))).toBe(false);
  });

  test('a trace without boxes is not tuned on', async () => {
    for (const [count, frames] of ['03', '30']) {
      const path = file(`none-${count}-${frames}`);
      await run(['generate', 'crowd', path, '--count', count, '--frames', frames]);
      const { code, out, err } = await run(['tune', path]);
      expect({ code, out }).toEqual({ code: 3, out: '' });
      expect(err).toContain(`${path}: no frame has boxes to tune on`);
    }
  });

  test('a broken trace is named', async () => {
    const { code, err } = await run(['info', 'package.json']);
    expect(code).toBe(3);
    expect(err).toMatch(/^broadphase: package\.json: /);
  });
});

describe('its own words', () => {
  test.each([
    [['info', small, '--colour'], "unknown option '--colour'"],
    [['info', small, '-x'], "unknown option '-x'"],
    [['info', small, '--frames'], "option '--frames <a..b>' argument missing"],
    [['info', small, '--frames', '--salvage'], "'--salvage' is invalid. Expected a value, not an option."],
    [['info', small, '--frames', '--json'], "option '--frames <a..b>' argument missing"],
    [['info', small, '--frame', '0..1'], '(Did you mean --frames?)'],
    [['tunes', small], "unknown command 'tunes' (Did you mean tune?)"],
    [['help', 'nosuch'], "unknown command 'nosuch'"],
    [['help', 'tunes'], "unknown command 'tunes' (Did you mean tune?)"],
    [['info', small, '--json=yes'], "unknown option '--json=yes'"],
    [['info', small, small, small], 'Expected 1 argument but got 3.'],
    [['convert', small], "missing required argument 'file'"],
    [['convert'], "missing required argument 'trace'"],
  ])('%j', async (argv, message) => {
    const { code, err } = await run(argv);
    expect(code).toBe(2);
    expect(err).toContain(message);
    expect(err).toMatch(/^broadphase: [^\n]*\nTry: broadphase [a-z ]*--help\n$/);
  });

  test.each([80, 60, 40])('tables fit %i columns, and say what they leave out', async (columns) => {
    for (const argv of [
      ['replay', small],
      ['compare', small, '--passes', '1'],
      ['info', small],
    ]) {
      const { out } = await run(argv, columns, columns);
      const table = out.split('\n\n').find((part) => part.includes('─'))!;
      for (const line of table.split('\n').slice(0, 3)) expect(line.length, line).toBeLessThanOrEqual(columns);
      if (argv[0] === 'replay')
        expect(out).toMatch(/not shown, as the terminal is too narrow: .*memory; --json has all/);
    }
    expect((await run(['replay', small], columns)).out).toContain('memory');
  });

  test('colours are for terminals that have them', async () => {
    const argv = ['compare', small, '--passes', '1'];
    expect((await run(argv)).out).not.toContain('\x1b');
    expect((await run(['--help'], 80, 80, true)).out).toContain('\x1b[1m');
    expect((await run(argv, 80, 80, true)).out).toContain('\x1b[32m');
  });

  test('one frame is one frame', async () => {
    const { out } = await run(['generate', 'crowd', file('one'), '--count', '1', '--frames', '1']);
    expect(out).toContain('1 frame of 1 box,');
    expect((await run(['info', file('one')])).out).toContain('2D, 1 frame,');
    expect((await run(['convert', file('one'), file('one.bin')])).out).toContain('1 frame,');
    expect((await run(['replay', file('one'), '--verify'])).out).toContain('the pairs of the frame are exact');
  });

  test('the version, and help by any of its names', async () => {
    const { version } = JSON.parse(readFileSync('package.json', 'utf8'));
    expect(await run(['--version'])).toEqual({ code: 0, out: `${version}\n`, err: '' });
    for (const argv of [
      ['-v', '--json'],
      ['--json', '--version'],
    ]) {
      expect(await run(argv)).toEqual({ code: 0, out: `{"version":"${version}"}\n`, err: '' });
    }
    const { out } = await run(['--help']);
    expect(await run(['-v'])).toEqual({ code: 0, out: `${version}\n`, err: '' });
    for (const argv of [['-h'], ['help']]) expect(await run(argv)).toEqual({ code: 0, out, err: '' });
    for (const name of commands) {
      const help = await run([name, '--help']);
      expect(await run([name, '-h'])).toEqual(help);
      expect(await run(['help', name])).toEqual(help);
      expect(help.code).toBe(0);
    }
  });

  test.each([80, 60, 132])('help fits %i columns', async (columns) => {
    for (const argv of [['--help'], ...commands.map((name) => [name, '--help'])]) {
      const { out } = await run(argv, columns);
      for (const line of out.split('\n')) expect(line.length, line).toBeLessThanOrEqual(columns);
    }
  });

  test.each([10, 24, 40, 80])('the progress bar fits %i columns', (columns) => {
    const drawn: string[] = [];
    const terminal = { out: () => {}, err: (text: string) => void drawn.push(text), interactive: true, columns };
    progressBar(terminal).show('hierarchical-grid', 1, 3);
    expect(drawn.join('').replace('\r\x1b[K', '').length).toBeLessThan(columns);
  });
});

describe('what tune recommends', () => {
  const summary = (mean: number) => ({ min: mean, median: mean, mean, p95: mean, max: mean });
  const ran = (technique: 'auto' | 'quadtree' | 'strip-sweep', mean: number) => ({
    technique,
    times: [mean],
    ms: summary(mean),
  });
  const auto = ran('auto', 0.5);

  test('says what is saved, and what it costs to load', () => {
    const best = ran('quadtree', 0.25);
    const text = verdictOf({ best, auto, finalists: [best, auto], margin: 2, noise: 0.01 });
    expect(text).toContain('0.2500 less than `auto`: 2.00 times as fast');
    expect(text).toContain(`'broadphase/all', ${moreOfAll} kB more to load`);
    const lean = ran('strip-sweep', 0.25);
    expect(verdictOf({ best: lean, auto, finalists: [lean, auto], margin: 2, noise: 0.01 })).not.toContain(
      'broadphase/all',
    );
  });

  test('says so where what is faster is not worth loading', () => {
    const first = ran('quadtree', 0.4935);
    const found = { best: auto, auto, finalists: [first, auto], margin: 1 };
    const text = verdictOf({ ...found, noise: 0.001 });
    expect(text).toContain('`auto` is fine: it takes 0.5000 ms a frame.');
    expect(text).toContain(`quadtree took 0.0065 ms less: not enough to justify 'broadphase/all'`);
    expect(verdictOf({ ...found, noise: 0.02 })).toContain(
      'quadtree took 0.0065 ms less, which is noise: two runs of `auto` differ by 2.0 %.',
    );
    expect(verdictOf({ ...found, finalists: [auto], noise: 0 })).toContain('Nothing is faster');
  });

  test('knows the size of what it asks to load', () => {
    const sizes: { name: string; limit: string }[] = JSON.parse(readFileSync('.size-limit.json', 'utf8'));
    const size = (entry: string) => Number.parseFloat(sizes.find(({ name }) => name === entry)!.limit);
    expect(Math.abs(size('broadphase/all') - size('broadphase') - moreOfAll)).toBeLessThan(0.9);
  });
});

describe('init in a folder with nothing but a new repository', () => {
  const made = (name: string) => {
    mkdirSync(file(`${name}/.git`), { recursive: true });
    writeFileSync(file(`${name}/.git/HEAD`), 'ref: refs/heads/main');
    return file(name);
  };

  test('makes the game there', async () => {
    const game = made('game');
    expect(await run(['init', game])).toMatchObject({ code: 0, err: '' });
    expect(readdirSync(game)).toEqual(expect.arrayContaining(['.git', '.gitignore', 'package.json', 'src']));
    expect(readFileSync(join(game, '.git/HEAD'), 'utf8')).toBe('ref: refs/heads/main');
    expect((await run(['init', game])).err).toContain('is not empty');
  });

  test('leaves the repository alone if a file cannot be written', async () => {
    let deep = made('parent');
    while (deep.length < 4080) deep = join(deep, 'd'.repeat(Math.min(200, 4081 - deep.length)));
    mkdirSync(join(deep, '.git'), { recursive: true });
    expect(await run(['init', deep])).toMatchObject({ code: 4, err: expect.stringContaining('cannot write') });
    expect(readdirSync(deep)).toEqual(['.git']);
  });
});

test('the game of init finds its tarball on every system, wherever it was made', () => {
  expect(fileSpec('/games/mine', '/games/broadphase.tgz', posix)).toBe('file:../broadphase.tgz');
  expect(fileSpec('C:\\games\\mine', 'C:\\games\\lib\\broadphase.tgz', win32)).toBe('file:../lib/broadphase.tgz');
  expect(fileSpec('C:\\games\\mine', 'D:\\broadphase.tgz', win32)).toBe('file:D:/broadphase.tgz');
});

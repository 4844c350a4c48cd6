// What somebody found who had only the package and the documents: in the command, and beside the library.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { BroadPhase, findPairs } from 'broadphase';
import { boxesInCells } from 'broadphase/draw';
import { afterAll, afterEach, beforeAll, describe, expect, test, vi } from 'vitest';
import { runCommand } from '../support/command.ts';

const folder = mkdtempSync(join(tmpdir(), 'broadphase-'));
const file = (name: string) => join(folder, name);
const run = (...argv: string[]) => runCommand(argv);

beforeAll(async () => {
  await run('generate', 'crowd', file('whole.trace'), '--count', '40', '--frames', '8');
});
afterAll(() => rmSync(folder, { recursive: true }));

test('names in a list may have spaces around them', async () => {
  const given = ['--techniques', 'quadtree, auto', '--passes', '1', '--json'];
  const { out } = await run('compare', file('whole.trace'), ...given);
  const names = JSON.parse(out).techniques.map(({ technique }: { technique: string }) => technique);
  expect(names.sort()).toEqual(['auto', 'quadtree']);
});

describe('a trace that is cut off', () => {
  test.each(['trace', 'trace.gz', 'bin', 'bin.gz'])('.%s: the message names the option that reads it', async (end) => {
    const name = file(`other.${end}`);
    await run('convert', file('whole.trace'), name);
    const bytes = readFileSync(name);
    writeFileSync(name, bytes.subarray(0, Math.floor(0.7 * bytes.length)));
    const { code, err } = await run('info', name);
    expect(code).toBe(3);
    const [, frames] = /; --salvage reads (\d) intact frames$/m.exec(err) ?? [];
    expect((await run('info', name, '--salvage')).err).toContain(`${frames} frames salvaged`);
  });

  test('no option is named where it would read nothing', async () => {
    writeFileSync(file('text'), 'not a trace at all');
    writeFileSync(file('stub.trace'), readFileSync(file('whole.trace')).subarray(0, 60));
    for (const name of ['text', 'stub.trace']) {
      const { code, err } = await run('info', file(name));
      expect(code).toBe(3);
      expect(err).not.toContain('salvage');
    }
  });
});

test('join does not write Parquet into a file that is named as another kind', async () => {
  writeFileSync(file('boxes.csv'), 'minX,minY,maxX,maxY\n0,0,1,1\n');
  for (const name of ['pairs.csv', 'pairs.CSV', 'pairs.tsv', 'pairs.csv.gz', 'pairs.json']) {
    const { code, err } = await run('join', file('boxes.csv'), file(name));
    expect(code).toBe(2);
    expect(err).toContain(`<pairs> is ${file(name)}, expected a name that ends in .parquet: it is a Parquet file`);
    expect(existsSync(file(name))).toBe(false);
  }
});

describe('init', () => {
  const around = process.cwd();
  afterEach(() => process.chdir(around));

  test('takes a clone that the project has installed', async () => {
    mkdirSync(file('project'));
    mkdirSync(file('clone'));
    const dependencies = { broadphase: 'file:../clone' };
    writeFileSync(file('project/package.json'), JSON.stringify({ name: 'around', dependencies }));
    process.chdir(file('project'));
    expect(JSON.parse((await run('init', 'game', '--json')).out).broadphase).toBe('file:../../clone');
  });
});

test('boxesInCells says what it expects', () => {
  for (const wrong of [undefined, 7, {}]) {
    expect(() => boxesInCells(wrong as never)).toThrow(/^boxesInCells: got .*, expected a BroadPhase$/);
  }
});

test('boxes as arrays of their own, as box-intersect takes them, are told from flat ones', () => {
  const nested = [[0, 0, 1, 1]] as never;
  const expected = 'length: got 1, expected a multiple of 4: a flat array of 2D boxes';
  expect(() => findPairs(nested)).toThrow(`findPairs: ${expected}`);
  expect(() => new BroadPhase().setAll(nested)).toThrow(`setAll: ${expected}`);
});

describe('the starter', () => {
  afterEach(() => vi.unstubAllGlobals());

  /** What its game draws half a second after the start, on a display of so many frames per second. */
  async function drawnAt(hertz: number): Promise<number[][]> {
    let drawn: number[][] = [];
    let next: FrameRequestCallback = () => {};
    const context = {
      clearRect: () => (drawn = []),
      fillRect: (...numbers: number[]) => drawn.push(numbers),
      fillText: () => {},
    };
    const canvas = { width: 400, height: 600, getContext: () => context, addEventListener: () => {} };
    vi.stubGlobal('document', { querySelector: () => canvas });
    vi.stubGlobal('addEventListener', () => {});
    vi.stubGlobal('requestAnimationFrame', (callback: FrameRequestCallback) => {
      next = callback;
    });
    vi.spyOn(Math, 'random').mockReturnValue(0.1);
    vi.resetModules();
    await import('../../starter/src/main.ts');
    for (let frame = 1; frame <= hertz / 2; frame++) next((1000 * frame) / hertz + 1);
    return drawn;
  }

  test('is as fast on every display', async () => {
    const drawn = await drawnAt(60);
    expect(drawn.length).toBeGreaterThan(5);
    expect(await drawnAt(120)).toEqual(drawn);
  });
});

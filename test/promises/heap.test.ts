// After warm-up a frame allocates nothing on the JavaScript heap, however the space is used. Measured over 1,000 frames,
// in a process of its own, where the garbage collector is at hand and nothing else runs, and again when that was not
// nothing: what the engine itself allocates until it has compiled everything is not the library's.
import { execFile } from 'node:child_process';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { BroadPhase } from 'broadphase';
import { beforeAll, describe, expect, test } from 'vitest';
import { bundle } from '../../scripts/bundle.mjs';

interface Result {
  use: string;
  technique: string;
  dimensions: number;
  /** Bytes per frame, collected later or not. */
  allocated: number;
}

/** Reading the heap's size costs a few hundred bytes itself, shared by 1,000 frames. */
const nothing = 8;

const uses = [
  'set, update, pairCount and stats',
  'boxes, update and pairs',
  'setAll and update',
  'delete, has, set and update',
  'queries with out',
];

/** Whose answers do not depend on the technique. */
const usesOfAuto = [
  'many queries in a call, with out',
  'pairs with another space',
  'events, rules and reading back',
  'set in three loops of a function',
];

let results: Result[] = [];
let library: string;

/** One call of TypedArray.prototype.set takes 32 bytes in V8 itself: setAll can do nothing about it. */
const leastOf = (use: string) => (use === 'setAll and update' ? 32 : 0);
const allocatesMore = ({ use, allocated }: Result) => allocated >= leastOf(use) + nothing;

beforeAll(async () => {
  library = await bundle('bench/library.ts', 'build/test/library.mjs');
  const script = fileURLToPath(new URL('./measure-heap.mjs', import.meta.url));
  const flags = ['--expose-gc', '--min-semi-space-size=64', '--max-semi-space-size=64'];
  // In some processes the engine never compiles a function for good. What the library allocates, it does in each.
  for (let tries = 0; tries < 3 && (tries === 0 || results.some(allocatesMore)); tries++) {
    const { stdout } = await promisify(execFile)(process.execPath, [...flags, script, library, String(nothing)]);
    const again: Result[] = JSON.parse(stdout);
    results = again.map((one, k) => (results[k] && results[k].allocated < one.allocated ? results[k] : one));
  }
});

test.each(usesOfAuto)('%s: allocates nothing per frame', { tags: 'long' }, (use) => {
  const here = results.filter((result) => result.use === use);
  expect(here.length).toBe(2);
  for (const { dimensions, allocated } of here) {
    expect(allocated, `bytes a frame in ${dimensions}D`).toBeLessThan(nothing);
  }
});

test('set is short enough for V8 to inline it three times, in newer versions too', { tags: 'long' }, async () => {
  const calls = 'const s = new BroadPhase(); for (let k = 0; k < 9; k++) s.set(k, 0, 0, 1, 1);';
  const code = `import { BroadPhase } from ${JSON.stringify(pathToFileURL(library).href)}; ${calls}`;
  const flags = ['--print-bytecode', '--print-bytecode-filter=set', '--input-type=module', '--eval', code];
  const { stdout } = await promisify(execFile)(process.execPath, flags);
  const [, bytes] = /Bytecode length: (\d+)\nParameter count 8\n/.exec(stdout)!;
  // Node 26 encodes it in 10 bytes more than Node 20 and 24, and inlines it three times up to 287.
  expect(Number(bytes)).toBeLessThanOrEqual(Number.parseInt(process.versions.node, 10) < 26 ? 277 : 287);
});

describe.each(uses)('%s', { tags: 'long' }, (use) => {
  test.each(BroadPhase.techniques)('allocates nothing per frame with %s', (technique) => {
    const here = results.filter((result) => result.use === use && result.technique === technique);
    expect(here.length).toBe(2);
    for (const { dimensions, allocated } of here) {
      expect(allocated, `bytes a frame in ${dimensions}D`).toBeLessThan(leastOf(use) + nothing);
    }
  });
});

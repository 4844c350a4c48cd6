// Faults that several strangers found in the library.
import { readFileSync } from 'node:fs';
import { BroadPhase, init } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

describe('the pairs of setSwept are all that sweep hits', () => {
  /** Whether both agree for a box from `lo` to `hi` that moves along x, and a wall with its face at `face`. */
  const misses = (space: BroadPhase, lo: number, hi: number, by: number, face: number): boolean => {
    space.clear();
    if (by > 0) space.set(7, face, -5, face + 9, 5);
    else space.set(7, face - 9, -5, face, 5);
    space.setSwept(1, lo, 0, hi, 1, by, 0).update();
    return space.pairCount === 0 && space.sweep(lo, 0, hi, 1, by, 0, { ignore: 1 }) !== undefined;
  };

  test('where the sum is rounded', () => {
    expect(misses(new BroadPhase(), -0.8, 0.2, 0.5, 0.7000000000000001)).toBe(false);
  });

  test('in a grid of tenths', () => {
    const space = new BroadPhase();
    const missed: number[][] = [];
    for (let lo = -20; lo <= 20; lo++) {
      for (let by = -30; by <= 30; by++) {
        for (const wide of [1, 7, 10]) {
          const end = by > 0 ? lo + wide + by : lo + by;
          const given = [lo / 10, lo / 10 + wide / 10, by / 10, end / 10] as const;
          if (misses(space, ...given)) missed.push([...given]);
        }
      }
    }
    expect(missed).toEqual([]);
  });

  test('with walls near the end of the path', () => {
    const space = new BroadPhase();
    const random = createRandom(7);
    const missed: number[][] = [];
    for (let n = 0; n < 5000; n++) {
      const size = 10 ** (n % 5);
      const lo = (random() - 0.5) * size;
      const hi = lo + random();
      const by = (random() - 0.5) * size;
      const face = (by > 0 ? hi : lo) + by;
      const near = face + (random() - 0.5) * 2 ** -50 * size;
      for (const at of [face, near]) if (misses(space, lo, hi, by, at)) missed.push([lo, hi, by, at]);
    }
    expect(missed).toEqual([]);
  });

  test('exact sums of numbers that fit float32 stay as they are, and so do infinite ones', () => {
    const space = new BroadPhase();
    expect(space.setSwept(1, -1000, 0, -999, 0.25, 1000, -3.5).get(1)).toEqual(
      new Float64Array([-1000, -3.5, 1, 0.25]),
    );
    expect(space.setSwept(1, -Infinity, 0.1, 0.1, Infinity, 0.3, -0.7).get(1)?.map(Math.fround)).toEqual(
      new Float64Array([-Infinity, -0.6, 0.4, Infinity]).map(Math.fround),
    );
    expect(space.setSwept(1, 0.1, 0.2, 0.3, 0.4, 0, 0).get(1)).toEqual(new Float64Array([0.1, 0.2, 0.3, 0.4]));
  });
});

test('a subclass with a set of its own changes no other call', () => {
  class BySize extends BroadPhase {
    override set(id: number, x: number, y: number, width: number, height: number): this {
      return super.set(id, x, y, x + width, y + height);
    }
  }
  const space = new BySize().setCentred(1, 10, 10, 2, 3).setSwept(2, 10, 10, 12, 13, 4, -5);
  expect(space.get(1)).toEqual(new Float64Array([8, 7, 12, 13]));
  expect(space.get(2)).toEqual(new Float64Array([10, 5, 16, 13]));
});

describe('what follows the options of a query is refused', () => {
  const flat = new BroadPhase().set(7, 0, 0, 1, 1).update();
  const solid = new BroadPhase({ dimensions: 3 }).set(7, 0, 0, 0, 1, 1, 1).update();
  const numbers = { isColliding: 2, collisionsOf: 1, queryPlanes: [[]], nearests: [[], 1], nearestsOfAll: [1] };
  const lengths = { queryPoint: 3, querySphere: 4, rayCast: 6, rayCastAll: 6, queryBox: 6, sweep: 9, nearest: 4 };
  const lists = ['queryBoxes', 'queryPoints', 'queryCircles', 'rayCasts', 'sweeps'].map((name) => [name, [[]]]);
  const calls = Object.entries({ ...numbers, ...lengths, ...Object.fromEntries(lists) }) as [string, unknown][];
  test.each(calls)('%s', (name, given) => {
    const args = typeof given === 'number' ? new Array(given).fill(1) : (given as unknown[]);
    for (const space of name in lengths ? [solid] : [flat, solid]) {
      const call = (...all: unknown[]) =>
        (space as never as Record<string, (...all: unknown[]) => unknown>)[name]!(...all);
      call(...args);
      const more = name === 'isColliding' ? [{ mask: 0 }] : [undefined, { mask: 0 }];
      const got = args.length + more.length;
      expect(() => call(...args, ...more)).toThrow(
        new TypeError(`${name}: got ${got} arguments, expected at most ${got - 1} in ${space.dimensions}D`),
      );
    }
  });
  test('queryCircle', () => {
    expect(() => (flat.queryCircle as (...all: unknown[]) => unknown).call(flat, 1, 1, 1, undefined, {})).toThrow(
      TypeError,
    );
  });
});

describe('an error says what is wrong', () => {
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  const any = space as never as Record<string, (...all: unknown[]) => unknown>;
  const detached = new Uint32Array(4);
  structuredClone(detached, { transfer: [detached.buffer] });
  test.each<[string, () => unknown]>([
    [
      'queryBox: ignore: got [object Uint32Array], expected an id, or an ordinary array of ids',
      () => any.queryBox!(0, 0, 1, 1, { ignore: new Uint32Array(1) }),
    ],
    [
      'nearest: ignore: got [object Set], expected an id, or an ordinary array of ids',
      () => any.nearest!(0, 0, 1, { ignore: new Set([0]) }),
    ],
    ['queryPoints: ignoreEach: got a detached array', () => space.queryPoints([0, 0], { ignoreEach: detached })],
    ['isColliding: b: the id is undefined', () => any.isColliding!(1)],
    ['isColliding: a: the id is "1"', () => any.isColliding!('1', 2)],
    [
      'rayCast: update or restore was called by accept',
      () => space.rayCast(0, 0, 1, 0, { accept: () => !space.restore(space.snapshot()) }),
    ],
    [
      'queryBox: update or restore was called by visit',
      () => space.queryBox(0, 0, 1, 1, { visit: () => space.update() }),
    ],
    ['nearest: update or restore was called by visit', () => space.nearest(0, 0, 1, { visit: () => space.update() })],
    [
      'queryBox: update or restore was called by visit',
      () => space.queryBox(0, 0, 1, 1, { visit: () => !space.update() }), // ends the search, too
    ],
    [
      'rayCast: update or restore was called by accept',
      () => space.rayCast(0, 0, 1, 0, { accept: () => Boolean(space.update()) }),
    ],
  ])('%s', (message, call) => {
    expect(call).toThrow(message);
  });

  test('no option is suggested that is only a little like the one given', () => {
    for (const name of ['constructor', 'toString', 'valueOf', '0']) {
      const text = `new BroadPhase: there is no option "${name}", there are dimensions`;
      expect(() => new BroadPhase(Object.fromEntries([[name, 1]]))).toThrow(text);
    }
    expect(() => space.queryBoxes([], { visit: 1 } as object)).toThrow('no option "visit", there are mask');
    expect(() => space.nearestsOfAll(1, { ignoreEach: [] } as object)).toThrow(
      'no option "ignoreEach", there are mask',
    );
    expect(() => space.queryBox(0, 0, 1, 1, { ignoreEach: 1 } as object)).toThrow('did you mean "ignore"? There are');
  });

  test('pairsWith says which space is stale', () => {
    const stale = new BroadPhase();
    for (let id = 0; id < 20_000; id++) stale.set(id, 2 * id, 0, 2 * id + 1, 1);
    stale.update().set(0, 5, 5, 6, 6);
    expect(() => space.pairsWith(stale)).toThrow('pairsWith: the other BroadPhase: boxes have changed');
    expect(() => stale.pairsWith(space)).toThrow('pairsWith: boxes have changed');
  });

  test('bytes of the kernel that are damaged or cut off are no fault of the host', () => {
    const bytes = readFileSync('build/kernel.wasm');
    for (const length of [4, 20, 100, bytes.length - 1]) {
      expect(() => init(bytes.subarray(0, length))).toThrow(
        /^init: got bytes that are damaged or cut off, expected that of/,
      );
    }
  });
});

// Faults that several strangers found in the library.
import { BroadPhase } from 'broadphase';
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

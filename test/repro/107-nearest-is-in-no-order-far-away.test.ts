// Squares of distances beyond 1e154 overflow: `nearest` gave boxes by their ids, circles had everything in them.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

const at = (x: number) => [x, 0, x, 0] as const;

test('nearest is in order beyond 1e154, and a limit holds', () => {
  const space = new BroadPhase()
    .set(0, ...at(3e300))
    .set(1, ...at(1e300))
    .set(2, ...at(2e300))
    .set(3, ...at(5))
    .update();
  expect(space.nearest(0, 0, 4)).toEqual([3, 1, 2, 0]);
  expect(space.nearest(0, 0, 4, { maxDistance: 2e300 })).toEqual([3, 1, 2]);
  const distances: number[] = [];
  space.nearest(0, 0, 4, { visit: (_, distance) => distances.push(distance) });
  expect(distances).toEqual([5, 1e300, 2e300, 3e300]);
  expect(space.nearest(0, 4e300, 1)).toEqual([3]);
  expect(space.nearest(-3e300, 0, 1, { maxDistance: 2.9e300 })).toEqual([]);
});

test('a circle has a radius beyond 1e154', () => {
  const space = new BroadPhase()
    .set(0, ...at(3e300))
    .set(1, ...at(1e300))
    .set(2, 4e300, 3e300, 5e300, 3e300)
    .update();
  expect(space.queryCircle(0, 0, 2e300)).toEqual([1]);
  expect(space.queryCircle(0, 0, 5e300).sort()).toEqual([0, 1, 2]);
  expect(space.queryCircle(0, 0, 4.999e300).sort()).toEqual([0, 1]);
});

test('in 3D too', () => {
  const space = new BroadPhase({ dimensions: 3 }).set(0, 0, 0, 2e200, 0, 0, 3e200).set(1, 0, 1e200, 0, 0, 1e200, 0);
  expect(space.update().nearest(0, 0, 0, Infinity)).toEqual([1, 0]);
  expect(space.querySphere(0, 0, 0, 1.5e200)).toEqual([1]);
});

test('all of them: Infinity as k', () => {
  const space = new BroadPhase()
    .set(0, ...at(3))
    .set(1, ...at(1))
    .update();
  expect(space.nearest(0, 0, Number.POSITIVE_INFINITY)).toEqual([1, 0]);
  expect(() => space.nearest(0, 0, -Infinity)).toThrow(
    'nearest: k: got -Infinity, expected an integer from 1 on, or Infinity',
  );
});

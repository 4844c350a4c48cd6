// What a reader of the sources found: very short and very long directions of rays missed boxes, and a sweep near the
// largest numbers stopped at once.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

const lengths = [1e-323, 1e-310, 1e-308, 1e-300, 1e-150, 1e-9, 1, 1e9, 1e150, 1e300, 1e308];

test('a ray hits the same box at the same distance, whatever the length of its direction', () => {
  const space = new BroadPhase().set(7, 10, -5, 20, 5).set(8, 1e10, -5, 2e10, 5).set(9, -8, -8, -4, -4).update();
  const solid = new BroadPhase({ dimensions: 3 }).set(7, 10, 10, 10, 20, 20, 20).update();
  for (const length of lengths) {
    expect(space.rayCastAll(0, 0, length, 0).map(({ id, distance }) => [id, distance])).toEqual([
      [7, 10],
      [8, 1e10],
    ]);
    expect(space.rayCast(0, 0, -length, -length)?.distance).toBeCloseTo(4 * Math.SQRT2, 9);
    expect([...space.rayCasts([0, 0, length, 0]).ids]).toEqual([7]);
    expect(solid.rayCast(15, 15, 15, length, length, length)?.distance).toBe(0);
    for (const world of [100, 1e290]) {
      const around = new BroadPhase({ wrap: [world, world] }).set(7, 10, -5, 20, 5).update();
      expect(around.rayCast(0, 0, length, 0)?.distance).toBe(10);
    }
  }
});

test('a sweep near the largest numbers stops where a smaller one does', () => {
  for (const size of [1, 1e-10, 1e-300]) {
    const space = new BroadPhase().set(1, 1e308 * size, -1, 1.1e308 * size, 1).update();
    expect(space.sweep(9e307 * size, -1, 9.5e307 * size, 1, 1e307 * size, 0)?.time).toBeCloseTo(0.5, 9);
  }
});

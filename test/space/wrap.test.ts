// Worlds that wrap around: every technique finds the pairs of the exact reference, whatever the boxes, however large and
// wherever they are given; filters and events hold there too. SEED=… runs a failure again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { testEach } from '../support/each-technique.ts';
import { expectKeys } from '../support/expect-pairs.ts';
import { keysOf, pairOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';
import { aBox, aWorld } from '../support/wrapped-boxes.ts';
import { wrappedPairs } from '../support/wrapped-reference.ts';

const numRuns = runs(20);

/** The reference takes its time: all techniques share what it has found. */
const remembered = new Map<string, Float64Array>();
function remember(key: string, find: () => Float64Array): Float64Array {
  const found = remembered.get(key) ?? find();
  remembered.set(key, found);
  return found;
}

describe(`in a world that wraps around (SEED=${seed})`, { tags: 'long' }, () => {
  testEach('%s in %d dimensions finds the pairs of the reference', (technique, dimensions) => {
    const boxes = fc.tuple(aWorld, fc.boolean()).chain(([world, middle]) => {
      const wrap = world.slice(0, dimensions);
      return fc.record({
        wrap: fc.constant(wrap),
        boxes: fc.array(aBox(wrap, middle), { maxLength: 40, size: 'max' }),
      });
    });
    const property = fc.property(boxes, ({ wrap, boxes }) => {
      const space = new BroadPhase({ technique, dimensions, wrap });
      expectKeys(space.setAll(boxes.flat()).update(), wrappedPairs(new Map(boxes.entries()), wrap));
      expectKeys(space.update(), wrappedPairs(new Map(boxes.entries()), wrap));
      const floats = Float32Array.from(boxes.flat());
      const rounded = boxes.map((_, k) => [...floats.subarray(2 * k * dimensions, 2 * (k + 1) * dimensions)]);
      space.boxes(boxes.length).set(floats);
      expectKeys(space.update(), wrappedPairs(new Map(rounded.entries()), wrap));
    });
    fc.assert(property, { seed, numRuns });
  });

  testEach('%s in %d dimensions: filters, events, ids that come and go', (technique, dimensions) => {
    const random = createRandom(7);
    const wrap = [60, 45, 50].slice(0, dimensions);
    const space = new BroadPhase({ technique, dimensions, wrap, events: true });
    const model = new Map<number, number[]>();
    const layers = new Map<number, number>();
    const resting = new Set<number>();
    let before: Float64Array = new Float64Array();
    for (let frame = 0; frame < 16; frame++) {
      for (let call = 0; call < 60; call++) {
        const id = Math.floor(random() * 150) * (call % 20 ? 1 : 999);
        if (random() < 0.2) {
          expect(space.delete(id)).toBe(model.delete(id));
          layers.delete(id);
          resting.delete(id);
          continue;
        }
        const from = wrap.map((size) => Math.floor(random() * 3 * size - size) / (call % 2 ? 1 : 10));
        const box = [
          ...from,
          ...from.map((min) => min + Math.floor(random() * (call % 30 ? 9 : 90)) / (call % 2 ? 1 : 10)),
        ];
        setBox(space, id, box);
        model.set(id, box);
        if (frame < 5) continue;
        const layer = 1 << Math.floor(random() * 3);
        space.setFilter(id, layer, 0b110).setStatic(id, call % 3 === 0);
        layers.set(id, layer);
        if (call % 3 === 0) resting.add(id);
        else resting.delete(id);
      }
      // A layer of 1 is in nobody's mask but of those that have no filter.
      const meets = (a: number, b: number) =>
        !(resting.has(a) && resting.has(b)) &&
        [
          [a, b],
          [b, a],
        ].every(([one, other]) => !layers.has(other) || (layers.get(one) ?? ~0) & 0b110);
      const expected = remember(`${dimensions} ${frame}`, () =>
        wrappedPairs(model, wrap).filter((key) => meets(...pairOf(key))),
      );
      expectKeys(space.update(), expected);
      space.validate();
      // Of ids that were deleted and set again, a pair that was there and is there may have ended and begun too.
      const [began, ended] = [new Set(keysOf(space.began)), new Set(keysOf(space.ended))];
      const [had, has] = [new Set(before), new Set(expected)];
      expect(expected.filter((key) => !had.has(key) && !began.has(key))).toHaveLength(0);
      expect(before.filter((key) => !has.has(key) && !ended.has(key))).toHaveLength(0);
      expect([...began].filter((key) => !has.has(key))).toEqual([]);
      expect([...ended].filter((key) => !had.has(key))).toEqual([]);
      before = expected;
    }
    expect(before.length).toBeGreaterThan(20);
  });

  test('keeps the numbers as they were given, and finds each pair once though it overlaps on both sides', () => {
    const space = new BroadPhase({ wrap: [100, 100] });
    space
      .set(1, -30, 40, 30, 60)
      .set(2, 20, 45, 80, 55)
      .set(3, 1e6 + 10, -60, 1e6 + 11, -50)
      .update();
    expect(Array.from(space.pairs)).toEqual([1, 2, 1, 3]);
    expect(Array.from(space.get(1)!)).toEqual([-30, 40, 30, 60]);
    expect(space.isColliding(1, 3)).toBe(true);
    expect(space.collisionsOf(1).sort()).toEqual([2, 3]);
  });

  test('is exact at the border, where sums would be rounded', () => {
    const space = new BroadPhase({ wrap: [1, 1] });
    const touching = (max: number, min: number) =>
      space.set(0, 0.9, 0, max, 1).set(1, min, 0, 0.5, 1).update().pairCount === 1;
    expect(touching(1.25, 0.25)).toBe(true);
    expect(touching(1.25, 0.25 + 2 ** -54)).toBe(false);
    expect(space.set(0, -0.1, 0, 1e-17, 1).set(1, 1e-17, 0, 0.5, 1).update().pairCount).toBe(1);
    expect(space.set(1, 2e-17, 0, 0.5, 1).update().pairCount).toBe(0);
  });

  test.each([
    [0, [200, 200]],
    [-50, [200, 200]],
    [-50, [200, 1e300]],
  ])('boxes from %d on in a world of %j are searched where they are', (from, wrap) => {
    const random = createRandom(3);
    const inside = () => from + 1 + random() * 95;
    const boxes = Array.from({ length: 500 }, () => [inside(), inside()]).flatMap(([x, y]) => [x!, y!, x! + 3, y! + 3]);
    const unbounded = new BroadPhase({ technique: 'strip-sweep' }).setAll(boxes).update();
    const space = new BroadPhase({ technique: 'strip-sweep', wrap }).setAll(boxes).update();
    expect(space.stats.tests).toBe(unbounded.stats.tests);
    expect(space.pairCount).toBe(unbounded.pairCount);
  });

  test('a ray goes once around, or up to its limit; too large a limit is refused by name', () => {
    const space = new BroadPhase({ wrap: [100, 50] }).set(1, 10, 10, 20, 20).update();
    expect(space.rayCast(50, 15, 1, 0)).toEqual({ id: 1, distance: 60, normal: [-1, 0] });
    expect(space.rayCast(50, 5, 1, 0.5)).toEqual(space.rayCast(-50, 105, 1, 0.5));
    expect(space.rayCast(50, 25, 1, 0)).toBeUndefined();
    expect(space.rayCastAll(15, 0, 0, 1, { maxDistance: 300 })).toEqual([{ id: 1, distance: 10, normal: [0, -1] }]);
    expect(space.sweep(50, 12, 52, 14, 70, 0)?.time).toBe(58 / 70);
    const most = 'expected at most 50000, since each world on the path costs a search';
    expect(() => space.rayCast(0, 0, 1, 0, { maxDistance: 1e9 })).toThrow(
      `rayCast: maxDistance: got 1000000000, ${most}`,
    );
    expect(() => space.rayCasts([0, 0, 1, 0], { maxDistance: 1e9 })).toThrow('rayCasts: maxDistance: got 1000000000');
    expect(() => space.sweep(0, 0, 1, 1, 0, -1e9)).toThrow(`sweep: the motion: got -1000000000, ${most}`);
    expect(() => space.sweeps([0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 1e9])).toThrow(
      'sweeps: query 1: the motion: got 1000000000',
    );
  });

  test.each([
    [[100]],
    [[100, 100, 100]],
    [[100, 0]],
    [[100, -1]],
    [[100, Number.NaN]],
    [[100, Infinity]],
    [['100', 100]],
    [100],
  ])('refuses the world %j', (wrap) => {
    expect(() => new BroadPhase({ wrap: wrap as number[] })).toThrow(/^wrap: got .*, expected 2 numbers above 0/);
  });
});

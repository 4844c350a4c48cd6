// Worlds that wrap around: every technique finds the pairs of the exact reference, whatever the boxes, however large and
// wherever they are given; filters and events hold there too. SEED=… runs a failure again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../src/scenes/random.ts';
import { expectKeys } from './expect-pairs.ts';
import { keysOf, pairOf } from './reference.ts';
import { runs, seed } from './runs.ts';
import { setBox } from './set-box.ts';
import { wrappedPairs } from './wrapped-reference.ts';

const numRuns = runs(20);

const combinations = BroadPhase.techniques.flatMap((technique) =>
  ([2, 3] as const).map((dimensions) => [technique, dimensions] as const),
);

const aWorld = fc.constantFrom([10, 7, 4], [0.1, 0.3, 0.7], [1000, 1e-3, 3], [1, 1e-320, 1e300]);

/** Where a box begins and how long it is, along an axis so long: whole steps and borders mostly, and what is hostile. */
function aSpan(world: number): fc.Arbitrary<[number, number]> {
  const place = fc.oneof(
    { weight: 8, arbitrary: fc.integer({ min: 0, max: 9 }).map((tenths) => (world * tenths) / 10) },
    { weight: 3, arbitrary: fc.integer({ min: -30, max: 30 }).map((tenths) => (world * tenths) / 10) },
    { weight: 2, arbitrary: fc.constantFrom(-0, 0, world, -world, world * (1 - 2 ** -53), -world * 2 ** -60, 5e-324) },
    { weight: 1, arbitrary: fc.double({ min: -2 * world, max: 3 * world, noNaN: true }) },
    {
      weight: 1,
      arbitrary: fc.constantFrom(1e9, -1e9, 1e-30, -1e300, Infinity, -Infinity).map((far) => far + world / 3),
    },
  );
  const length = fc.oneof(
    { weight: 6, arbitrary: fc.integer({ min: 0, max: 4 }).map((tenths) => (world * tenths) / 10) },
    {
      weight: 2,
      arbitrary: fc.constantFrom(world / 2, world * 0.9, world, world * (1 - 2 ** -53), 2.5 * world, Infinity),
    },
    { weight: 1, arbitrary: fc.double({ min: 0, max: 1.1 * world, noNaN: true }) },
  );
  return fc.tuple(place, length).map(([from, size]) => [from, Math.max(from, from + size) || from]);
}

const aBox = (wrap: readonly number[]): fc.Arbitrary<number[]> =>
  fc.tuple(...wrap.map(aSpan)).map((spans) => [...spans.map(([from]) => from), ...spans.map(([, to]) => to)]);

/** The reference takes its time: all techniques share what it has found. */
const remembered = new Map<string, Float64Array>();
function remember(key: string, find: () => Float64Array): Float64Array {
  const found = remembered.get(key) ?? find();
  remembered.set(key, found);
  return found;
}

describe(`in a world that wraps around (SEED=${seed})`, () => {
  test.each(combinations)('%s in %d dimensions finds the pairs of the reference', (technique, dimensions) => {
    const boxes = aWorld.chain((world) => {
      const wrap = world.slice(0, dimensions);
      return fc.record({ wrap: fc.constant(wrap), boxes: fc.array(aBox(wrap), { maxLength: 40, size: 'max' }) });
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

  test.each(combinations)('%s in %d dimensions: filters, events, ids that come and go', (technique, dimensions) => {
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

  test('queries say that they are not answered', () => {
    const space = new BroadPhase({ wrap: [100, 100] }).set(1, 0, 0, 1, 1).update();
    const message = /^\w+: this world wraps around, .*expected a space without wrap/;
    expect(() => space.queryBox(0, 0, 1, 1)).toThrow(message);
    expect(() => space.queryBox(0, 0, 1, 1, { visit: () => true })).toThrow(message);
    expect(() => space.queryCircle(0, 0, 1)).toThrow(message);
    expect(() => space.nearest(0, 0, 1)).toThrow(message);
    expect(() => space.nearest(0, 0, 1, { visit: () => true })).toThrow(message);
    expect(() => space.rayCast(0, 0, 1, 0)).toThrow(message);
    expect(() => space.rayCastAll(0, 0, 1, 0)).toThrow(message);
    expect(() => space.sweep(0, 0, 1, 1, 5, 5)).toThrow(message);
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

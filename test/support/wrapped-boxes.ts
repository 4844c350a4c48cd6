// Wrapped worlds with hostile boxes: at borders, several worlds away, as long as the world.
import fc from 'fast-check';

export const aWorld = fc.constantFrom([10, 7, 4], [0.1, 0.3, 0.7], [1000, 1e-3, 3], [1, 1e-320, 1e300]);

/**
 * The start and length of a box along an axis of this length: mostly whole steps and borders, and hostile values.
 * @param middle whether the origin is in the middle of the world
 */
function aSpan(world: number, middle: boolean): fc.Arbitrary<[number, number]> {
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
  return fc.tuple(place, length).map(([at, size]) => {
    const from = middle ? at - world / 2 : at;
    return [from, Math.max(from, from + size) || from];
  });
}

export const aBox = (wrap: readonly number[], middle = false): fc.Arbitrary<number[]> =>
  fc
    .tuple(...wrap.map((world) => aSpan(world, middle)))
    .map((spans) => [...spans.map(([from]) => from), ...spans.map(([, to]) => to)]);

// Random frames, for the property tests of the trace format: boxes that rest, move, come and go, with all kinds of
// numbers, and with or without ids.
import { TraceWriter } from 'broadphase/trace';
import fc from 'fast-check';

export interface GivenFrame {
  boxes: Float32Array | Float64Array;
  ids?: number[];
  /** Layer, mask and static, per box. */
  rules?: Uint32Array;
  groups?: Uint32Array;
  reaches?: Float64Array;
}

const place = fc.oneof(
  { weight: 8, arbitrary: fc.integer({ min: -50, max: 50 }) },
  { weight: 4, arbitrary: fc.double({ min: -100, max: 100, noNaN: true }) },
  { weight: 1, arbitrary: fc.constantFrom(-Infinity, Infinity, -0, 0, 5e-324, -1e-45, 1e300, -1e39) },
  { weight: 1, arbitrary: fc.double({ noNaN: true }) },
);

const aBox = (dimensions: number) =>
  fc.array(fc.tuple(place, place), { minLength: dimensions, maxLength: dimensions }).map((sides) => {
    const low = (a: number, b: number) => (a < b || Object.is(a, -0) ? a : b);
    return [...sides.map(([a, b]) => low(a, b)), ...sides.map(([a, b]) => (low(a, b) === a ? b : a))].map(
      (v, k, all) => (k >= dimensions && v < all[k - dimensions] ? all[k - dimensions] : v),
    );
  });

const bits = fc.constantFrom(0, 1, 2, 5, 0xffffffff);
const aReach = fc.constantFrom(0, 0, 1, 0.1, 1e300, 5e-324);
const aRule = fc.oneof(fc.constant([0xffffffff, 0xffffffff, 0]), fc.tuple(bits, bits, fc.integer({ min: 0, max: 1 })));

/** Consecutive frames: some boxes stay, the others are replaced; doubles and floats alternate. */
export const someFrames = (dimensions: 2 | 3): fc.Arbitrary<GivenFrame[]> =>
  fc
    .array(
      fc.record({
        boxes: fc.array(fc.tuple(aBox(dimensions), fc.boolean()), { maxLength: 12 }),
        ids: fc.option(
          fc.uniqueArray(fc.oneof(fc.nat(20), fc.constantFrom(70_000, 2 ** 24 - 1)), { minLength: 12, maxLength: 12 }),
        ),
        doubles: fc.boolean(),
        rules: fc.option(fc.array(aRule, { minLength: 12, maxLength: 12 })),
        groups: fc.option(fc.array(bits, { minLength: 12, maxLength: 12 })),
        reaches: fc.option(fc.array(aReach, { minLength: 12, maxLength: 12 })),
      }),
      { maxLength: 8 },
    )
    .map((frames) => {
      let was: number[][] = [];
      return frames.map(({ boxes, ids, doubles, rules, groups, reaches }) => {
        was = boxes.map(([box, stays], k) => (stays && was[k]) || box);
        const numbers = new (doubles ? Float64Array : Float32Array)(was.flat());
        return {
          boxes: numbers,
          ...(ids && { ids: ids.slice(0, was.length) }),
          ...(rules && { rules: Uint32Array.from(rules.slice(0, was.length).flat()) }),
          ...(groups && { groups: Uint32Array.from(groups.slice(0, was.length)) }),
          ...(reaches && { reaches: Float64Array.from(reaches.slice(0, was.length)) }),
        };
      });
    });

export function write(dimensions: 2 | 3, frames: readonly GivenFrame[]): Uint8Array {
  const writer = new TraceWriter(dimensions);
  return concat([
    writer.header(),
    ...frames.map(({ boxes, ids, rules, ...own }) => writer.frame(boxes, ids, rules, own)),
    writer.end(),
  ]);
}

export function concat(pieces: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  return new Uint8Array(pieces.flatMap((piece) => [...piece]));
}

/** The contents of a frame, for comparison: as bits, so that -0 is not 0. */
export function factsOf(
  dimensions: number,
  {
    boxes,
    ids,
    rules,
    groups,
    reaches,
  }: {
    boxes: Float32Array | Float64Array;
    ids?: unknown;
    rules?: Uint32Array | undefined;
    groups?: Uint32Array | undefined;
    reaches?: Float64Array | undefined;
  },
) {
  const count = boxes.length / (2 * dimensions);
  const named = ids ? [...(ids as ArrayLike<number> as number[])] : undefined;
  return {
    doubles: boxes instanceof Float64Array,
    numbers: [...new Uint8Array(boxes.slice().buffer)],
    rules: rules?.some((number, k) => number !== (k % 3 === 2 ? 0 : 0xffffffff)) ? [...rules] : undefined,
    groups: groups?.some((group) => group !== 0) ? [...groups] : undefined,
    reaches: reaches?.some((reach) => reach !== 0) ? [...reaches] : undefined,
    ids: named?.some((id, k) => id !== k) ? named : Array.from({ length: count }, (_, k) => k),
  };
}

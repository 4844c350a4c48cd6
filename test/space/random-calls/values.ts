// What random calls are given: ids, places, boxes, and what is none of these.
import fc from 'fast-check';
import { all } from './model.ts';

export const anId = fc.oneof(
  { weight: 12, arbitrary: fc.nat(25) },
  { weight: 1, arbitrary: fc.constantFrom(4095, 4096, 70_000, 2 ** 24 - 1) },
);
export const aPlace = fc.oneof(
  { weight: 10, arbitrary: fc.integer({ min: -8, max: 8 }) },
  { weight: 2, arbitrary: fc.integer({ min: -80, max: 80 }).map((tenths) => tenths / 10) },
  { weight: 1, arbitrary: fc.constantFrom(-0, 1e9, -1e9, 1e-30, 5e-324, 1e39, -1e300) },
);
export const anEnd = fc.oneof(
  { weight: 12, arbitrary: aPlace },
  { weight: 1, arbitrary: fc.constantFrom(-Infinity, Infinity) },
);
export const bits = fc.constantFrom(all, 1, 2, 3, 0, 0x80000000);
export const asked = fc.record(
  { mask: fc.constantFrom(all, 1, 2, 0x80000000), ignore: fc.nat(25) },
  { requiredKeys: [] },
);

/** No number, or none that a box or a place may have. */
export const noNumber = fc.constantFrom<unknown>(Number.NaN, undefined, null, '1', {}, [], true, 1n, Symbol('s'));
export const noId = fc.constantFrom<unknown>(
  -1,
  2 ** 24,
  0.5,
  Number.NaN,
  Infinity,
  '3',
  null,
  undefined,
  {},
  2n,
  true,
);
export const noBits = fc.constantFrom<unknown>(-1, 2 ** 32, 0.5, Number.NaN, '3', null, undefined, {}, 1n);
export const noBytes = fc.oneof(
  fc.constantFrom<unknown>(undefined, null, 5, 'snapshot', {}, [1, 2, 3]),
  fc.uint8Array({ maxLength: 200 }),
);

export const tuple = <T>(arbitrary: fc.Arbitrary<T>, length: number) =>
  fc.array(arbitrary, { minLength: length, maxLength: length });

export const show = (values: readonly unknown[]) => values.map((value) => fc.stringify(value)).join(', ');

/** Boxes, points and ways of a space of this many dimensions. */
export function shapes(dimensions: 2 | 3) {
  const boxFrom = (ends: number[][]) => [
    ...ends.map(([a, b]) => Math.min(a!, b!)),
    ...ends.map(([a, b]) => Math.max(a!, b!)),
  ];
  const aBox = tuple(tuple(anEnd, 2), dimensions).map(boxFrom);
  const aPoint = tuple(aPlace, dimensions);
  const aWay = tuple(
    fc.oneof(
      fc.constantFrom(0, 1, -1),
      fc.integer({ min: -40, max: 40 }).map((halves) => halves / 2),
    ),
    dimensions,
  );
  return { aBox, aPoint, aWay };
}

export const roundOf = (dimensions: 2 | 3) => (dimensions === 2 ? 'queryCircle' : 'querySphere');

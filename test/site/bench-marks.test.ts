// The marks of the benchmark's logarithmic axes: enough of them to read a bar by, whatever its range.
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { marks, ms } from '../../site/bench/charts.ts';

test('an axis has at least two marks, all within it, each with a label of its own', () => {
  const range = fc.tuple(fc.double({ min: -4, max: 3, noNaN: true }), fc.double({ min: 0.32, max: 6, noNaN: true }));
  fc.assert(
    fc.property(range, ([from, decades]) => {
      const [least, most] = [10 ** from, 10 ** (from + decades)];
      for (const found of [marks(least, most), marks(least, most, 2)]) {
        expect(found.length).toBeGreaterThanOrEqual(2);
        expect(found.every((at) => at >= least && at <= most)).toBe(true);
        expect(new Set(found.map(ms)).size).toBe(found.length);
      }
    }),
  );
});

test('a wide axis has powers of ten, a narrow one steps between', () => {
  expect(marks(0.5, 200)).toEqual([1, 10, 100]);
  expect(marks(12, 31)).toEqual([15, 20, 30]);
  expect(marks(0.4, 4.4, 2)).toEqual([1, 3]);
});

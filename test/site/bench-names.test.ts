// The names in the chart of growth: they never cover each other, the lines that pass, or the marks below.
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type Line, lineHeight, placeNames, roomFor, textWidth, thin } from '../../site/bench/names.ts';

const ends = [100, 200, 300];
const someLines: fc.Arbitrary<Line[]> = fc
  .array(
    fc.record({
      length: fc.integer({ min: 2, max: 3 }),
      heights: fc.array(fc.nat(300), { minLength: 3, maxLength: 3 }),
    }),
    { minLength: 1, maxLength: 24 },
  )
  .map((lines) =>
    lines.map(({ length, heights }, k) => ({
      name: `line ${k}`,
      points: heights.slice(0, length).map((y, at) => [ends[at], y] as const),
    })),
  );
const named = (lines: readonly Line[]) => new Set(lines.map(({ name }) => name));

test('names are a line of text apart, in the order of their lines', () => {
  fc.assert(
    fc.property(someLines, (lines) => {
      const places = placeNames(lines, named(lines), 300);
      expect(places).toHaveLength(lines.length);
      for (const a of places) {
        expect(a.y).toBeLessThanOrEqual(300 - lineHeight / 2 + 1e-9);
        for (const b of places) {
          if (a === b || a.x > b.x || a.x + textWidth(a.name) < b.x) continue;
          expect(Math.abs(a.y - b.y)).toBeGreaterThanOrEqual(lineHeight - 1e-9);
          if (a.end[0] === b.end[0] && a.end[1] < b.end[1]) expect(a.y).toBeLessThan(b.y);
        }
      }
    }),
  );
});

test('names stand above the lines that go on', () => {
  fc.assert(
    fc.property(someLines, (lines) => {
      for (const { name, x, y, end } of placeNames(lines, named(lines), 300)) {
        for (const { points } of lines) {
          if (points.length < 3 || end[0] > 200 || end[0] === points[2][0]) continue;
          const [[, from], [, to]] = [points[1], points[2]];
          for (const at of [x, x + textWidth(name)]) {
            const passes = from + ((to - from) * (Math.min(at, 300) - 200)) / 100;
            expect(y + lineHeight / 2).toBeLessThanOrEqual(passes + 1e-9);
          }
        }
      }
    }),
  );
});

test('a name alone stands at the height of its line, without a leader', () => {
  const line = { name: 'alone', points: [[0, 100] as const, [200, 40] as const] };
  expect(placeNames([line], new Set(['alone']), 300)).toEqual([
    { name: 'alone', x: 209, y: 40, end: [200, 40], leader: false },
  ]);
  expect(placeNames([line], new Set(), 300)).toEqual([]);
});

test('names of lines that end before the right border need less room', () => {
  const [short, long] = ['set', 'a name much longer than the other'];
  expect(roomFor([{ name: short, share: 1 }], 400)).toBeLessThan(roomFor([{ name: long, share: 1 }], 400));
  expect(roomFor([{ name: long, share: 0.25 }], 400)).toBe(0);
});

test('marks that would touch are left out, never the ends, and powers of ten last', () => {
  const values = [20, 50, 100, 200, 500, 1000, 2000, 10_000, 100_000];
  const marks = (width: number) =>
    values.map((value) => ({
      value,
      label: value.toLocaleString('en'),
      x: (width * Math.log(value / 20)) / Math.log(5000),
    }));
  expect(thin(marks(1100))).toEqual(values);
  expect(thin(marks(220))).toEqual([20, 100, 1000, 10_000, 100_000]);
  expect(thin(marks(60))).toEqual([20, 100_000]);
});

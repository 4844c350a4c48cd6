// Labels end up apart, near their points, and the same each time.
import { describe, expect, test } from 'vitest';
import { installed } from '../check.mjs';

describe.skipIf(!installed)('labels placed with D3', () => {
  test('do not overlap, and stay near their points', async () => {
    const { placeLabels, sizeOf, toSvg } = await import('./labels.mjs');
    const overlaps = (labels) => {
      let count = 0;
      for (const [k, a] of labels.entries()) {
        for (const b of labels.slice(k + 1)) {
          const [[widthA, heightA], [widthB, heightB]] = [sizeOf(a), sizeOf(b)];
          count += Number(2 * Math.abs(a.x - b.x) < widthA + widthB && 2 * Math.abs(a.y - b.y) < heightA + heightB);
        }
      }
      return count;
    };
    expect(overlaps(placeLabels(300, 0))).toBeGreaterThan(150);
    const labels = placeLabels(300);
    expect(overlaps(labels)).toBe(0);
    const distances = labels
      .map(({ x, y, pointX, pointY }) => Math.hypot(x - pointX, y - pointY))
      .sort((a, b) => a - b);
    expect(distances[150]).toBeLessThan(60);
    expect(toSvg(labels).match(/<text/g)).toHaveLength(300);
    expect(placeLabels(300)).toEqual(labels);
  });
});

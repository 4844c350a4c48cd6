// `setAll` made room before it looked at the numbers. If it then refused them, memory had grown, and the array of
// `boxes()` was detached, with what had been written to it.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';

const many = 300_000;

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  const width = 2 * dimensions;
  const kinds: [string, (numbers: Float64Array) => Float32Array | Float64Array | number[]][] = [
    ['floats', (numbers) => Float32Array.from(numbers)],
    ['doubles', (numbers) => numbers],
    ['an array', (numbers) => Array.from(numbers)],
  ];
  test.each(kinds)('%s that are refused change nothing', (_, from) => {
    const space = new BroadPhase({ dimensions });
    const written = space.boxes(2).fill(7);
    const numbers = new Float64Array(width * many);
    for (const [value, message] of [
      [Number.NaN, `setAll: minX of box ${many - 2} is NaN`],
      [1, `setAll: box ${many - 2} has minX 1 above maxX 0`],
    ] as const) {
      numbers[width * (many - 2)] = value;
      expect(() => space.setAll(from(numbers))).toThrow(new RegExp(`^${message}`));
      expect(written).toEqual(new Float32Array(2 * width).fill(7));
    }
    written.fill(9);
    expect(space.update().pairCount).toBe(1);
    expect(space.get(1)).toEqual(new Float64Array(width).fill(9));
  });

  test('a length or a count that is refused changes nothing', () => {
    const space = new BroadPhase({ dimensions });
    const written = space.boxes(2).fill(7);
    expect(() => space.setAll(new Float32Array(width * many + 1))).toThrow('setAll: length');
    expect(() => space.setAll(new Float32Array(width * many), many + 1)).toThrow('setAll: count');
    expect(written).toEqual(new Float32Array(2 * width).fill(7));
    expect(space.update().pairCount).toBe(1);
  });
});

// ro.math and ro.ov3.
import { math, ov3 } from 'broadphase/ro';
import { describe, expect, test } from 'vitest';

describe('ro.math', () => {
  test('toNearest gives the nearest multiple, on both sides of zero', () => {
    expect([23, 25, 24, -23, -25, 16].map((value) => math.toNearest(value, 16))).toEqual([16, 32, 32, -16, -32, 16]);
    expect(math.toNearest(0.3, 0.25)).toBe(0.25);
    expect(() => math.toNearest(1, 0)).toThrow('multiple is 0, expected a finite number above 0');
    expect(() => math.toNearest(1, Number.NaN)).toThrow('multiple is NaN');
  });

  test('toNearestAlong slides a point along a direction to the nearest line of the tiles', () => {
    expect(math.toNearestAlong({ x: 18, y: 24 }, { x: 1, y: 1 }, 16)).toEqual({ x: 16, y: 22 });
    expect(math.toNearestAlong({ x: 24, y: 17 }, { x: -2, y: 1 }, 16)).toEqual({ x: 26, y: 16 });
    expect(math.toNearestAlong({ x: 18, y: 24 }, { x: 0, y: 5 }, 16)).toEqual({ x: 18, y: 32 });
    expect(math.toNearestAlong({ x: 18, y: 17 }, { x: -1, y: 0 }, 16)).toEqual({ x: 16, y: 17 });
    expect(math.toNearestAlong({ x: 16, y: 5 }, { x: 1, y: 1 }, 16)).toEqual({ x: 16, y: 5 });
    expect(() => math.toNearestAlong({ x: 1, y: 2 }, { x: 0, y: 0 }, 16)).toThrow(/the direction is { x: 0, y: 0 }/);
  });

  test('angleTo gives the shortest turn from one direction to another', () => {
    expect(math.angleTo(1, 0, 0, 1)).toBeCloseTo(Math.PI / 2);
    expect(math.angleTo(0, 2, 3, 0)).toBeCloseTo(-Math.PI / 2);
    expect(math.angleTo(-1, -0.01, -1, 0.01)).toBeCloseTo(-0.02, 4);
    expect(math.angleTo(0, -1)).toBeCloseTo(-Math.PI / 2);
  });

  test('intersectLineLine gives the point that two lines share, also beyond the points they are given by', () => {
    expect(math.intersectLineLine(0, 0, 2, 2, 0, 2, 2, 0)).toEqual({ x: 1, y: 1 });
    expect(math.intersectLineLine(0, 0, 1, 0, 5, 1, 5, 2)).toEqual({ x: 5, y: 0 });
    expect(math.intersectLineLine(0, 0, 1, 1, 3, 0, 4, 1)).toBe(null);
    expect(math.intersectLineLine(0, 0, 1, 1, 2, 2, 3, 3)).toBe(null);
    const target = { x: 0, y: 0 };
    expect(math.intersectLineLine(0, 0, 2, 2, 0, 2, 2, 0, target)).toBe(target);
  });
});

describe('ro.ov3', () => {
  const a = () => ({ x: 3, y: 4 });
  const b = { x: 1, y: -2 };

  test.each<[string, (target?: { x: number; y: number }) => { x: number; y: number }, { x: number; y: number }]>([
    ['add', (target) => ov3.add(a(), b, target), { x: 4, y: 2 }],
    ['sub', (target) => ov3.sub(a(), b, target), { x: 2, y: 6 }],
    ['mult', (target) => ov3.mult(a(), b, target), { x: 3, y: -8 }],
    ['scale', (target) => ov3.scale(a(), 2, target), { x: 6, y: 8 }],
    ['normalize', (target) => ov3.normalize(a(), target), { x: 0.6, y: 0.8 }],
    ['negate', (target) => ov3.negate(a(), target), { x: -3, y: -4 }],
    ['rotateZ', (target) => ov3.rotateZ(a(), Math.PI / 2, target), { x: -4, y: 3 }],
    ['direction', (target) => ov3.direction(a(), { x: 6, y: 8 }, target), { x: 0.6, y: 0.8 }],
  ])('%s', (_, operation, { x, y }) => {
    const target = { x: 0, y: 0 };
    const results = [operation(), operation(target)];
    expect(results[1]).toBe(target);
    for (const result of results) {
      expect(result.x).toBeCloseTo(x);
      expect(result.y).toBeCloseTo(y);
    }
  });

  test('an operation without a target changes its first argument, and no other', () => {
    const [first, second] = [a(), { ...b }];
    expect(ov3.add(first, second)).toBe(first);
    expect([first, second]).toEqual([{ x: 4, y: 2 }, b]);
  });

  test('a vector may be argument and target at once', () => {
    const v = a();
    expect(ov3.direction({ x: 0, y: 0 }, v, v)).toEqual({ x: 0.6, y: 0.8 });
    expect(ov3.add(v, v, v)).toEqual({ x: 1.2, y: 1.6 });
  });

  test('what has no direction gets none', () => {
    expect(ov3.normalize({ x: 0, y: 0 })).toEqual({ x: 0, y: 0 });
    expect(ov3.direction(a(), a())).toEqual({ x: 0, y: 0 });
  });

  test('length, distance, dot and angleTo measure', () => {
    expect(ov3.length(a())).toBe(5);
    expect(ov3.distance(a(), { x: 0, y: 8 })).toBe(5);
    expect(ov3.dot(a(), b)).toBe(-5);
    expect(ov3.angleTo({ x: 2, y: 0 }, { x: 0, y: 3 })).toBeCloseTo(Math.PI / 2);
    expect(ov3.angleTo({ x: 0, y: 3 })).toBeCloseTo(Math.PI / 2);
  });

  test('intersect finds where two lines meet', () => {
    expect(ov3.intersect({ x: 0, y: 0 }, { x: 2, y: 2 }, { x: 0, y: 2 }, { x: 2, y: 0 })).toEqual({ x: 1, y: 1 });
  });

  test('asArray, fromArray and str change the form', () => {
    const array = [9, 9, 9];
    expect(ov3.asArray(a())).toEqual([3, 4]);
    expect(ov3.asArray(a(), array)).toBe(array);
    expect(array).toEqual([3, 4, 9]);
    const target = { x: 0, y: 0 };
    expect(ov3.fromArray([3, 4], target)).toBe(target);
    expect(ov3.fromArray(Float32Array.of(3, 4))).toEqual(a());
    expect(ov3.str(a())).toBe('{ x: 3, y: 4 }');
  });
});

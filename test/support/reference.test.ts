// The reference itself has to be right: the sweep is tested against the naive version, and both against cases by hand.
import { expect, test } from 'vitest';
import { createScene, sceneNames } from '../../src/scenes/index.ts';
import { expectKeys, firstDifference } from './expect-pairs.ts';
import { keysOf, naivePairs, referencePairs } from './reference.ts';

test.each(sceneNames)('the sweep finds what testing every pair finds in %s', (name) => {
  const scene = createScene(name, 400, { seed: 5 });
  const expected = naivePairs(scene.boxes, scene.dimensions);
  expect(firstDifference(referencePairs(scene.boxes, scene.dimensions), expected)).toBeUndefined();
});

test('boxes are closed, points and infinite boxes are boxes', () => {
  const boxes = [
    [0, 0, 1, 1],
    [1, 1, 2, 2],
    [1, 1, 1, 1],
    [-Infinity, 2, Infinity, Infinity],
    [2 + 1e-12, 0, 3, 1],
  ].flat();
  const expected = keysOf([0, 1, 0, 2, 1, 2, 1, 3]);
  expect(naivePairs(boxes, 2)).toEqual(expected);
  expect(referencePairs(boxes, 2)).toEqual(expected);
});

test('ids stand for the boxes they are given for', () => {
  const boxes = [0, 0, 1, 1, 5, 5, 6, 6, 1, 0, 2, 1];
  expect(referencePairs(boxes, 2, [2 ** 24 - 1, 4, 7])).toEqual(keysOf([7, 2 ** 24 - 1]));
});

test('a difference is described in words', () => {
  const keys = (...pairs: number[]) => keysOf(pairs);
  expect(firstDifference(keys(0, 1), keys(0, 1))).toBeUndefined();
  expect(firstDifference(keys(), keys(0, 1))).toMatch('[0, 1] is missing');
  expect(firstDifference(keys(0, 1, 0, 2), keys(0, 2))).toMatch('[0, 1] does not overlap');
  expect(firstDifference(keys(0, 1, 0, 1), keys(0, 1))).toMatch('[0, 1] is there twice');
});

test('the first three sets of pairs are all compared', () => {
  const space = (...pairs: number[]) => ({ pairs: Uint32Array.from(pairs), pairCount: pairs.length / 2 });
  const far = 2 ** 24 - 1;
  for (let before = 0; before < 3; before++) {
    const expected = keysOf([0, 1, 0, far, far - 1, far]);
    for (let k = 0; k < before; k++) expectKeys(space(far - 1, far, 0, 1, 0, far), expected);
    const compare = (...pairs: number[]) => expectKeys(space(...pairs), expected);
    expect(() => compare(0, 1, 0, far, 0, 1), `${before} before`).toThrow('[0, 1] is there twice');
    expect(() => compare(0, 1, 0, far)).toThrow(`[${far - 1}, ${far}] is missing`);
    expect(() => compare(0, 1, 0, 2, 0, far)).toThrow('[0, 2] does not overlap');
    expect(() => compare(0, 1, 0, far, far - 1, far, 0, 1)).toThrow('[0, 1] is there twice');
    expect(() => compare(1, 0, 0, far, far - 1, far)).toThrow('not a < b');
    compare(0, far, 0, 1, far - 1, far);
  }
});

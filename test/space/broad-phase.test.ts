// What a BroadPhase promises besides its pairs: it reads like a Map, its views stay, its figures hold together.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createScene } from '../../src/scenes/index.ts';
import { keysOf } from '../support/reference.ts';
import { setBox } from '../support/set-box.ts';

const pairsOf = (space: BroadPhase<2 | 3>) => Array.from(space.update().pairs);

describe('a BroadPhase reads like a Map', () => {
  test('of boxes by id', () => {
    const space = new BroadPhase();
    expect(space.size).toBe(0);
    expect(space.set(7, 0, 0, 10, 10)).toBe(space);
    space.set(9, 5, 5, 15, 15);
    expect(space.size).toBe(2);
    expect([space.has(7), space.has(8), space.has(9)]).toEqual([true, false, true]);
    expect(pairsOf(space)).toEqual([7, 9]);
    space.set(7, 20, 20, 30, 30);
    expect(space.size).toBe(2);
    expect(pairsOf(space)).toEqual([]);
    expect(space.delete(9)).toBe(true);
    expect(space.delete(9)).toBe(false);
    expect(space.size).toBe(1);
    space.clear();
    expect(space.size).toBe(0);
    expect(space.has(7)).toBe(false);
    expect(pairsOf(space)).toEqual([]);
  });

  test('that gives back exactly the numbers it was given', () => {
    const space = new BroadPhase({ dimensions: 3 });
    for (const box of [
      [0.1, 0.2, 0.3, 0.1, 0.7, 1e300],
      [-Infinity, -1, 5e-324, Infinity, -1, 1e-30],
      [1, 2, 3, 4, 5, 6],
    ]) {
      setBox(space, 5, box);
      expect(Array.from(space.get(5)!)).toEqual(box);
      space.update();
      expect(Array.from(space.get(5)!)).toEqual(box);
    }
    expect(space.get(4)).toBeUndefined();
  });

  test('and writes into an array it is given', () => {
    const space = new BroadPhase().set(3, 0.1, 0.2, 0.3, 0.4);
    const out = [0, 0, 0, 0];
    expect(space.get(3, out)).toBe(out);
    expect(out).toEqual([0.1, 0.2, 0.3, 0.4]);
    expect(space.get(4, out)).toBeUndefined();
  });
});

describe('setAll and boxes', () => {
  test('setAll replaces everything', () => {
    const space = new BroadPhase().set(50, 0, 0, 1, 1).set(0, 0, 0, 1, 1);
    expect(space.setAll([0, 0, 2, 2, 1, 1, 3, 3])).toBe(space);
    expect(space.size).toBe(2);
    expect(space.has(50)).toBe(false);
    expect(pairsOf(space)).toEqual([0, 1]);
    space.setAll([0, 0, 2, 2, 1, 1, 3, 3], 1);
    expect(space.size).toBe(1);
    expect(pairsOf(space)).toEqual([]);
    space.setAll([]);
    expect(space.size).toBe(0);
    expect(pairsOf(space)).toEqual([]);
  });

  test('doubles are taken as doubles if floats were staged before', () => {
    // The memory of the first setAll comes back for the second: as many numbers, at the same place, of another kind.
    const space = new BroadPhase({ dimensions: 3 });
    space.setAll(Float32Array.from({ length: 24 }, () => 1));
    space.set(1000, 0, 0, 0, 0, 0, 0);
    for (const id of [4, 5, 6]) space.set(id, 0, 0, 0, 1, 1, 1);
    const doubles = Array.from({ length: 24 }, (_, k) => 0.1 * k);
    space.setAll(doubles);
    expect(Array.from({ length: 4 }, (_, id) => [...space.get(id)!]).flat()).toEqual(doubles);
  });

  test('boxes is the memory that update reads', () => {
    const space = new BroadPhase();
    const view = space.boxes(2);
    expect(view).toBeInstanceOf(Float32Array);
    expect(view.length).toBe(8);
    view.set([0, 0, 2, 2, 1, 1, 3, 3]);
    expect(pairsOf(space)).toEqual([0, 1]);
    expect(space.size).toBe(2);
    expect(Array.from(space.get(1)!)).toEqual([1, 1, 3, 3]);
    view.set([5, 5, 6, 6], 4);
    expect(pairsOf(space)).toEqual([]);
    expect(Array.from(space.boxes(2))).toEqual([0, 0, 2, 2, 5, 5, 6, 6]);
  });

  test('boxes leaves only the ids it covers', () => {
    const space = new BroadPhase().setAll([0, 0, 2, 2, 1, 1, 3, 3, 1, 1, 3, 3]);
    space.boxes(2);
    expect(pairsOf(space)).toEqual([0, 1]);
    expect(space.size).toBe(2);
    expect(space.has(2)).toBe(false);
  });

  test('set and delete may follow boxes', () => {
    const space = new BroadPhase();
    space.boxes(3).set([0, 0, 2, 2, 1, 1, 3, 3, 8, 8, 9, 9]);
    space.set(2, 1, 1, 1, 1);
    expect(keysOf(pairsOf(space))).toEqual(keysOf([0, 1, 0, 2, 1, 2]));
    space.delete(1);
    expect(pairsOf(space)).toEqual([0, 2]);
    expect(space.size).toBe(2);
  });
});

describe.each(BroadPhase.techniques)('the views and figures of %s', (technique) => {
  test('pairs stay as they are until the next update', () => {
    const space = new BroadPhase({ technique }).setAll(createScene('dense2d', 500).boxes).update();
    const held = space.pairs;
    const copy = held.slice();
    expect(copy.length).toBeGreaterThan(500);
    for (let id = 0; id < 500; id++) space.set(id, id, id, id, id);
    space.delete(3);
    // Memory may grow at any change, which cuts the held view off, but not the pairs.
    if (held.length > 0) expect(held).toEqual(copy);
    expect(space.pairs).toEqual(copy);
    for (let id = 500; id < 30_000; id++) space.set(id, id, id, id, id);
    expect(space.pairs).toEqual(copy);
    space.setAll(createScene('uniform2d', 40_000).boxes);
    expect(space.pairs).toEqual(copy);
    expect(space.pairCount).toBe(copy.length / 2);
  });

  test('stats is one object that agrees with the pairs', () => {
    const space = new BroadPhase({ technique });
    const { stats } = space;
    for (const name of ['uniform2d', 'mixed2d'] as const) {
      space.setAll(createScene(name, 2000).boxes).update();
      expect(space.stats).toBe(stats);
      expect(stats.pairs).toBe(space.pairCount);
      expect(stats.tests).toBeGreaterThanOrEqual(stats.pairs);
      expect(stats.bytes).toBeGreaterThan(0);
      for (const value of [stats.tests, stats.candidates, stats.cells]) expect(Number.isFinite(value)).toBe(true);
    }
    space.clear();
    space.update();
    expect(space.stats.pairs).toBe(0);
  });

  test.each([2, 3] as const)('structure is whole boxes in %d dimensions', (dimensions) => {
    const space = new BroadPhase({ technique, dimensions });
    space.setAll(createScene(`uniform${dimensions}d`, 5000).boxes).update();
    const boxes = space.structure();
    expect(boxes).toBeInstanceOf(Float32Array);
    expect(boxes.length % (2 * dimensions)).toBe(0);
    for (let at = 0; at < boxes.length; at += 2 * dimensions) {
      for (let axis = at; axis < at + dimensions; axis++) {
        if (!(boxes[axis] <= boxes[axis + dimensions])) expect.fail(`cell at ${at} is no box`);
      }
    }
  });

  test.each([2, 3] as const)('one cell at most holds all others in %d dimensions', (dimensions) => {
    const space = new BroadPhase({ technique, dimensions });
    const width = 2 * dimensions;
    space.setAll(createScene(`uniform${dimensions}d`, 5000).boxes).update();
    const all = space.structure();
    const cells = Array.from({ length: all.length / width }, (_, k) => all.slice(width * k, width * (k + 1)));
    const bounds = Array.from({ length: width }, (_, k) =>
      Math[k < dimensions ? 'min' : 'max'](...cells.map((cell) => cell[k]!)),
    );
    expect(cells.filter((cell) => cell.every((x, k) => x === bounds[k])).length).toBeLessThanOrEqual(1);
  });

  test('validate finds nothing wrong, before and after anything', () => {
    const space = new BroadPhase({ technique });
    space.validate();
    for (const name of ['clustered2d', 'giants2d'] as const) {
      space.setAll(createScene(name, 1000).boxes);
      space.validate();
      space.update();
      space.validate();
    }
    space.delete(17);
    space.set(2 ** 24 - 1, 0, 0, 1, 1);
    space.validate();
    space.update();
    space.validate();
  });
});

test('many spaces live beside one another', () => {
  const scenes = (['uniform2d', 'mixed3d', 'dense2d'] as const).map((name) => createScene(name, 800));
  const spaces = scenes.map(({ dimensions }) => new BroadPhase({ dimensions }));
  const alone = scenes.map(({ boxes, dimensions }) => pairsOf(new BroadPhase({ dimensions }).setAll(boxes)));
  spaces.forEach((space, k) => {
    space.setAll(scenes[k].boxes);
  });
  expect(spaces.map(pairsOf)).toEqual(alone);
  spaces[1].dispose();
  expect([pairsOf(spaces[0]), pairsOf(spaces[2])]).toEqual([alone[0], alone[2]]);
});

test('the techniques are named in order, auto among them', () => {
  expect(BroadPhase.techniques).toEqual(expect.arrayContaining(['brute-force', 'spatial-grid', 'strip-sweep', 'auto']));
  expect(new Set(BroadPhase.techniques).size).toBe(BroadPhase.techniques.length);
  expect(new BroadPhase().technique).toBe('auto');
});

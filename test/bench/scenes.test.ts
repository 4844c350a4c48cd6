// The scenes are the ground every figure stands on: seeded, as dense as they say, and steady.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createScene, gameNames, type Scene, type SceneName, sceneNames } from '../../src/scenes/index.ts';
import { referencePairs } from '../support/reference.ts';

function measure({ boxes, dimensions, count, world }: Scene) {
  let volume = 0;
  for (let k = 0; k < count; k++) {
    let product = 1;
    for (let axis = 0; axis < dimensions; axis++) {
      const at = 2 * dimensions * k + axis;
      product *= boxes[at + dimensions] - boxes[at];
    }
    volume += product;
  }
  return volume / world ** dimensions;
}

const densities = {
  uniform: 0.25,
  sparse: 0.001,
  dense: 4,
  mixed: 0.5,
  giants: 0.5,
  clustered: 0.05,
  static: 0.25,
  skewed: 0.1,
};

describe.each(sceneNames)('%s', (name) => {
  const count = 20_000;

  test('is as dense as it says and lies inside its world', () => {
    const scene = createScene(name, count);
    const density = densities[name.slice(0, -2) as keyof typeof densities];
    expect(measure(scene) / density).toBeCloseTo(1, 2);
    expect(scene.boxes.find((value) => !(value >= 0 && value <= scene.world * (1 + 1e-6)))).toBeUndefined();
  });

  test('is the same for the same seed, and another for another', () => {
    const [a, b, c] = [3, 3, 4].map((seed) => createScene(name, 500, { seed }));
    for (let frame = 0; frame < 3; frame++) for (const scene of [a, b, c]) scene.step();
    expect(a.boxes).toEqual(b.boxes);
    expect(a.boxes).not.toEqual(c.boxes);
  });

  test('moves boxes by at most the speed, in place, without leaving or changing size', () => {
    const scene = createScene(name, 500, { speed: 3 });
    const { boxes, dimensions: d } = scene;
    const first = boxes.slice();
    for (let frame = 0; frame < 200; frame++) {
      const before = boxes.slice();
      scene.step();
      for (let at = 0; at < boxes.length; at += 2 * d) {
        let squares = 0;
        for (let axis = at; axis < at + d; axis++) {
          squares += (boxes[axis] - before[axis]) ** 2;
          if (boxes[axis] < 0) expect.fail(`box ${at / (2 * d)} left the world`);
          const size = first[axis + d] - first[axis];
          if (Math.abs(boxes[axis + d] - boxes[axis] - size) > 1e-3) expect.fail(`box ${at / (2 * d)} changed size`);
        }
        if (Math.sqrt(squares) > 3.001) expect.fail(`box ${at / (2 * d)} moved by ${Math.sqrt(squares)}`);
      }
    }
    expect(scene.boxes).toBe(boxes);
    expect(boxes).not.toEqual(first);
  });
});

test('one box in twenty moves in the static scenes', () => {
  const scene = createScene('static2d', 20_000);
  const before = scene.boxes.slice();
  scene.step();
  let moved = 0;
  for (let at = 0; at < before.length; at += 4) if (before[at] !== scene.boxes[at]) moved++;
  expect(moved / 20_000).toBeCloseTo(0.05, 2);
});

describe.each(gameNames)('%s', (name) => {
  test.each([1, 2, 100, 5000])('of %i boxes stays inside its world, each box of its size', (count) => {
    const { boxes, world, step } = bound(createScene(name, count));
    const first = boxes.slice();
    for (let frame = 0; frame < 300; frame++) step();
    for (let at = 0; at < boxes.length; at += 4) {
      for (const axis of [at, at + 1]) {
        const size = first[axis + 2] - first[axis];
        expect(size).toBeGreaterThan(0);
        if (Math.abs(boxes[axis + 2] - boxes[axis] - size) > 1e-2) expect.fail(`box ${at / 4} changed size`);
        if (!(boxes[axis] >= -1e-3 && boxes[axis + 2] <= world + 1e-3)) expect.fail(`box ${at / 4} left the world`);
      }
    }
  });

  test('is the same for the same seed, another for another, and its boxes meet all the time', () => {
    const [a, b, c] = [3, 3, 4].map((seed) => createScene(name, 5000, { seed }));
    for (let frame = 0; frame < 100; frame++) for (const scene of [a, b, c]) scene.step();
    expect(a.boxes).toEqual(b.boxes);
    expect(a.boxes).not.toEqual(c.boxes);
    expect(referencePairs(a.boxes, 2).length).toBeGreaterThan(20);
  });
});

const bound = (scene: Scene) => ({ boxes: scene.boxes, world: scene.world, step: () => scene.step() });

test('the resting boxes of a scene rest, and do not meet', () => {
  const scene = createScene('tile-map', 10_100);
  expect(scene.fixed).toBe(10_000);
  const tiles = scene.boxes.subarray(0, 4 * scene.fixed!);
  const before = tiles.slice();
  for (let frame = 0; frame < 50; frame++) scene.step();
  expect(tiles).toEqual(before);
  expect(referencePairs(tiles, 2).length).toBe(0);
});

test('a scene may be empty, and an unknown one or a bad count is an error that names it', () => {
  for (const name of [...sceneNames, ...gameNames]) expect(createScene(name, 0).boxes.length).toBe(0);
  expect(() => createScene('round2d' as SceneName, 1)).toThrow('"round2d"');
  expect(() => createScene('mixed2d', 1.5)).toThrow('1.5');
});

describe.each([...sceneNames, ...gameNames])('%s keeps its character', (name) => {
  const frames = 2000;

  test('frame 2,000 has as many pairs as frame 0', { tags: 'long' }, () => {
    const scene = createScene(name, 1000);
    const space = new BroadPhase({ dimensions: scene.dimensions });
    const pairs: number[] = [];
    for (let frame = 0; frame <= frames; frame++) {
      if (frame % 20 === 0) pairs.push(space.setAll(scene.boxes).update().pairCount);
      scene.step();
    }
    const meanOf = (some: number[]) => some.reduce((sum, count) => sum + count, 0) / some.length;
    const mean = meanOf(pairs);
    // Chance alone, among so few boxes. Squads and volleys meet all at once, so games vary more from frame to frame.
    const chance = 5 * Math.sqrt(mean) + 3;
    const [steady, single] = gameNames.some((game) => game === name) ? [0.3, 0.8] : [0.1, 0.15];
    for (const quarter of [0, 1, 2, 3].map((k) => meanOf(pairs.slice(25 * k, 25 * (k + 1))))) {
      expect(Math.abs(quarter - mean)).toBeLessThan(steady * mean + chance);
    }
    expect(Math.min(...pairs)).toBeGreaterThan((1 - single) * mean - chance);
    expect(Math.max(...pairs)).toBeLessThan((1 + single) * mean + chance);
  });

  test('in doubles it is the same scene, to what float32 holds', () => {
    const [single, double] = [createScene(name, 300), createScene(name, 300, { numbers: 'double' })];
    for (let frame = 0; frame < 5; frame++) for (const scene of [single, double]) scene.step();
    expect(double.boxes).toBeInstanceOf(Float64Array);
    expect(double.boxes.some((value) => Math.fround(value) !== value)).toBe(true);
    let furthest = 0;
    for (let k = 0; k < 300; k++) furthest = Math.max(furthest, Math.abs(double.boxes[k] - single.boxes[k]));
    expect(furthest).toBeLessThan(1e-2);
  });
});

// One suite for every technique, in 2D and 3D: the pairs are the reference's, whatever the boxes and however they came.
// The reference's answers are found once and shared by all techniques.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createScene, type SceneName, sceneNames } from '../../src/scenes/index.ts';
import { createRandom } from '../../src/scenes/random.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectKeys, expectPairs, expectSameWords } from '../support/expect-pairs.ts';
import { hostileCases } from '../support/hostile-boxes.ts';
import { readTrace, traceNames } from '../support/recordings.ts';
import { type Numbers, referencePairs } from '../support/reference.ts';
import { setBox } from '../support/set-box.ts';

interface Frame {
  readonly boxes: Float32Array;
  readonly expected: Float64Array;
}

const remembered = new Map<string, Frame[]>();

function remember(key: string, make: () => Frame[]): Frame[] {
  const known = remembered.get(key);
  if (known) return known;
  const made = make();
  remembered.set(key, made);
  return made;
}

const framesOfScene = (name: SceneName, count: number, frames: number): Frame[] =>
  remember(`${name} ${count}`, () => {
    const scene = createScene(name, count, { seed: 11 });
    return Array.from({ length: frames }, () => {
      scene.step();
      return { boxes: scene.boxes.slice(), expected: referencePairs(scene.boxes, scene.dimensions) };
    });
  });

const traces = traceNames.map((name) => ({ name, recording: readTrace(name) }));

const framesOfTrace = ({ name, recording }: (typeof traces)[number]): Frame[] =>
  remember(name, () =>
    [...new Set([0, 1, recording.frames - 1])].map((k) => ({
      boxes: recording.frame(k),
      expected: referencePairs(recording.frame(k), recording.dimensions),
    })),
  );

const hostile = { 2: hostileCases(2), 3: hostileCases(3) };

function setEach(space: BroadPhase<2 | 3>, boxes: Numbers, idOf: (index: number) => number = (index) => index): void {
  const stride = 2 * space.dimensions;
  for (let at = 0; at < boxes.length; at += stride) {
    setBox(
      space,
      idOf(at / stride),
      Array.from({ length: stride }, (_, k) => boxes[at + k]),
    );
  }
}

describeEach('%s in %d dimensions', (technique, dimensions) => {
  const create = () => new BroadPhase({ technique, dimensions });
  const scenesHere = sceneNames.filter((name) => name.endsWith(`${dimensions}d`));

  test.each(scenesHere)('finds the pairs of %s over several frames', (name) => {
    const space = create();
    for (const { boxes, expected } of framesOfScene(name, 1500, 4)) {
      space.boxes(1500).set(boxes);
      expectKeys(space.update(), expected);
    }
  });

  test.each(scenesHere.filter((name) => /uniform|mixed|clustered2d/.test(name)))(
    'finds the pairs of 20,000 boxes of %s',
    (name) => {
      const space = create();
      for (const { boxes, expected } of framesOfScene(name, 20_000, 1))
        expectKeys(space.setAll(boxes).update(), expected);
    },
  );

  test.each(
    traces.filter(({ recording }) => recording.dimensions === dimensions).map((trace) => [trace.name, trace] as const),
  )('finds the pairs of the recorded %s', (_, trace) => {
    const space = create();
    for (const { boxes, expected } of framesOfTrace(trace)) {
      space.boxes(trace.recording.count).set(boxes);
      expectKeys(space.update(), expected);
    }
  });

  test.each(hostile[dimensions].map((set) => [set.name, set] as const))('finds the pairs of %s', (_, set) => {
    const space = create();
    setEach(space, set.boxes());
    expectKeys(space.update(), set.expected());
    expectKeys(space.update(), set.expected());
    space.boxes(set.floats().length / (2 * dimensions)).set(set.floats());
    expectKeys(space.update(), set.expectedOfFloats());
  });

  test('goes from any of these sets to any other', () => {
    const space = create();
    for (const { boxes, expected } of [...hostile[dimensions], ...hostile[dimensions].toReversed()]) {
      expectKeys(space.setAll(boxes()).update(), expected());
    }
  });

  test('keeps doubles and floats apart when they take turns at the same ids', () => {
    const space = create();
    const touching = [0, 0.1, 0.1, 0.2].flatMap((value) => Array<number>(dimensions).fill(value));
    const missing = touching.with(dimensions, 0.1 - 1e-12);
    expectKeys(space.setAll(touching).update(), referencePairs(touching, dimensions));
    expect(space.pairCount).toBe(1);
    setBox(space, 0, missing.slice(0, 2 * dimensions)).update();
    expect(space.pairCount).toBe(0);
    const floats = Float32Array.from(missing);
    space.boxes(2).set(floats);
    expectKeys(space.update(), referencePairs(floats, dimensions));
    setBox(space, 0, touching.slice(0, 2 * dimensions));
    setBox(space, 1, touching.slice(2 * dimensions)).update();
    expect(space.pairCount).toBe(1);
  });

  test('takes ids with gaps, up to 2^24 - 1', () => {
    const { boxes } = framesOfScene(`uniform${dimensions}d`, 1500, 4)[0];
    const some = boxes.subarray(0, 300 * 2 * dimensions);
    const ids = Array.from({ length: 300 }, (_, k) => (k % 3 ? 2 ** 24 - 1 - k * 41 : k * k));
    const space = create();
    setEach(space, some, (index) => ids[index]);
    expect(space.size).toBe(300);
    expectPairs(space, some, dimensions, ids);
    expect(space.pairCount).toBeGreaterThan(0);
  });

  test('follows boxes that come, move and go in any order', () => {
    const random = createRandom(99);
    const model = new Map<number, number[]>();
    const space = create();
    for (let call = 1; call <= 3000; call++) {
      const id = Math.floor(random() * 400) * (random() < 0.1 ? 1000 : 1);
      if (random() < 0.3) {
        expect(space.delete(id)).toBe(model.delete(id));
      } else {
        const min = Array.from({ length: dimensions }, () => Math.floor(random() * 60));
        const box = [...min, ...min.map((value) => value + Math.floor(random() * 12))];
        setBox(space, id, box);
        model.set(id, box);
      }
      if (call % 150 === 0) expectPairs(space, [...model.values()].flat(), dimensions, [...model.keys()]);
    }
    expect(space.size).toBe(model.size);
    for (const id of [...model.keys()]) space.delete(id);
    expectPairs(space, [], dimensions);
    expect(space.size).toBe(0);
    setEach(space, [...model.values()].flat());
    expectPairs(space, [...model.values()].flat(), dimensions);
    space.clear();
    expectPairs(space, [], dimensions);
  });

  test('gives the pairs in an order that depends on the calls alone', () => {
    const frames = framesOfScene(`mixed${dimensions}d`, 1500, 4);
    const run = () => {
      const space = create();
      return frames.map(({ boxes }, k) => {
        if (k % 2) space.setAll(boxes);
        else setEach(space, boxes);
        space.delete(k);
        return space.update().pairs.slice();
      });
    };
    const again = run();
    run().forEach((pairs, k) => {
      expectSameWords(pairs, again[k], `frame ${k}`);
    });
  });

  test('gives the same pairs after a switch from any technique and back', () => {
    const frames = framesOfScene(`clustered${dimensions}d`, 1500, 4);
    const space = create();
    for (const other of BroadPhase.techniques) {
      for (const [k, name] of [other, technique].entries()) {
        space.technique = name;
        expect(space.technique).toBe(name);
        expectKeys(space.setAll(frames[k].boxes).update(), frames[k].expected);
        expectKeys(space.update(), frames[k].expected);
      }
    }
  });

  test('gives the same pairs with any cell size', () => {
    const { boxes, expected } = framesOfScene(`uniform${dimensions}d`, 1500, 4)[1];
    const perAxis = Array.from({ length: dimensions }, (_, axis) => 5 + 20 * axis);
    for (const cellSize of [1, 10, 1e-9, 1e9, perAxis]) {
      expectKeys(new BroadPhase({ technique, dimensions, cellSize }).setAll(boxes).update(), expected);
    }
  });
});

// How boxes come is the business of no technique.
describe.each([2, 3] as const)('in %d dimensions, given at once', (dimensions) => {
  test.each(hostile[dimensions].map((set) => [set.name, set] as const))('%s', (_, set) => {
    const space = new BroadPhase({ dimensions });
    expectKeys(space.setAll(set.boxes()).update(), set.expected());
    expectKeys(space.setAll(set.floats()).update(), set.expectedOfFloats());
    expectKeys(space.setAll(Float64Array.from(set.boxes())).update(), set.expected());
  });
});

// What changes beside the boxes costs by its number: rules, groups and reaches of a few boxes, or a snapshot, in each
// frame of a world that moves little; or boxes that cross the border of a wrapped one. What is retained survives that, and
// the pairs are those of a full rebuild.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { expectSamePairs } from '../support/expect-pairs.ts';
import { setBox } from '../support/set-box.ts';

const count = 3000;
const some = 10;
const [started, frames] = [40, 60];

/** Changes a few boxes of a frame, other ones in each. `before`: those of the frame before. */
type Change = (space: BroadPhase<2 | 3>, now: readonly number[], before: readonly number[]) => void;
const changes: Record<string, Change> = {
  'that are off': (space, now, before) => {
    for (const id of before) space.setEnabled(id, true);
    for (const id of now) space.setEnabled(id, false);
  },
  'that meet nobody': (space, now, before) => {
    for (const id of before) space.setFilter(id, 1, 1);
    for (const id of now) space.setFilter(id, 0, 0);
  },
  'of another layer': (space, now, before) => {
    for (const id of before) space.setFilter(id, 1, 1);
    for (const id of now) space.setFilter(id, 2, 2);
  },
  'of filters of their own': (space, now) => {
    for (const id of now) space.setFilter(id, 1 + (id % 1000), 0xffffffff);
  },
  'that are static': (space, now, before) => {
    for (const id of before) space.setStatic(id, false);
    for (const id of now) space.setStatic(id);
  },
  'of a group': (space, now, before) => {
    for (const id of before) space.setGroup(id, 0);
    for (const id of now) space.setGroup(id, 1);
  },
  'that reach': (space, now, before) => {
    for (const id of before) space.setReach(id, 0);
    for (const id of now) space.setReach(id, 0.2);
  },
  'with a snapshot in each frame': (space) => {
    space.snapshot();
  },
};

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  const random = createRandom(5);
  const side = 1.5 * count ** (1 / dimensions);
  const start = Array.from({ length: count * dimensions }, () => random() * side);

  test.each(Object.keys(changes))('a few boxes %s leave the candidates as they are', (name) => {
    const kept = new BroadPhase({ dimensions });
    const rebuilt = new BroadPhase({ dimensions, technique: 'strip-sweep' });
    const boxes = new Float32Array(2 * dimensions * count);
    let before: number[] = [];
    let retained = 0;
    for (let frame = 0; frame < started + frames; frame++) {
      for (let k = 0; k < start.length; k++) {
        const at = k + Math.floor(k / dimensions) * dimensions;
        boxes[at] = start[k]! + 0.02 * random();
        boxes[at + dimensions] = boxes[at]! + 1;
      }
      const now = Array.from({ length: some }, (_, k) => (frame * 7 + k * 271) % count);
      for (const space of [kept, rebuilt]) {
        space.setAll(boxes);
        changes[name]!(space, now, before);
        space.update();
      }
      before = now;
      if (frame < started) continue;
      retained += Number(kept.stats.reason.includes('are retained'));
      if (frame % 10 === 0) expectSamePairs(kept.pairs, rebuilt.pairs, `frame ${frame}`);
    }
    expect(retained, `updates of ${frames} in which candidates are retained`).toBeGreaterThan(0.9 * frames);
  });
});

describe.each([2, 3] as const)('in a wrapped world of %d dimensions', (dimensions) => {
  test.each(['float32', 'doubles'])('boxes that cross the border in %s leave the candidates as they are', (kind) => {
    const random = createRandom(6);
    const side = 1.5 * count ** (1 / dimensions);
    const wrap = dimensions === 2 ? ([side, side] as const) : ([side, side, side] as const);
    const kept = new BroadPhase({ dimensions, wrap });
    const rebuilt = new BroadPhase({ dimensions, wrap, technique: 'strip-sweep' });
    const places = Array.from({ length: count * dimensions }, () => random() * side);
    const speeds = places.map(() => (random() - 0.5) * 0.04);
    let retained = 0;
    for (let frame = 0; frame < started + frames; frame++) {
      for (let k = 0; k < places.length; k++) places[k]! += speeds[k]!;
      for (const space of [kept, rebuilt]) {
        for (let id = 0; id < count; id++) {
          const lower = places.slice(id * dimensions, (id + 1) * dimensions);
          const box = [...lower, ...lower.map((at) => at + 1)];
          setBox(space, id, kind === 'float32' ? box.map(Math.fround) : box);
        }
        space.update();
      }
      if (frame < started) continue;
      retained += Number(kept.stats.reason.includes('are retained'));
      if (frame % 10 === 0) expectSamePairs(kept.pairs, rebuilt.pairs, `frame ${frame}`);
    }
    expect(retained, `updates of ${frames} in which candidates are retained`).toBeGreaterThan(0.9 * frames);
  });
});

test('a world at rest has its pairs in the order of a restored one after the first snapshot', () => {
  const random = createRandom(7);
  const boxes = new Float32Array(4 * 500);
  for (let at = 0; at < boxes.length; at += 4) {
    const [x, y] = [random() * 30, random() * 30];
    boxes.set([x, y, x + 1, y + 1], at);
  }
  const space = new BroadPhase();
  for (let frame = 0; frame < 60; frame++) space.setAll(boxes).update();
  expect([space.stats.reason, space.stats.tests]).toEqual([expect.stringContaining('are retained'), 0]);
  const restored = new BroadPhase().restore(space.snapshot());
  expect(Array.from(space.setAll(boxes).update().pairs)).toEqual(Array.from(restored.pairs));
  expect(Array.from(space.setAll(boxes).update().pairs)).toEqual(Array.from(restored.pairs));
});

test('of boxes that are all alike and at rest, the pairs are of those that are on', () => {
  const random = createRandom(8);
  const spaces = (['auto', 'brute-force'] as const).map((technique) => new BroadPhase({ technique }));
  let off = [3, 4, 5];
  for (const space of spaces) {
    for (let id = 0; id < 40; id++) space.set(id, 0, 0, 1, 1);
    for (let id = 51; id < 2000; id++) space.set(id, id, 9, id + 1.5, 10);
    for (const id of off) space.setEnabled(id, false);
  }
  let retained = 0;
  for (let frame = 0; frame < 300; frame++) {
    const [on, ...others] = off as [number, number, number];
    if (frame % 3 === 2) off = [...others, (on + 1 + Math.floor(random() * 30)) % 40];
    for (const space of spaces) {
      space.setEnabled(on, !off.includes(on));
      for (const id of off) space.setEnabled(id, false);
      space.set(50, frame, 9, frame + 0.5, 10).update();
    }
    retained += Number(spaces[0]!.stats.reason.includes('are retained'));
    expectSamePairs(spaces[0]!.pairs, spaces[1]!.pairs, `frame ${frame}`);
  }
  expect(retained, 'updates in which candidates are retained').toBeGreaterThan(100);
});

test('boxes that stay where they are, and get other ids, are reported by these', () => {
  const spaces = (['auto', 'brute-force'] as const).map((technique) => new BroadPhase({ technique }));
  let retained = 0;
  for (let frame = 0; frame < 100; frame++) {
    const ids = (k: number) => (frame < 20 || frame % 3 === 0 ? k : 3 * k + (frame % 7));
    for (const space of spaces) {
      if (frame >= 20) space.clear();
      for (let k = 0; k < 500; k++) space.set(ids(k), k, 0, k + 1.5, 1);
      space.set(ids(500), frame, 0.5, frame + 0.5, 1).update();
    }
    retained += Number(spaces[0]!.stats.reason.includes('are retained'));
    expectSamePairs(spaces[0]!.pairs, spaces[1]!.pairs, `frame ${frame}`);
  }
  expect(retained, 'updates in which candidates are retained').toBeGreaterThan(40);
});

test('pairs at rest stay, under ids of their own, beside a box at infinity where touching does not count', () => {
  const options = { touching: false } as const;
  const spaces = (['auto', 'brute-force'] as const).map((technique) => new BroadPhase({ ...options, technique }));
  for (const space of spaces) {
    for (let k = 0; k < 500; k++) space.set(7 * k + 3, k, 0, k + 1.5, 1);
    space.set(1, Infinity, 0, Infinity, 1).set(2, 600, 0, Infinity, 1);
  }
  let retained = 0;
  for (let frame = 0; frame < 60; frame++) {
    for (const space of spaces) space.set(0, frame, 0.5, frame + 0.5, 1).update();
    retained += Number(spaces[0]!.stats.reason.includes('are retained'));
    expectSamePairs(spaces[0]!.pairs, spaces[1]!.pairs, `frame ${frame}`);
  }
  expect(retained, 'updates in which candidates are retained').toBeGreaterThan(40);
});

test.each([4, 80, 1200])('of %i filters, two boxes at rest exchange theirs, and a third gets a new one', (filters) => {
  const spaces = (['auto', 'brute-force'] as const).map((technique) => new BroadPhase({ technique }));
  const masks = [0b010111, 0b0011, 0b101101, 0b0100] as const; // no exclusion bits can say who meets whom
  const own = [0b0001, 0b0100] as const; // of boxes 0 and 1, the only ones of their layers
  for (const space of spaces) {
    for (let id = 0; id < 1200; id++) {
      const unused = (id % filters) << 8;
      space.set(id, id, 0, id + 2.5, 1).setFilter(id, 1 << (id % 4), masks[id % 4]! | unused);
    }
  }
  let retained = 0;
  for (let frame = 0; frame < 100; frame++) {
    const swapped = Math.floor(frame / 10) % 2;
    for (const space of spaces) {
      for (const id of [0, 1]) space.setFilter(id, 16 << (id ^ swapped), own[id ^ swapped]!);
      if (frame % 10 === 0) space.setFilter(102, 4, masks[2] | (1 << (20 + frame / 10)));
      space.set(1200, frame, 0.5, frame + 0.5, 1).update();
    }
    retained += Number(spaces[0]!.stats.reason.includes('are retained'));
    expectSamePairs(spaces[0]!.pairs, spaces[1]!.pairs, `frame ${frame}`);
  }
  expect(retained, 'updates in which candidates are retained').toBeGreaterThan(60);
});

test('another technique gets boxes that were off in the order of all', () => {
  const space = new BroadPhase();
  const boxes = Float32Array.from({ length: 4 * 100 }, (_, k) => (k >> 2) * 0.6 + (k % 4 < 2 ? 0 : 1));
  space.setAll(boxes).update();
  const ordered = Array.from(space.pairs);
  space.setEnabled(3, false).setEnabled(50, false).update();
  space.setEnabled(3, true).setEnabled(50, true).update();
  space.set(0, -1, -1, 0, 0).update();
  space.set(0, 0, 0, 1, 1).update();
  space.technique = 'strip-sweep';
  expect(Array.from(space.update().pairs)).toEqual(ordered);
});

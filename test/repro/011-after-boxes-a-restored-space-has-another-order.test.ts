// What a tester saw: after boxes() and a double given by set, a space restored from a snapshot had the same pairs as
// the original, in another order: its doubles were rounded in another way. While this was mended, worse came up: if all
// doubles had been replaced by numbers that float32 holds, a snapshot had boxes elsewhere.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

type Change = (space: BroadPhase<2 | 3>, box: (id: number) => number[]) => void;

const inPlace: Change = (space, box) => {
  const count = 72;
  const boxes = space.boxes(count);
  for (let id = 0; id < count; id++) boxes.set(box(id), 2 * space.dimensions * id);
};
const floats: Change = (space, box) => {
  for (let id = 0; id < 72; id++) space.set(id, ...(box(id).map(Math.fround) as [number, number, number, number]));
};
const doubles: Change = (space, box) => {
  for (let id = 18; id < 30; id++) space.set(id, ...(box(id) as [number, number, number, number]));
};

const histories: [string, Change[]][] = [
  ['boxes(), then doubles', [inPlace, doubles]],
  ['doubles, then floats for all', [floats, doubles, floats]],
  ['boxes() and doubles, then floats for all', [inPlace, doubles, floats]],
  ['floats by set, then doubles', [floats, doubles]],
];
const cases = histories.flatMap(([name, changes]) =>
  ([2, 3] as const).flatMap((dimensions) => [0, 1e6, 1e12].map((far) => ({ name, changes, dimensions, far }))),
);

test.each(cases)('$name, $dimensions D, clusters $far apart', ({ changes, dimensions, far }) => {
  const seed = Math.trunc(Math.random() * 2 ** 32);
  const random = createRandom(seed);
  const box = (id: number) => {
    const low = Array.from({ length: dimensions }, () => (id % 3) * far + random() * 4);
    return [...low, ...low.map((at) => at + random())];
  };
  for (const technique of BroadPhase.techniques) {
    const original: BroadPhase<2 | 3> = new BroadPhase({ dimensions, technique });
    for (const change of changes) {
      change(original, box);
      original.update();
    }
    const restored: BroadPhase<2 | 3> = new BroadPhase({ dimensions, technique }).restore(original.snapshot());
    for (const id of original.keys()) expect(restored.get(id), `seed ${seed}`).toEqual(original.get(id));
    for (let round = 0; round < 3; round++) {
      if (round === 2) original.snapshot(); // which must not change anything
      const numbers = box(99) as [number, number, number, number];
      for (const space of [original, restored]) space.set(99, ...numbers).update();
      expect(restored.pairs, `${technique}, round ${round}, seed ${seed}`).toEqual(original.pairs);
    }
  }
});

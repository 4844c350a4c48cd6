// Calls written down as numbers, to be made again anywhere: by play.ts in Node and in browsers, by kernel/test/play/main.cpp
// on the bare machine. Every number is a double; the first two are the dimensions, and 1 where events are
// kept plus 2 where boxes that only touch are no pairs.
import { createRandom } from '../../../src/scenes/random.ts';

/** The calls, by their number on the tape, and what follows each. */
export const calls = {
  set: 0, // id, box
  delete: 1, // id
  setFilter: 2, // id, layer, mask
  setStatic: 3, // id, 0 or 1
  setAll: 4, // count, boxes
  boxes: 5, // count, boxes
  technique: 6, // its number
  update: 7,
  clear: 8,
  snapshot: 9,
  restore: 10,
  queryBox: 11, // mask, box
  nearest: 12, // k, point
  sweep: 13, // box, displacement
  collisionsOf: 14, // id
  setEnabled: 15, // id, 0 or 1
  setGroup: 16, // id, group
  setReach: 17, // id, distance
  many: 18, // kind, as kernel/questions/bulk.hpp counts, k, count, numbers of `count` queries
} as const;

/** Numbers of a query of each kind, as kernel/questions/bulk.hpp counts them. */
export const manyNumbers = {
  2: [2, 4, 6, 4, 4, 2, 3, 0],
  3: [3, 6, 9, 6, 6, 3, 4, 0],
};

/** What a tape may have more of than the others: how many values each call takes, and how far these are apart. */
const extras = { setEnabled: [2, 1], setGroup: [4, 1], setReach: [6, 0.3] } as const;

/**
 * A tape of random calls: boxes that touch, move a little, jump, come and go, and are asked about.
 * @param extra what else is done with them, if anything, or `many`: many queries in a call are asked too
 */
export function randomTape(
  dimensions: 2 | 3,
  techniques: number,
  seed: number,
  count: number,
  extra?: keyof typeof extras | 'many',
  touching = true,
): Float64Array {
  const random = createRandom(seed);
  const integer = (below: number) => Math.floor(random() * below);
  const tape: number[] = [dimensions, touching ? 1 : 3];
  const known = new Map<number, number[]>();
  let saved: Map<number, number[]> | undefined;
  const place = () => integer(50) + [0, 0, 0, 0.5, 0.1, 1e-12][integer(6)]!;
  const axes = Array.from({ length: dimensions }, (_, k) => k);
  const fresh = (at = place) => {
    const min = axes.map(at);
    const box = [...min, ...min.map((value) => value + integer(5) + [0, 0, 0.25, 0.3][integer(4)]!)];
    if (random() < 0.01) box[integer(dimensions)] = -Infinity;
    if (random() < 0.01) box[dimensions + integer(dimensions)] = 1e30 * random();
    return box;
  };
  const id = () => (random() < 0.03 ? 2 ** 24 - 1 - 5000 * integer(4) : integer(150));
  const someone = () => [...known.keys()][integer(known.size)]!;
  const bits = () => [0xffffffff, 1, 2, 3, 6, 0, 0x80000000][integer(7)]!;
  const set = (at: number, box: number[]) => {
    tape.push(calls.set, at, ...box);
    known.set(at, box);
  };
  const replace = (call: number, boxes: number[][]) => {
    tape.push(call, boxes.length, ...boxes.flat());
    known.clear();
    boxes.forEach((box, k) => {
      known.set(k, box);
    });
  };
  /** Many queries of any kind in one call. */
  const askMany = () => {
    const kind = integer(8);
    const queries = Array.from({ length: kind === 7 ? 0 : integer(40) }, () => {
      if (manyNumbers[dimensions][kind] === 2 * dimensions && kind > 1) return fresh();
      const way = axes.map(() => integer(80) - 40 + random());
      if (kind === 2) return [...fresh(), ...way];
      return [...axes.map(place), ...(kind === 1 ? way : kind === 6 ? [integer(9)] : [])];
    });
    tape.push(calls.many, kind, 1 + integer(9), queries.length, ...queries.flat());
  };
  for (let n = 0; n < count; n++) {
    if (extra === 'many') {
      if (random() < 0.1) askMany();
    } else if (extra && known.size && random() < 0.2) {
      const [values, apart] = extras[extra];
      tape.push(calls[extra], someone(), apart * integer(values));
    }
    const chance = random();
    if (chance < 0.3) set(id(), fresh());
    else if (chance < 0.5 && known.size) {
      // A few move a little.
      for (let k = integer(12); k >= 0; k--) {
        const at = someone();
        const by = axes.map(() => (integer(9) - 4) / 8);
        set(
          at,
          known.get(at)!.map((value, a) => value + by[a % dimensions]!),
        );
      }
    } else if (chance < 0.58) {
      const at = id();
      tape.push(calls.delete, at);
      known.delete(at);
    } else if (chance < 0.62 && known.size) tape.push(calls.setFilter, someone(), bits(), bits());
    else if (chance < 0.66 && known.size) tape.push(calls.setStatic, someone(), integer(2));
    else if (chance < 0.67)
      replace(
        calls.setAll,
        Array.from({ length: integer(300) }, () => fresh()),
      );
    else if (chance < 0.68) {
      const half = () => integer(100) / 2;
      replace(
        calls.boxes,
        Array.from({ length: integer(300) }, () => fresh(half).map((value) => Math.round(2 * value) / 2)).map((box) =>
          box.map(Math.fround),
        ),
      );
    } else if (chance < 0.7) tape.push(calls.technique, integer(techniques));
    else if (chance < 0.702) {
      tape.push(calls.clear);
      known.clear();
    } else if (chance < 0.71) {
      tape.push(calls.snapshot);
      saved = new Map(known);
    } else if (chance < 0.72 && saved) {
      tape.push(calls.restore);
      known.clear();
      for (const [at, box] of saved) known.set(at, box);
    } else if (chance < 0.74) tape.push(calls.queryBox, bits(), ...fresh());
    else if (chance < 0.76) tape.push(calls.nearest, 1 + integer(20), ...axes.map(place));
    else if (chance < 0.78) tape.push(calls.sweep, ...fresh(), ...axes.map(() => integer(80) - 40 + random()));
    else if (chance < 0.8) tape.push(calls.collisionsOf, id());
    else tape.push(calls.update);
  }
  tape.push(calls.update);
  return Float64Array.from(tape);
}

/** A tape of frames, as float32, each followed by an update. */
export function framesTape(dimensions: 2 | 3, frames: readonly Float32Array[]): Float64Array {
  const length = frames.reduce((sum, frame) => sum + 3 + frame.length, 2);
  const tape = new Float64Array(length);
  tape.set([dimensions, 1]);
  let at = 2;
  for (const frame of frames) {
    tape.set([calls.boxes, frame.length / 2 / dimensions], at);
    tape.set(frame, at + 2);
    at += 3 + frame.length;
    tape[at - 1] = calls.update;
  }
  return tape;
}

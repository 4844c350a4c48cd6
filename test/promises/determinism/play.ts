// Makes the calls of a tape (tape.ts) on a space, and hashes all that it answers, in its order, bit by bit.
// kernel/test/play/main.cpp does the same without JavaScript.
import { BroadPhase, type ManyIds } from 'broadphase';
import { calls, manyNumbers } from './tape.ts';

type Numbers = [number, number, number, number];

/** The hash, as 16 hexadecimal digits, of what a space with that technique answers to the calls of a tape. */
export function play(tape: Float64Array, technique: number): string {
  const { techniques } = BroadPhase;
  const dimensions = tape[0] as 2 | 3;
  const options = { events: (tape[1]! & 1) !== 0, touching: (tape[1]! & 2) === 0 };
  const space = new BroadPhase({ dimensions, ...options, technique: techniques[technique]! });
  let [first, second] = [0x811c9dc5, 0x1b873593];
  const add = (word: number) => {
    first = Math.imul(first ^ word, 0x9e3779b1);
    first ^= first >>> 15;
    second = Math.imul(second ^ word, 0x85ebca77);
    second ^= second >>> 13;
  };
  const addAll = (words: ArrayLike<number>) => {
    add(words.length);
    for (let k = 0; k < words.length; k++) add(words[k]!);
  };
  const double = new Float64Array(1);
  const halves = new Uint32Array(double.buffer);
  const addDoubles = (numbers: Float64Array) => {
    for (const number of numbers) {
      double[0] = number;
      add(halves[0]!);
      add(halves[1]!);
    }
  };
  const box = new Float64Array(2 * dimensions);
  let saved = new Uint8Array();
  let at = 2;
  const next = () => tape[at++]!;
  const take = (count: number) => {
    at += count;
    return tape.subarray(at - count, at);
  };
  while (at < tape.length) {
    switch (next()) {
      case calls.set: {
        const id = next();
        space.set(id, ...(take(2 * dimensions) as unknown as Numbers));
        // Ends its wait: the native player has no boxes that wait, and queries may answer in another order while some do.
        space.get(id, box);
        break;
      }
      case calls.delete:
        add(Number(space.delete(next())));
        break;
      case calls.setFilter:
        space.setFilter(next(), next(), next());
        break;
      case calls.setStatic:
        space.setStatic(next(), next() === 1);
        break;
      case calls.setEnabled:
        space.setEnabled(next(), next() === 1);
        break;
      case calls.setGroup:
        space.setGroup(next(), next());
        break;
      case calls.setReach:
        space.setReach(next(), next());
        break;
      case calls.setAll:
        space.setAll(take(next() * 2 * dimensions));
        break;
      case calls.boxes: {
        const count = next();
        space.boxes(count).set(take(count * 2 * dimensions));
        break;
      }
      case calls.technique:
        space.technique = techniques[next()]!;
        break;
      case calls.update:
        space.update();
        addAll(space.pairs);
        addAll(space.began);
        addAll(space.ended);
        add(space.stats.candidates);
        break;
      case calls.clear:
        space.clear();
        break;
      case calls.snapshot:
        saved = space.snapshot();
        addAll(saved);
        break;
      case calls.restore:
        space.restore(saved);
        break;
      case calls.queryBox: {
        const mask = next();
        addAll(space.queryBox(...(take(2 * dimensions) as unknown as Numbers), { mask }));
        break;
      }
      case calls.nearest: {
        const most = next();
        const [x, y, z] = take(dimensions);
        addAll(dimensions === 2 ? space.nearest(x!, y!, most) : space.nearest(x!, y!, z!, most));
        break;
      }
      case calls.sweep: {
        const hit = space.sweep(...(take(3 * dimensions) as unknown as [...Numbers, number, number]));
        double[0] = hit?.time ?? -1;
        addAll([hit?.id ?? -1, halves[0]!, halves[1]!]);
        break;
      }
      case calls.many: {
        const [kind, most, count] = take(3) as unknown as [number, number, number];
        const answer = askMany(space, kind, most, take(count * manyNumbers[dimensions][kind]!));
        addAll(answer.offsets);
        addAll(answer.ids);
        addDoubles(answer.distances ?? answer.times ?? new Float64Array());
        break;
      }
      case calls.collisionsOf:
        addAll(space.collisionsOf(next()));
        break;
      default:
        throw new Error(`the tape has no call at ${at - 1}`);
    }
  }
  return [first, second].map((half) => (half >>> 0).toString(16).padStart(8, '0')).join('');
}

type Answer = ManyIds & { distances?: Float64Array; times?: Float64Array };

function askMany(space: BroadPhase<2 | 3>, kind: number, most: number, numbers: Float64Array): Answer {
  const ask: (() => Answer)[] = [
    () => space.nearests(numbers, most),
    () => space.rayCasts(numbers),
    () => space.sweeps(numbers),
    () => space.queryBoxes(numbers),
    () => space.queryBoxes(numbers, { within: true }),
    () => space.queryPoints(numbers),
    () => space.queryCircles(numbers),
    () => space.nearestsOfAll(most),
  ];
  return ask[kind]!();
}

export const techniqueNames = (): readonly string[] => BroadPhase.techniques;

// One-shot: all pairs of an array of boxes, by `findPairs` and `findPairsBetween`. Each contender begins in a fresh
// process: its first call, and its tenth, when the engine has compiled the code. Frames are the same for all.
import { fileURLToPath } from 'node:url';
import { difference } from '../harness/judge.mjs';
import { start } from '../harness/race.mjs';
import { median } from '../harness/statistics.mjs';

export const title = 'One-shot: the first call, and the tenth';

const module = fileURLToPath(new URL('../contenders/once.mjs', import.meta.url));
const counts = [2, 10, 100, 1000, 10_000, 100_000, 1_000_000];
const contenders = {
  findPairs: ['broadphase', 'flatbush', 'box-intersect', 'rbush'],
  findPairsBetween: ['broadphase', 'flatbush', 'box-intersect', 'rbush'],
};
const [calls, processes] = [10, 5];
/**
 * From this many milliseconds per call on, two processes of four calls are enough; and from these on, more boxes are
 * too many.
 */
const [long, tooLong] = [300, 1500];

export const rows = ({ names, counts: wanted = counts }) =>
  Object.entries(contenders)
    .filter(([name]) => !names || names.includes(name))
    .flatMap(([name, peers]) =>
      wanted.map((count) => ({
        kind: 'once',
        name,
        scene: 'uniform2d',
        dimensions: 2,
        count,
        numbers: 'double',
        seed: 1,
        between: name === 'findPairsBetween',
        peers,
      })),
    );

export async function play({ peers, ...row }) {
  const found = [];
  let reference;
  for (const name of peers) {
    const figures = await called(name, row);
    reference ??= figures.notes?.[0];
    const { notes, ...rest } = figures;
    const differing = notes && difference(notes, reference);
    found.push({ name, peer: name, ...rest, ...(differing && { wrong: differing }) });
  }
  const pairs = reference?.pairs[0];
  return { ...row, pairs: { mean: pairs, least: pairs, most: pairs }, contenders: found };
}

async function called(name, row) {
  const notes = [];
  let [wanted, plan] = [processes, { warmUp: 0, timed: calls }];
  for (let k = 0; k < wanted; k++) {
    const runner = start();
    const order = { module, variant: name, row: { ...row, plan }, stride: 1 };
    const opened = await runner.ask('open', order);
    // The first call determines how many more there will be.
    const first = opened.error ? opened : await runner.ask('play', 1);
    const noted = first.error || first.slow ? first : await runner.ask('notes', 0);
    const time = noted.update?.[0];
    if (time > long) [wanted, plan] = [2, { warmUp: 0, timed: 4 }];
    const played = time > tooLong ? {} : await runner.ask('play', plan.timed - 1);
    const all = noted.error || played.error ? {} : await runner.ask('notes', 0);
    runner.stop();
    const error = noted.error ?? played.error ?? all.error;
    if (error) return { error: error.split('\n')[0] };
    if (noted.slow || played.slow) return { slow: noted.slow ?? played.slow };
    notes.push(all);
    if (time > tooLong) break;
  }
  const last = Math.min(...notes.map(({ update }) => update.length)) - 1;
  return {
    notes,
    first: median(notes.map(({ update }) => update[0])),
    ...(last > 0 && { later: median(notes.map(({ update }) => update[last])), call: last + 1 }),
  };
}

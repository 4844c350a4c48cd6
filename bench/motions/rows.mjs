// The rows of motions: `auto` against `strip-sweep`, which finds all anew, in the same frames. Boxes are held in doubles;
// they are given by `set`, or in place, which makes them float32.
import { fileURLToPath } from 'node:url';
import { motionNames } from '../../build/bench/library.mjs';
import { framesFor } from '../harness/frames.mjs';
import { race } from '../harness/race.mjs';

const module = fileURLToPath(new URL('../contenders/broadphase.mjs', import.meta.url));
/** The first is what `auto` is held against. */
const contenders = ['strip-sweep', 'auto'].map((name) => ({ name, variant: name, module }));
/** Each time another seed than the tests have. */
const seed = 20;

/** @param wanted `{ names, set, counts, dimensions, by, frames }`, each optional; `frames`: how many are timed */
export function motionRows({
  names,
  set,
  counts = [1000, 10_000, 100_000],
  dimensions = [2, 3],
  by = ['set', 'boxes'],
  frames,
}) {
  const sets = Object.entries(motionNames).filter(([name]) => !set || name === set);
  const known = sets.flatMap(([name, motions]) => motions.map((motion) => ({ set: name, motion })));
  const unknown = names?.find((name) => !known.some(({ motion }) => motion === name));
  if (unknown !== undefined) {
    throw new RangeError(
      `No motion is called "${unknown}": expected one of ${known.map(({ motion }) => motion).join(', ')}.`,
    );
  }
  const planFor = (count) => ({ ...framesFor(count), ...(frames && { timed: frames }) });
  return counts.flatMap((count) =>
    dimensions.flatMap((d) =>
      by.flatMap((way) =>
        known
          .filter(({ motion }) => !names || names.includes(motion))
          .map((of) => ({ kind: 'motions', ...of, dimensions: d, count, by: way, seed, plan: planFor(count) })),
      ),
    ),
  );
}

export const playMotion = (row, settings) => race(row, contenders, settings);

// Motions: `auto` against `strip-sweep`, which does a full rebuild, in the same frames. Positions are doubles; boxes
// are given by `set`, or in place, which makes them float32.
import { motionNames } from '../../build/bench/library.mjs';
import { techniques } from '../contenders/techniques.mjs';
import { framesFor } from '../harness/frames.mjs';

export const title = 'Motions';

/** A different seed than in the tests. */
const seed = 20;

/** @param wanted `{ names, set, counts, dimensions, by }`, each optional */
export function rows({
  names,
  set,
  counts = [1000, 10_000, 100_000],
  dimensions = [2, 3],
  by = ['set', 'boxes'],
  full,
}) {
  const sets = Object.entries(motionNames).filter(([name]) => !set || name === set);
  const known = sets.flatMap(([name, motions]) => motions.map((motion) => ({ set: name, name: motion, motion })));
  const contenders = techniques('strip-sweep', 'auto');
  const chosen = counts.flatMap((count) =>
    dimensions.flatMap((d) =>
      by.flatMap((way) =>
        known
          .filter(({ motion }) => !names || names.includes(motion))
          .map((of) => ({
            kind: 'motions',
            ...of,
            dimensions: d,
            count,
            by: way,
            seed,
            plan: framesFor(count),
            playings: 3,
            // In every second frame only, boxes would move twice as far, and other lists would pay.
            budget: Infinity,
            contenders,
          })),
      ),
    ),
  );
  return full === false ? chosen.filter(isUsual) : chosen;
}

/** In a run of everything: in doubles, 10,000 in 2D and 3D, others in 2D; and in place, 10,000 in 2D. */
const isUsual = ({ count, by, dimensions }) =>
  (count === 10_000 && by === 'set') || (dimensions === 2 && (by === 'set' || count === 10_000));

// Few movers: the cost of an update by the number of boxes that jitter, by up to half their side, while all others
// rest. Only moved boxes are set.
import { techniques } from '../contenders/techniques.mjs';
import { framesFor } from '../harness/frames.mjs';

export const title = 'Few movers';

const movers = [1, 10, 100, 1000, 10_000];

export const rows = ({ counts = [10_000, 100_000] }) =>
  counts.flatMap((count) =>
    movers
      .filter((moving) => moving <= count)
      .map((moving) => ({
        kind: 'movers',
        name: `${moving} jitter`,
        movers: moving,
        dimensions: 2,
        count,
        numbers: 'double',
        by: 'movers',
        seed: 1,
        plan: framesFor(count),
        playings: 3,
        budget: Infinity,
        contenders: techniques('strip-sweep', 'auto'),
      })),
  );

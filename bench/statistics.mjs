// The figures of a contender from the times of its frames, round by round. The headline is the median over the
// rounds of a round's mean: a busy moment of the machine spoils one round, a structure's own spikes spoil them all.

const sum = (values) => values.reduce((total, value) => total + value, 0);

const ascending = (values) => [...values].sort((a, b) => a - b);

function quantile(values, share) {
  const sorted = ascending(values);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

export function median(values) {
  const sorted = ascending(values);
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

export function summary(rounds) {
  const all = rounds.flat();
  const means = rounds.map((times) => sum(times) / times.length);
  return {
    median: median(means),
    mean: sum(all) / all.length,
    p95: quantile(all, 0.95),
    worst: Math.max(...all),
    /** Between which the rounds lay: what is within is noise. */
    range: [Math.min(...means), Math.max(...means)],
    frames: all.length,
  };
}

/** A change below this share is never worth a mark, however quiet the machine. */
const leastChange = 0.03;

/** How much slower `after` is than `before`, and whether by more than the noise: all rounds of one beyond the other's. */
export function change(before, after) {
  const ratio = after.median / before.median;
  const apart = after.range[0] > before.range[1] || before.range[0] > after.range[1];
  return { ratio, beyondNoise: apart && Math.abs(ratio - 1) > leastChange };
}

/** Of frames that were played several times, each time the same ones: the least that each took. */
export function leastOfEach(playings) {
  return playings[0].map((first, frame) => playings.reduce((least, times) => Math.min(least, times[frame]), first));
}

export function spread(times) {
  return { mean: sum(times) / times.length, p95: quantile(times, 0.95), worst: Math.max(...times) };
}

/**
 * A frame of fewer milliseconds, or milliseconds a box, counts as one of so many, where others are held against it. Where
 * all boxes are static nothing is found anew; where some may meet, finding all anew took 13 nanoseconds a box or more.
 */
const leastFrame = 0.02;
const leastPerBox = 5e-6;

/** How long frames took against the same frames of another: by the mean, and in the worst frame, and which that is. */
export function against(times, others, boxes) {
  const least = Math.max(leastFrame, leastPerBox * boxes);
  const ratios = times.map((time, frame) => time / Math.max(least, others[frame]));
  const worstRatio = Math.max(...ratios);
  return { ratio: sum(times) / sum(others), worstRatio, worstFrame: ratios.indexOf(worstRatio) };
}

/** Times for few boxes are too short to tell how they grow. */
const fewest = 1000;

/** What more boxes will take at least, by the times for fewer, ascending: it grows as before, from n to n^2. */
export function guessTime(points, count) {
  const last = points.at(-1);
  if (last?.ms === undefined) return undefined;
  const before = points.at(-2);
  const steps = before?.ms !== undefined && before.count >= fewest && Math.log(last.count / before.count);
  const power = steps ? Math.log(last.ms / before.ms) / steps : 1;
  return last.ms * (count / last.count) ** Math.min(2, Math.max(1, power));
}

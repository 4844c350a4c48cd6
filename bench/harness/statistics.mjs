// Figures from the times of frames. The headline is the median frame; the mean includes the spikes.

const sum = (values) => values.reduce((total, value) => total + value, 0);

export const mean = (values) => sum(values) / values.length;

/** The value below which this share of the values lies. */
export function quantile(values, share) {
  const sorted = Float64Array.from(values).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

export function median(values) {
  const sorted = Float64Array.from(values).sort();
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/** The number of groups of frames for estimating the noise. */
const groups = 5;

/**
 * `range`: the least and the highest median of five groups of neighbouring frames. Differences within this range are
 * noise.
 */
export function spread(times) {
  const size = Math.ceil(times.length / groups);
  const medians = [];
  for (let from = 0; from < times.length; from += size) medians.push(median(times.slice(from, from + size)));
  return {
    median: median(times),
    mean: mean(times),
    p95: quantile(times, 0.95),
    worst: Math.max(...times),
    range: [Math.min(...medians), Math.max(...medians)],
  };
}

/** The shortest time of each frame, if the same frames were played several times. */
export const leastOfEach = (playings) =>
  playings[0].map((first, frame) => playings.reduce((least, times) => Math.min(least, times[frame]), first));

// Summaries of numbers, and histograms.

/** The value that a given share of the sorted values does not exceed. */
export function percentile(sorted: ArrayLike<number>, share: number): number {
  if (sorted.length === 0) return 0;
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

/** A summary of numbers in five values; all are 0 if there are no numbers. */
export interface Summary {
  /** The least. */
  min: number;
  /** The arithmetic mean. */
  mean: number;
  /** Half of the numbers do not exceed it. */
  median: number;
  /** 95 % of the numbers do not exceed it. */
  p95: number;
  /** The largest. */
  max: number;
}

export function summarize(values: Iterable<number>): Summary {
  const sorted = Float64Array.from(values).sort();
  const mean = sorted.length === 0 ? 0 : sorted.reduce((sum, value) => sum + value, 0) / sorted.length;
  const at = (share: number) => percentile(sorted, share);
  return { min: at(0), mean, median: at(0.5), p95: at(0.95), max: at(1) };
}

/** A bin of a histogram: values from `from` to below `to`. */
export interface Bin {
  /** The least value in it. */
  from: number;
  /** All values in it are below this. */
  to: number;
  /** The number of values. */
  count: number;
}

/** One bin for each doubling, and one before them for zeros. Infinite values are left out. */
export function doublingHistogram(values: Iterable<number>): Bin[] {
  const bins = new Map<number, number>();
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    const bin = value > 0 ? Math.floor(Math.log2(value)) : -Infinity;
    bins.set(bin, (bins.get(bin) ?? 0) + 1);
  }
  const powers = [...bins.keys()].sort((a, b) => a - b);
  const first = powers.find(Number.isFinite);
  if (first !== undefined) for (let k = first; k < powers[powers.length - 1]; k++) bins.set(k, bins.get(k) ?? 0);
  return [...bins]
    .sort(([a], [b]) => a - b)
    .map(([power, count]) => ({
      from: 2 ** power,
      to: Number.isFinite(power) ? 2 ** (power + 1) : 0,
      count,
    }));
}

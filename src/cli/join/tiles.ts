// Where to cut the boxes into tiles. A tile is a strip of the world: it has every box that overlaps it, and reports the
// pairs whose larger lower corner lies in it (the rule of broadphase/shard). So tiles are independent of each other.

export interface Tiles {
  /** Along which axis. */
  axis: number;
  /** n cuts make n + 1 tiles; a cut belongs to the tile above it. */
  cuts: number[];
}

/**
 * Cuts so that about the same number of boxes begins in each of `tiles` tiles, along the axis with the smallest maximum
 * of boxes in a tile.
 * @param sample some of the boxes, as a flat array
 */
export function chooseTiles(sample: readonly number[], dimensions: 2 | 3, tiles: number): Tiles {
  let best: Tiles = { axis: 0, cuts: [] };
  let least = Infinity;
  for (let axis = 0; axis < dimensions; axis++) {
    const [lows, highs] = [axis, axis + dimensions].map((from) =>
      Float64Array.from(
        { length: sample.length / (2 * dimensions) },
        (_, k) => sample[2 * dimensions * k + from],
      ).sort(),
    );
    const wanted = Array.from({ length: tiles - 1 }, (_, k) => lows[Math.floor((lows.length * (k + 1)) / tiles)]);
    const cuts = [...new Set(wanted)].filter(Number.isFinite);
    // A tile has the boxes that begin before its end and do not end before its start.
    const fullest = [-Infinity, ...cuts].reduce((most, start, k) => {
      const begun = k < cuts.length ? below(lows, cuts[k]) : lows.length;
      return Math.max(most, begun - below(highs, start));
    }, 0);
    if (fullest >= least) continue;
    least = fullest;
    best = { axis, cuts };
  }
  return best;
}

/** How many of the ascending values are below this one. */
function below(ascending: Float64Array, value: number): number {
  let [low, high] = [0, ascending.length];
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (ascending[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** SQL for the tile of a coordinate, the number of cuts at or below it: a binary search. */
export function tileOf(column: string, cuts: readonly number[], from = 0, to = cuts.length): string {
  if (from === to) return String(from);
  const middle = (from + to) >>> 1;
  const [under, over] = [tileOf(column, cuts, from, middle), tileOf(column, cuts, middle + 1, to)];
  return `(case when ${column} < '${cuts[middle]}'::double then ${under} else ${over} end)`;
}

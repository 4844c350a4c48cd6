// Seeded random numbers (mulberry32: 32 bits of state, a handful of integer operations a draw) and the two
// distributions the scenes need. The same seed gives the same numbers on every machine.

/** A source of numbers in [0, 1). */
export type Random = () => number;

export function createRandom(seed: number): Random {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Normally distributed with mean 0 and deviation 1 (Box and Muller). */
export function normal(random: Random): number {
  return Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
}

/** Pareto distributed between `low` and `high`: many small, few large. */
export function pareto(random: Random, low: number, high: number, exponent: number): number {
  const cut = 1 - (low / high) ** exponent;
  return low / (1 - cut * random()) ** (1 / exponent);
}

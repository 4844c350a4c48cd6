// Scenes that tests of several files share.
import * as ro from 'broadphase/ro';

/** The same numbers in 0 … 1 every time, for the same seed (mulberry32's recurrence). */
export function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Adds `count` squares of 10x10 to a new world without a screen, at the places given. */
export function squares(
  coltech: ro.coltech.Technique,
  count: number,
  place: (i: number) => [x: number, y: number],
): ro.World {
  const world = new ro.World(null, { coltech });
  for (let i = 0; i < count; i++) world.addEntity(new ro.Entity(...place(i), 10, 10));
  return world;
}

/** The pairs a technique finds, as sorted keys that can be compared between worlds. */
export function keys(pairs: readonly ro.coltech.Pair<ro.Entity>[]): string[] {
  return pairs.map(([a, b]) => `${a._roId}:${b._roId}`).sort();
}

/** Records the pairs of every query a technique answers. */
export function recordPairs(technique: ro.coltech.Technique): string[][] {
  const frames: string[][] = [];
  const query = technique.queryForCollisionPairs.bind(technique);
  technique.queryForCollisionPairs = () => {
    const pairs = query();
    frames.push(keys(pairs));
    return pairs;
  };
  return frames;
}

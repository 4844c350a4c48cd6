// What the tests of the recorders share: whether the engines are installed, and that a recording replays exactly.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { openTrace, replay } from 'broadphase/trace';
import { expect } from 'vitest';

/** Whether the packages of the examples are installed (npm ci --prefix examples). In CI they must be. */
export const installed =
  Boolean(process.env.CI) || existsSync(fileURLToPath(new URL('../node_modules/matter-js/', import.meta.url)));

/** Opens the recording, plays it with the exact check on, and returns copies of its frames. */
export function checkRecording(bytes) {
  const trace = openTrace(bytes);
  for (const { difference } of replay(trace, {}, true)) expect(difference).toBeNull();
  return Array.from(trace, (frame) => ({
    ...frame,
    boxes: frame.boxes.slice(),
    ids: frame.ids?.slice() ?? Uint32Array.from({ length: frame.count }, (_, k) => k),
    rules: frame.rules?.slice(),
  }));
}

/** The pairs of a space, as a set of 'a b' with the smaller id first. */
export const pairsOf = ({ pairs }) =>
  new Set(Array.from({ length: pairs.length / 2 }, (_, k) => `${pairs[2 * k]} ${pairs[2 * k + 1]}`));

export const pairName = (a, b) => `${Math.min(a, b)} ${Math.max(a, b)}`;

/** The category and the mask of six bodies at one place. */
export const bits = [1, 2, 4, 1, 2, 4].map((category, k) => [category, k < 3 ? 3 : 6]);

/** Their groups, as an engine has them: of a positive one all bodies meet, of a negative one none. */
export const groupsInTime = [
  [0, 0, 0, 0, 0, 0],
  [-1, -1, -2, -2, 5, 5],
  [5, 0, 5, 0, -1, -1],
  [0, -2, 0, -2, 0, 0],
];

/** Checks that all bodies meet that may; others only where one is of a positive group. */
export function checkGroups(space, groups, idOf, mayMeet) {
  const pairs = pairsOf(space);
  for (let a = 0; a < groups.length; a++) {
    for (let b = 0; b < a; b++) {
      const isPair = pairs.has(pairName(idOf(a), idOf(b)));
      if (mayMeet(a, b) || Math.max(groups[a], groups[b]) <= 0) expect([a, b, isPair]).toEqual([a, b, mayMeet(a, b)]);
    }
  }
}

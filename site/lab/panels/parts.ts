// What the cells of a technique are called, and how many of them are in the picture.
import type { TechniqueName } from 'broadphase';
import { formatCount } from '../../shared/format.ts';

/** The parts of a technique's structure; `structure()` has them all as boxes. */
export const partOf = (technique: TechniqueName): string => (technique === 'sweep-and-prune' ? 'interval' : 'cell');

/** What follows the number of parts: their name, and how many are drawn if not all that should be. */
export function describeParts(technique: TechniqueName, count: number, drawn: number): string {
  const name = `${partOf(technique)}${count === 1 ? '' : 's'}`;
  return drawn < count ? `${name}, ${formatCount(drawn)} drawn` : name;
}

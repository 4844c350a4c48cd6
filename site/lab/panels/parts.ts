// What the cells of a technique are called, and how many of them are in the picture.
import type { TechniqueName } from 'broadphase';
import { formatCount } from '../../shared/format.ts';

/** The parts of a technique's structure; `structure()` has them all as boxes. */
export const partOf = (technique: TechniqueName): string => (technique === 'sweep-and-prune' ? 'interval' : 'cell');

/** What follows the number of parts: their name, and if they are not seen, or not all drawn, that. */
export function describeParts(technique: TechniqueName, count: number, drawn: number, tooSmall: boolean): string {
  const name = `${partOf(technique)}${count === 1 ? '' : 's'}`;
  if (tooSmall) return `${name}, too small to see here`;
  return drawn < count ? `${name}, ${formatCount(drawn)} drawn` : name;
}

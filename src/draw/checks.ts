// Checks of what is to be drawn.
import type { BroadPhase } from 'broadphase';

/** @throws TypeError or RangeError if a ray is not a list of the right number of numbers */
export function checkRay(where: string, ray: unknown, dimensions: 2 | 3): asserts ray is readonly number[] {
  const least = 2 * dimensions;
  const isList = Array.isArray(ray);
  const fits = isList && (ray.length === least || ray.length === least + 1);
  // Holes and text too, which `rayCast` would refuse after some has been drawn.
  if (fits && [...ray].every((x, k) => typeof x === 'number' && (k < least ? x - x === 0 : x >= 0))) return;
  bad(where, ray, `${least} finite numbers, and maybe a distance`, isList ? RangeError : TypeError);
}

/** @throws TypeError for what is no space, RangeError for one of other dimensions */
export function checkSpace(where: string, space: BroadPhase<2 | 3>, dimensions: 2 | 3): void {
  if (typeof space?.structure !== 'function') bad(where, space, 'a BroadPhase');
  if (space.dimensions === dimensions) return;
  throw new RangeError(`${where}: got a space of ${space.dimensions} dimensions, expected ${dimensions}`);
}

/** A wrong argument: `badValue`, but smaller. */
export function bad(where: string, value: unknown, expected: string, Kind = TypeError): never {
  let shown: string = typeof value; // an object without a prototype, or with a symbol in it, does not become text
  try {
    if (shown === 'string') shown = `"${value}"`;
    else shown = Array.isArray(value) ? `[${value.map(String).join(', ')}]` : String(value);
  } catch {}
  throw new Kind(`${where}: got ${shown}, expected ${expected}`);
}

// How full the cells of a technique are. A box counts in the smallest cell that contains its lower corner, so that the
// nodes of a tree, which are nested, are not all as full as their contents. To find the cells of a corner, the cells
// are put into a space of their own, which is queried with some corners at a time: pairs with all corners at once could
// exceed the memory. That space has the class of the space that is drawn, so that users of the small library do not get
// the large one too.
import type { BroadPhase } from 'broadphase';
import { checkSpace } from './checks.ts';

/** How many corners are queried in one call. */
const atOnce = 1000;

/**
 * The number of boxes in each cell of `structure()`, in its order. Each box counts once: in the smallest cell that
 * contains its lower corner, or in none. Slower than an update: a few hundredths of a second for 100,000 boxes, for an
 * `aabb-tree` seconds.
 *
 * @throws TypeError for anything but a space
 *
 * @example
 * const space = new BroadPhase({ technique: 'strip-sweep' });
 * space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
 * boxesInCells(space).length === space.structure().length / 4; // → true
 */
export function boxesInCells(space: BroadPhase<2 | 3>): Uint32Array {
  checkSpace('boxesInCells', space, space?.dimensions);
  const { dimensions } = space;
  const width = 2 * dimensions;
  const cells = space.structure().slice();
  const held = new Uint32Array(cells.length / width);
  const sizes = new Float64Array(held.length).fill(1);
  for (let k = 0; k < cells.length; k++) {
    if (k % width < dimensions) sizes[Math.floor(k / width)] *= cells[k + dimensions] - cells[k];
  }

  // Not the constructor of a class that extends it, which may expect anything.
  let made: object = space.constructor;
  while (!Object.hasOwn(made, 'techniques')) made = Object.getPrototypeOf(made);
  const Space = made as new (options: { dimensions: 2 | 3 }) => BroadPhase<2 | 3>;
  const search = new Space({ dimensions }).setAll(cells).update();
  const corners = new Float64Array(space.size * width);
  let filled = 0;
  for (const id of space.keys()) {
    const corner = space.get(id, corners.subarray(filled, filled + width))!;
    corner.copyWithin(dimensions, 0); // as a box
    filled += width;
  }
  for (let from = 0; from < filled; from += atOnce * width) {
    const { ids: found, offsets } = search.queryBoxes(corners.subarray(from, from + atOnce * width));
    for (let k = 1; k < offsets.length; k++) {
      let home = found[offsets[k - 1]];
      for (let at = offsets[k - 1]; at < offsets[k]; at++) if (sizes[found[at]] < sizes[home]) home = found[at];
      if (offsets[k - 1] < offsets[k]) held[home]++;
    }
  }
  search.dispose();
  return held;
}

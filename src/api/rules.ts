// Who may be a pair with whom: filters, groups, static boxes, boxes that are off, and reaches.
import type { Filter } from '../rules.ts';

/** Who may be a pair with whom: filters, groups, static boxes, boxes that are off, and reaches. */
export interface Rules {
  /**
   * Sets which boxes box `id` meets: two boxes are a pair only if the layer of each has a bit in the other's mask, so a
   * box with layer 0 is in no pair. Both are 32 bits. Without a filter all bits are set, so that a box meets all boxes
   * that do not exclude it. Filters are applied before and inside the search: boxes that ignore each other cost little,
   * and boxes that can meet nobody cost nothing. The filter belongs to the id: it stays when the box moves, by whatever
   * call, and ends with `delete` and `clear`.
   *
   * @param id an integer from 0 to 2^24 - 1, of an existing box
   * @param layer what the box is: an integer from 0 to 2^32 - 1, usually one bit
   * @param mask what it meets: the same, usually a few bits. Write `~bits >>> 0` for all but a few
   * @throws RangeError for a bad id or one without a box, and for more than 32 bits; TypeError for anything but numbers
   *
   * @example
   * const space = new BroadPhase();
   * const player = 1, enemy = 2, bullet = 4;
   * for (const id of [0, 1, 2]) space.set(id, 0, 0, 1, 1);
   * space.setFilter(0, player, enemy);
   * space.setFilter(1, enemy, player | bullet);
   * space.setFilter(2, bullet, enemy); // bullets meet enemies, but neither players nor bullets
   * space.update().pairs; // → Uint32Array [0, 1, 1, 2]
   */
  setFilter(id: number, layer: number, mask: number): this;

  /**
   * The layer and the mask that `setFilter` gave box `id`: all bits set if it has no filter, `undefined` if there is no
   * such box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 1, 1).setFilter(7, 1, 6);
   * space.filterOf(7); // → { layer: 1, mask: 6 }
   * space.filterOf(8); // → undefined
   */
  filterOf(id: number): Filter | undefined;

  /**
   * Sets whether box `id` is static: two static boxes are never a pair. Static boxes can be moved like others. The
   * setting belongs to the id, as filters do.
   *
   * @param id an integer from 0 to 2^24 - 1, of an existing box
   * @param isStatic default true
   * @throws RangeError or TypeError for a bad id or one without a box; TypeError for anything but a boolean
   *
   * @example
   * const space = new BroadPhase();
   * space.set(0, 0, 0, 9, 1).setStatic(0).set(1, 8, 0, 9, 9).setStatic(1); // two walls
   * space.set(2, 8, 0, 9, 1); // and a ball
   * space.update().pairCount; // → 2
   */
  setStatic(id: number, ...isStatic: [] | [isStatic: boolean]): this;

  /**
   * Whether box `id` is static, as set by `setStatic`; false if there is no such box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setStatic(7).isStatic(7); // → true
   */
  isStatic(id: number): boolean;

  /**
   * Switches box `id` off, or on again. A box that is off keeps its numbers and its rules, and can be set, moved and
   * deleted. From the next update on it is in no pair and in no answer, and its pairs have ended. The setting belongs
   * to the id, as filters do.
   *
   * @param id an integer from 0 to 2^24 - 1, of an existing box
   * @param enabled whether it takes part
   * @throws RangeError or TypeError for a bad id or one without a box; TypeError for anything but a boolean
   *
   * @example
   * const space = new BroadPhase();
   * space.set(0, 0, 0, 9, 9).set(1, 1, 1, 2, 2).setEnabled(1, false);
   * space.update().pairCount; // → 0
   * space.setEnabled(1, true).update().pairCount; // → 1
   */
  setEnabled(id: number, enabled: boolean): this;

  /**
   * Whether box `id` is on, as set by `setEnabled`; false if there is no such box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setEnabled(7, false).isEnabled(7); // → false
   */
  isEnabled(id: number): boolean;

  /**
   * Puts box `id` into a group: two boxes of one group are never a pair. For things that belong together, such as the
   * parts of a ragdoll, or a ship and its bullets. Group 0 means none. Queries ignore groups. The setting belongs to
   * the id, as filters do.
   *
   * @param id an integer from 0 to 2^24 - 1, of an existing box
   * @param group an integer from 0 to 2^32 - 1
   * @throws RangeError for a bad id or one without a box, and for more than 32 bits; TypeError for anything but numbers
   *
   * @example
   * const space = new BroadPhase();
   * for (const id of [0, 1, 2]) space.set(id, 0, 0, 1, 1);
   * space.setGroup(0, 7).setGroup(1, 7); // a ship and its bullet
   * space.update().pairs; // → Uint32Array [1, 2, 0, 2]
   */
  setGroup(id: number, group: number): this;

  /**
   * The group of box `id`: 0 if it is in none, `undefined` if there is no such box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setGroup(7, 3).groupOf(7); // → 3
   */
  groupOf(id: number): number | undefined;

  /**
   * Sets how far box `id` reaches: two boxes are a pair while they overlap with each enlarged by its own reach on all
   * sides. For contacts that a physics engine needs ahead of time. `get` and queries see the box as it was given. The
   * setting belongs to the id, as filters do. While any box has a reach, the space keeps an enlarged copy of all boxes.
   *
   * @param id an integer from 0 to 2^24 - 1, of an existing box
   * @param distance in units of the world: finite, at least 0. The sides of the enlarged box are sums, each rounded
   *   like any sum of doubles
   * @throws RangeError for a bad id or one without a box, and for a bad distance; TypeError for anything but numbers
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 13, 0, 20, 10);
   * space.setReach(7, 1).update().pairCount; // → 0
   * space.setReach(9, 2).update().pairCount; // → 1
   */
  setReach(id: number, distance: number): this;

  /**
   * How far box `id` reaches: 0 unless `setReach` was called, `undefined` if there is no such box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setReach(7, 0.5).reachOf(7); // → 0.5
   */
  reachOf(id: number): number | undefined;
}

// Who may be a pair with whom: filters, groups, static boxes, boxes that are off, and reaches.
import type { Filter } from '../rules.ts';

/** Who may be a pair with whom: filters, groups, static boxes, boxes that are off, and reaches. */
export interface Rules {
  /**
   * Says whom box `id` meets: a pair is reported where each one's layer has a bit in the other's mask, so that a box
   * of layer 0 is in none. Both are 32 bits; without a filter both have all bits set, so that a box meets all but those
   * that want to meet nobody. Applied before and inside the search: boxes that ignore each other cost little, boxes
   * that can meet nobody cost nothing. The filter belongs to the id: it stays when the box moves, by whatever call,
   * and goes with `delete` and `clear`.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param layer what the box is: an integer from 0 to 2^32 - 1, most often one bit
   * @param mask whom it meets: the same, most often some bits. Write `~bits >>> 0` for all but some
   * @throws RangeError for a bad id or one that has no box, and for other than 32 bits; TypeError for other than numbers
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
   * The layer and the mask that `setFilter` gave box `id`: all bits of both where it gave none, `undefined` where there is
   * no box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 1, 1).setFilter(7, 1, 6);
   * space.filterOf(7); // → { layer: 1, mask: 6 }
   * space.filterOf(8); // → undefined
   */
  filterOf(id: number): Filter | undefined;

  /**
   * Says whether box `id` is static: two static boxes are never a pair. Static boxes may be moved like others. Belongs
   * to the id, as filters do.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param isStatic true unless told
   * @throws RangeError for a bad id or one that has no box; TypeError for other than a boolean
   *
   * @example
   * const space = new BroadPhase();
   * space.set(0, 0, 0, 9, 1).setStatic(0).set(1, 8, 0, 9, 9).setStatic(1); // two walls
   * space.set(2, 8, 0, 9, 1); // and a ball
   * space.update().pairCount; // → 2
   */
  setStatic(id: number, isStatic?: boolean): this;

  /**
   * Whether box `id` is static, as `setStatic` has it: not where there is none.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setStatic(7).isStatic(7); // → true
   */
  isStatic(id: number): boolean;

  /**
   * Switches box `id` off, or on again. A box that is off keeps its numbers and its filter, and can be set, moved and
   * deleted; it is in no pair and in no answer from the next update on, which ends its pairs. Belongs to the id, as
   * filters do. While some box is off, an update looks at all boxes and pairs, also where little changes.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param enabled whether it takes part
   * @throws RangeError for a bad id or one that has no box; TypeError for other than a boolean
   *
   * @example
   * const space = new BroadPhase();
   * space.set(0, 0, 0, 9, 9).set(1, 1, 1, 2, 2).setEnabled(1, false);
   * space.update().pairCount; // → 0
   * space.setEnabled(1, true).update().pairCount; // → 1
   */
  setEnabled(id: number, enabled: boolean): this;

  /**
   * Whether box `id` takes part, as `setEnabled` has it: not where there is none.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setEnabled(7, false).isEnabled(7); // → false
   */
  isEnabled(id: number): boolean;

  /**
   * Puts box `id` into a group: two boxes of one group are never a pair. For what belongs together, such as the parts of
   * a ragdoll, or a ship and its bullets. Group 0 is none. Questions take no notice of groups. Belongs to the id, as
   * filters do.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param group an integer from 0 to 2^32 - 1
   * @throws RangeError for a bad id or one that has no box, and for other than 32 bits; TypeError for other than numbers
   *
   * @example
   * const space = new BroadPhase();
   * for (const id of [0, 1, 2]) space.set(id, 0, 0, 1, 1);
   * space.setGroup(0, 7).setGroup(1, 7); // a ship and its bullet
   * space.update().pairs; // → Uint32Array [1, 2, 0, 2]
   */
  setGroup(id: number, group: number): this;

  /**
   * The group of box `id`: 0 where it is in none, `undefined` where there is no box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setGroup(7, 3).groupOf(7); // → 3
   */
  groupOf(id: number): number | undefined;

  /**
   * Says how far box `id` reaches: it is in a pair while the two boxes overlap once each is grown by its reach to all
   * sides. For contacts that a physics engine wants to know of before they come. `get` and questions see the box itself.
   * Belongs to the id, as filters do. While some box has a reach, an update looks at all boxes.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param distance in units of the world: finite, at least 0. The sides of the grown box are sums, each rounded as sums are
   * @throws RangeError for a bad id or one that has no box, and for a bad distance; TypeError for other than numbers
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 13, 0, 20, 10);
   * space.setReach(7, 1).update().pairCount; // → 0
   * space.setReach(9, 2).update().pairCount; // → 1
   */
  setReach(id: number, distance: number): this;

  /**
   * How far box `id` reaches: 0 where `setReach` never said, `undefined` where there is no box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setReach(7, 0.5).reachOf(7); // → 0.5
   */
  reachOf(id: number): number | undefined;
}

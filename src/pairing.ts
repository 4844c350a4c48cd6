// Who is a pair with whom, beside layers and masks: groups, and how far boxes reach.
import { Contents } from './contents.ts';
import type { Dimensions } from './dimensions.ts';
import { badId, badValue, checkBits, isId, noBox } from './errors.ts';

const reaches = 'a finite number, at least 0';

/** A space whose boxes may belong together, or reach beyond themselves. */
export abstract class Pairing<D extends Dimensions> extends Contents<D> {
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
  setGroup(id: number, group: number): this {
    if (!isId(id)) badId('setGroup', id);
    checkBits('setGroup: group', group);
    try {
      if (this.kernel.set_group(id, group) === 0) noBox('setGroup', id);
    } catch (error) {
      this.recover(error, 'setGroup');
    }
    return this;
  }

  /**
   * The group of box `id`: 0 where it is in none, `undefined` where there is no box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setGroup(7, 3).groupOf(7); // → 3
   */
  groupOf(id: number): number | undefined {
    if (!isId(id)) badId('groupOf', id);
    return this.kernel.get_rule(id) === 1 ? this.io()[4]! : undefined;
  }

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
  setReach(id: number, distance: number): this {
    if (!isId(id)) badId('setReach', id);
    if (typeof distance !== 'number') badValue('setReach: distance', distance, reaches, true);
    if (!(distance >= 0 && distance < Number.POSITIVE_INFINITY)) badValue('setReach: distance', distance, reaches);
    try {
      if (this.kernel.set_reach(id, distance) === 0) noBox('setReach', id);
    } catch (error) {
      this.recover(error, 'setReach');
    }
    return this;
  }

  /**
   * How far box `id` reaches: 0 where `setReach` never said, `undefined` where there is no box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setReach(7, 0.5).reachOf(7); // → 0.5
   */
  reachOf(id: number): number | undefined {
    if (!isId(id)) badId('reachOf', id);
    return this.kernel.get_rule(id) === 1 ? this.io()[5]! : undefined;
  }
}

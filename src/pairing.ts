// Who is a pair with whom, beside layers and masks: groups.
import { Contents } from './contents.ts';
import type { Dimensions } from './dimensions.ts';
import { badId, checkBits, isId, noBox } from './errors.ts';

/** A space whose boxes may belong together. */
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
}

// A space as a whole: how it searches and what that took, saved and restored, checked and let go of.
import type { Technique as LeanTechnique } from '../generated/kernel-lean.ts';
import type { Stats } from '../stats.ts';
import type { TechniqueName } from '../techniques.ts';

/** A space as a whole: how it searches and what that took, saved and restored, checked and let go of. */
export interface Upkeep {
  /**
   * Counters of the last update: the same object every time.
   *
   * @example
   * const { stats } = new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * stats.technique; // → 'brute-force'
   * stats.reason; // → 'a handful of boxes'
   */
  get stats(): Readonly<Stats>;

  /**
   * The technique, which may be changed at any time, and takes effect with the next update: the pairs stay the same.
   *
   * @throws RangeError or TypeError for what is not the name of one that this build has
   *
   * @example
   * const space = new BroadPhase();
   * space.technique = 'strip-sweep';
   * space.update().stats.technique; // → 'strip-sweep'
   */
  get technique(): TechniqueName;
  set technique(name: LeanTechnique);

  /**
   * The boxes of the cells, strips or nodes that the last update used, to draw: 4 numbers (3D: 6) each, as `setAll`'s. A
   * view of the kernel's memory: valid until the next call.
   *
   * @example
   * const space = new BroadPhase({ technique: 'strip-sweep' });
   * const cells = space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update().structure();
   * cells.length % 4; // → 0
   */
  structure(): Float32Array;

  /**
   * What stands in the space, as bytes to go back to with `restore`, or to save: boxes as they were given, ids, their order,
   * filters, groups, reaches, which boxes are static, the technique, and with `events: true` the pairs of the last update, and those
   * that began and ended with it. Options of the constructor are not in it. A box takes 16 bytes in 2D and 24 in 3D, twice that where some box is not a
   * float32, 4 more where ids have gaps, and 4 where a box was deleted before another, up to 9 more with filters, 4 with groups, 8 with reaches; a pair 8.
   *
   * From the first call on, and from `restore` on, the order of the pairs depends on what stands in the space alone,
   * so that a restored space gives them in the very order of the one that went on. `auto` then keeps nothing from
   * update to update, and `incremental` sorts its pairs.
   *
   * @throws RangeError that names the first bad box written through `boxes()`
   *
   * @example
   * const space = new BroadPhase();
   * const saved = space.set(7, 0, 0, 10, 10).update().snapshot();
   * space.set(7, 3, 0, 13, 10).update();
   * // the network says that this frame was wrong:
   * space.restore(saved); // and play it again
   * space.get(7); // → Float64Array [0, 0, 10, 10]
   */
  snapshot(): Uint8Array<ArrayBuffer>;

  /**
   * Puts what stood in a space when `snapshot` was called in place of all that stands in this one. From there on the
   * same calls give the same pairs, in the same order, as they gave there, whatever either space did before, where the
   * two were made with the same options.
   *
   * A restored space is as after an update of the boxes that it now has: `pairs`, `isColliding`, `collisionsOf` and all
   * questions answer by them. With `events: true`, `began` and `ended` are those that the space of the snapshot had, and
   * what begins and ends with the next update does so against the pairs that it had: events come again as they came
   * there, and what happened only in frames that were taken back does not end. A snapshot of a space without events has
   * no pairs to tell them from: all begin.
   *
   * @param bytes what `snapshot` gave, in this version of the library or an older one
   * @throws RangeError that says why for bytes that are damaged, cut off, of other dimensions, or no snapshot at all;
   *   TypeError for other than bytes. The space is as before.
   * @throws RangeError where memory ends while the pairs are found: the boxes are restored, the pairs are empty
   *
   * @example
   * const space = new BroadPhase();
   * space.restore(new Uint8Array(100)); // throws RangeError: restore:
   */
  restore(bytes: Uint8Array | ArrayBuffer): this;

  /**
   * Checks every invariant of the space, in time proportional to boxes and pairs.
   * @throws Error that says what is broken, which would be a fault of this library
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).validate().size; // → 1
   */
  validate(): this;

  /**
   * Lets go of the memory at once; it also goes with the object. Any call after this throws.
   *
   * @example
   * const space = new BroadPhase();
   * space.dispose();
   * space.update(); // throws Error: this BroadPhase was disposed
   */
  dispose(): void;
}

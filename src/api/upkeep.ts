// A space as a whole: its technique and counters, snapshots, checks, and its end.
import type { Technique as LeanTechnique } from '../generated/kernel-lean.ts';
import type { Stats } from '../stats.ts';
import type { TechniqueName } from '../techniques.ts';

/** A space as a whole: its technique and counters, snapshots, checks, and its end. */
export interface Upkeep {
  /**
   * Counters of the last update, always in the same object.
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
   * @throws RangeError or TypeError for anything but the name of a technique of this build
   *
   * @example
   * const space = new BroadPhase();
   * space.technique = 'strip-sweep';
   * space.update().stats.technique; // → 'strip-sweep'
   */
  get technique(): TechniqueName;
  set technique(name: LeanTechnique);

  /**
   * The boxes of the cells, strips or nodes that the last update used, to draw: 4 numbers (3D: 6) each, as for
   * `setAll`. A view of the kernel's memory: valid until the next call.
   *
   * @example
   * const space = new BroadPhase({ technique: 'strip-sweep' });
   * const cells = space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update().structure();
   * cells.length % 4; // → 0
   */
  structure(): Float32Array;

  /**
   * The contents of the space as bytes, to go back to with `restore`, or to save: boxes as they were given, ids, their
   * order, filters, groups, reaches, which boxes are static or off, and the technique. With `events: true` they include
   * the pairs of the last update, and those that began and ended with it. Constructor options are not included. A box
   * takes 16 bytes in 2D and 24 in 3D, or twice that if any box does not fit float32. Add 4 if ids have gaps or did not
   * come in ascending order, 4 if a box was deleted before a later one, up to 9 with filters, 1 with boxes that are
   * static or off, 4 with groups, 8 with reaches. A pair takes 8.
   *
   * From the first call of this or `restore` on, the order of the pairs depends on the contents of the space alone, so
   * that a restored space gives them in the same order as the original. `auto` and `incremental` sort their pairs for
   * that.
   *
   * @throws RangeError that names the first bad box written through `boxes()`; Error if that array was requested
   * since the last update, and detached
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
   * Replaces the contents of this space with those of a snapshot. From there on the same calls give the same pairs, in
   * the same order, as in the original, whatever either space did before, if the two were created with the same
   * options.
   *
   * A restored space is as after an update with the boxes it now has: `pairs`, `isColliding`, `collisionsOf` and all
   * queries answer for them. With `events: true`, `began` and `ended` are those of the snapshot's space, and the next
   * update compares with the pairs it had. So the same events come again, and pairs that existed only in the frames you
   * went back over do not end. A snapshot of a space without events has no previous pairs: all begin.
   *
   * @param bytes the result of `snapshot`, in this version of the library or an older one
   * @throws RangeError that gives the reason for bytes that are damaged, truncated, of other dimensions, or not a
   *   snapshot; TypeError for anything but bytes. The space is as before, but damaged bytes may detach the array of
   *   `boxes`.
   * @throws RangeError if memory runs out during the search: the boxes are restored, the pairs are empty
   *
   * @example
   * const space = new BroadPhase();
   * space.restore(new Uint8Array(100)); // throws RangeError: restore:
   */
  restore(bytes: Uint8Array | ArrayBuffer): this;

  /**
   * Checks every invariant of the space, in time proportional to boxes and pairs.
   * @throws Error that says what is broken, which would be a bug in this library
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).validate().size; // → 1
   */
  validate(): this;

  /**
   * Lets go of the memory: the next garbage collection frees it, although something may still refer to the space. A space
   * that nothing refers to needs no such call. An array that is a view of the memory, such as `pairs`, keeps it. Any later
   * call that needs the boxes throws.
   *
   * @example
   * const space = new BroadPhase();
   * space.dispose();
   * space.update(); // throws Error: this BroadPhase was disposed
   */
  dispose(): void;
}

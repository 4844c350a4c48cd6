// What stands in a space: boxes by id, written and read back as in a Map.

import type { Boxes } from '../boxes.ts';
import type { BoxOfId, CentredBoxOfId, Dimensions, MovingBoxOfId } from '../dimensions.ts';

/** What stands in a space: boxes by id, written and read back as in a Map. */
export interface Contents<D extends Dimensions> {
  /**
   * The number of boxes.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1);
   * space.size; // → 1
   */
  get size(): number;

  /**
   * Adds box `id`, or moves it: 2D `set(id, minX, minY, maxX, maxY)`, 3D `set(id, minX, minY, minZ, maxX, maxY, maxZ)`.
   * Chainable.
   *
   * @param box an id, which is an integer from 0 to 2^24 - 1: ids from 0 on without gaps are best; the minima, in the
   *   units of your world: any numbers but NaN, infinite ones too; then the maxima, not below the minima
   * @throws RangeError for a bad id, NaN, or a minimum above its maximum; TypeError for anything but numbers,
   *   and for a wrong number of them. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(7, 1, 0, 11, 10);
   * space.size; // → 1
   * space.set(7, Number.NaN, 0, 1, 1); // throws RangeError: set: minX of box 7 is NaN, expected a number
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).get(7); // → Float64Array [0, 0, 0, 1, 1, 1]
   */
  set(...box: BoxOfId<D>): this;

  /**
   * Adds or moves box `id` for swept tests: for boxes so fast that they would pass through others between two frames.
   * Give the box as it is now, and how far it moves until the next frame. It is stored as the bounds of its whole path,
   * so that its pairs are everything it may hit. Bounds are rounded outward, by at most 2^-48 of the numbers involved,
   * unless these fit float32 and the sum is exact. To find out what it does hit, when and on which side, call `sweep`
   * with the same numbers. 2D `setSwept(id, minX, minY, maxX, maxY, dx, dy)`, 3D `setSwept(id, minX, minY, minZ, maxX,
   * maxY, maxZ, dx, dy, dz)`.
   *
   * @param box an id; the box as it is now, as for `set`; how far it moves along each axis: finite numbers
   * @throws as `set` does, and RangeError for a motion that is not finite. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * const bullet = 1, wall = 7;
   * space.set(wall, 21, -5, 22, 5);
   * space.setSwept(bullet, 0, 0, 1, 1, 40, 0).update(); // it moves 40 to the right
   * space.pairs; // → Uint32Array [1, 7]
   * space.sweep(0, 0, 1, 1, 40, 0, { ignore: bullet })?.time; // → 0.5
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.setSwept(1, 0, 0, 0, 1, 1, 1, 0, 0, 40).get(1); // → Float64Array [0, 0, 0, 1, 1, 41]
   */
  setSwept(...box: MovingBoxOfId<D>): this;

  /**
   * Adds or moves box `id`, given its centre and half its size, such as the box of a circle: `setCentred(id, x, y,
   * radius, radius)`. 2D `setCentred(id, x, y, halfWidth, halfHeight)`, 3D `setCentred(id, x, y, z, halfWidth,
   * halfHeight, halfDepth)`. Its bounds are the centre minus and plus half the size, each rounded like any sum of doubles.
   *
   * @param box an id; the centre: finite numbers; half the size along each axis: at least 0
   * @throws RangeError and TypeError that name the id and the number. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * space.setCentred(7, 10, 10, 5, 2).get(7); // → Float64Array [5, 8, 15, 12]
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.setCentred(7, 0, 0, 0, 1, 2, 3).get(7); // → Float64Array [-1, -2, -3, 1, 2, 3]
   */
  setCentred(...box: CentredBoxOfId<D>): this;

  /**
   * Replaces all boxes by boxes with the ids 0 … count - 1.
   *
   * @param boxes 4 (2D) or 6 (3D) numbers for each box, as `set` takes them, one box after the other
   * @param count how many boxes to take; default: all in the array
   * @throws RangeError that names the first bad id and its value, or a length that does not fit; TypeError for anything
   *   but an array of numbers. The space is as before, and so is the array of `boxes`, unless memory runs out, or it is
   *   the array given.
   *
   * @example
   * const space = new BroadPhase();
   * space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * space.pairs; // → Uint32Array [0, 1]
   */
  setAll(boxes: Boxes, count?: number): this;

  /**
   * The fastest way to give boxes: a view of the kernel's own memory for the boxes with the ids 0 … count - 1, to be
   * written in place, as float32, before `update()`. Boxes with ids from count on are removed; new ones are points at
   * the origin. This call rounds every box to the nearest float32: boxes that nearly touched as doubles may then be
   * pairs.
   *
   * Call this again each time before you write: it costs next to nothing and makes no garbage. Until `setAll`, `clear`
   * or `restore`, the array shows at once what `set` does, and what you write to it afterwards replaces that, doubles
   * too. Doubles given with `set` remain until you write other values over their rounded ones. After `delete` and
   * `update`, rows may hold other boxes, or memory may have grown and detached the array. `update()` checks what was
   * written, and throws if the array was detached and not requested again since.
   *
   * @param count how many boxes, 0 … 2^24
   * @throws RangeError or TypeError for a bad count
   *
   * @example
   * const space = new BroadPhase();
   * const boxes = space.boxes(1000);
   * for (let id = 0; id < 1000; id++) {
   *   boxes[4 * id] = id; // minX
   *   boxes[4 * id + 1] = 0; // minY
   *   boxes[4 * id + 2] = id + 1; // maxX: it touches the next one
   *   boxes[4 * id + 3] = 1; // maxY
   * }
   * space.update().pairCount; // → 999
   */
  boxes(count: number): Float32Array;

  /**
   * Removes box `id`, with its rules: its filter, its group, its reach, and whether it is static or off.
   * @param id an integer from 0 to 2^24 - 1, in use or not
   * @returns whether there was one
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1);
   * space.delete(7); // → true
   * space.delete(7); // → false
   */
  delete(id: number): boolean;

  /**
   * Removes all boxes, with their rules.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1).clear();
   * space.size; // → 0
   */
  clear(): void;

  /**
   * Whether there is a box `id`.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * new BroadPhase().has(7); // → false
   */
  has(id: number): boolean;

  get(id: number): Float64Array | undefined;
  get<Out extends Float32Array | Float64Array | number[]>(id: number, out: Out): Out | undefined;

  /**
   * The ids of all boxes, in the order of a Map: the order in which they were added. Those given by `setAll` and
   * `boxes` come in numerical order. You may set and delete boxes in the loop: boxes deleted before their turn are
   * skipped, and new ones are not visited. An id that is deleted and set again before its turn is visited. It copies
   * all ids.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(9, 0, 0, 1, 1).set(3, 0, 0, 1, 1).set(7, 0, 0, 1, 1).delete(9);
   * [...space.set(9, 5, 5, 6, 6).keys()]; // → [3, 7, 9]
   */
  keys(): IterableIterator<number>;

  [Symbol.iterator](): IterableIterator<[id: number, box: Float64Array]>;
}

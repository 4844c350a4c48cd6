// The pairs: of an update, what began and ended with it, and with another space.
import type { BroadPhase } from '../broad-phase.ts';
import type { Dimensions } from '../dimensions.ts';

/** The pairs: of an update, what began and ended with it, and with another space. */
export interface Pairs<D extends Dimensions> {
  /**
   * Finds the pairs of the boxes as they are now. Chainable.
   * @throws RangeError that names the first bad box written through `boxes()`; the pairs stay as they were
   * @throws Error if the array of `boxes()` was detached by growing memory and not requested again
   * @throws RangeError if memory runs out: the pairs are empty, and the space works again once it has fewer boxes
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15);
   * space.pairCount; // → 0
   * space.update().pairCount; // → 1
   */
  update(): this;

  /**
   * Each overlapping pair of ids once, `[a0, b0, a1, b1, …]` with a < b, as of the last update: boxes deleted since are
   * still in it. The order depends only on the calls made. A view of the kernel's memory: valid until the next
   * `update()`, or until adding many boxes at once, or thousands of queries in one call, makes memory grow; then its
   * length is 0. Adding a few boxes, or making queries one by one, does not invalidate it. Do not write to it: lookups and
   * the next events read it too.
   *
   * @example
   * const space = new BroadPhase();
   * const { pairs } = space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * for (let k = 0; k < pairs.length; k += 2) console.assert(pairs[k] < pairs[k + 1]);
   * pairs; // → Uint32Array [0, 1]
   */
  get pairs(): Uint32Array;

  /**
   * Each pair of `pairs`, `[a, b]`: for loops such as `for (const [a, b] of space.eachPair())`. Several times as slow
   * as a loop over `pairs`, and makes garbage for each pair. It iterates over a copy: you may change boxes, and update,
   * in the loop.
   *
   * @example
   * const space = new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * [...space.eachPair()]; // → [[0, 1]]
   */
  eachPair(): IterableIterator<[a: number, b: number]>;

  /**
   * The number of pairs as of the last update: half the length of `pairs`.
   *
   * @example
   * new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]).update().pairCount; // → 1
   */
  get pairCount(): number;

  /**
   * The pairs that the last update found and the previous one did not, in the form and order of `pairs`; requires
   * `events: true`. A view of the kernel's memory: valid as long as `pairs`.
   *
   * If a box is deleted, its pairs end with the next update. They also begin with it if the id was set again and
   * overlaps again, since it is another box. Boxes that `setAll`, `boxes` and `clear` remove count as deleted.
   *
   * @throws Error without `events: true`
   *
   * @example
   * const space = new BroadPhase({ events: true });
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15);
   * space.update().began; // → Uint32Array [7, 9]
   * space.update().began; // → Uint32Array []
   */
  get began(): Uint32Array;

  /**
   * The pairs that the previous update found and the last one did not, or whose boxes were deleted in between: see
   * {@link BroadPhase.began}. In the order that they had in `pairs`.
   *
   * @throws Error without `events: true`
   *
   * @example
   * const space = new BroadPhase({ events: true });
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
   * space.delete(9);
   * space.update().ended; // → Uint32Array [7, 9]
   */
  get ended(): Uint32Array;

  /**
   * Whether boxes `a` and `b` are a pair of the last update. Up to eight calls after an update look through all pairs; more
   * make a table first, and then take constant time.
   * @param a an integer from 0 to 2^24 - 1, in use or not; so is `b`
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
   * space.isColliding(9, 7); // → true
   * space.isColliding(7, 8); // → false
   */
  isColliding(a: number, b: number): boolean;

  /**
   * The ids of the boxes that are in a pair with box `id` as of the last update, in the order of `pairs`. Up to
   * eight calls after an update look through all pairs; more make a table first, and then take time proportional to the
   * answer.
   *
   * @param id an integer from 0 to 2^24 - 1, in use or not
   * @param out filled and returned, if given; otherwise a new array
   * @throws RangeError or TypeError for a bad id; TypeError if `out` is not an array
   *
   * @example
   * const space = new BroadPhase();
   * space.set(1, 0, 0, 10, 10).set(2, 5, 5, 15, 15).set(3, 9, 0, 12, 4).update();
   * space.collisionsOf(1).sort((a, b) => a - b); // → [2, 3]
   */
  collisionsOf(id: number, out?: number[]): number[];

  /**
   * Every pair of a box here and a box of another space, `[here0, there0, here1, there1, …]`, as of the last update of
   * each: for example of a level at rest and the things that move in it. The pairs are retained between calls, so a
   * call costs only what has changed. Filters and reaches count as between boxes of one space, boxes that are off are
   * in no pair, and static boxes and groups make no difference. The order depends on the calls made. The array stays as
   * it is until the next call. If tens of thousands of boxes move, the first call may detach views such as `pairs`.
   *
   * @param other a space with the same `dimensions`, `wrap` and `touching`, of the same entry point, imported from the
   *   same copy of the package
   * @throws TypeError for anything but another space; RangeError for one that differs in these; Error for one that was
   *   disposed, and as queries do: see {@link BroadPhase}
   *
   * @example
   * const level = new BroadPhase().set(0, 0, 0, 10, 1).set(1, 10, 0, 20, 1).update();
   * const movers = new BroadPhase().set(7, 9, 1, 11, 3).update();
   * movers.pairsWith(level); // → Uint32Array [7, 0, 7, 1]
   * movers.set(7, 5, 1, 6, 3).update().pairsWith(level); // → Uint32Array [7, 0]
   */
  pairsWith(other: BroadPhase<D>): Uint32Array;
}

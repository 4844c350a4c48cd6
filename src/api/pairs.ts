// The pairs: of an update, what began and ended with it, and with another space.
import type { BroadPhase } from '../broad-phase.ts';
import type { Dimensions } from '../dimensions.ts';

/** The pairs: of an update, what began and ended with it, and with another space. */
export interface Pairs<D extends Dimensions> {
  /**
   * Brings the pairs up to date with the boxes. Chainable.
   * @throws RangeError that names the first bad box written through `boxes()`; the pairs stay as they were
   * @throws Error where the array that `boxes()` gave has been cut off by growing memory and not been asked for again
   * @throws RangeError where memory ends: the pairs are empty, and the space works again once there are fewer
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15);
   * space.pairCount; // → 0
   * space.update().pairCount; // → 1
   */
  update(): this;

  /**
   * Each overlapping pair of ids once, `[a0, b0, a1, b1, …]` with a < b, as of the last update: boxes that were deleted
   * since are still named. The order
   * depends only on the calls made. A view of the kernel's memory: valid until the next `update()`, or until adding
   * many boxes at once makes memory grow; then its length is 0. There is room for some boxes, and for all questions.
   *
   * @example
   * const space = new BroadPhase();
   * const { pairs } = space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * for (let k = 0; k < pairs.length; k += 2) console.assert(pairs[k] < pairs[k + 1]);
   * pairs; // → Uint32Array [0, 1]
   */
  get pairs(): Uint32Array;

  /**
   * Each pair of `pairs`, `[a, b]`: to write `for (const [a, b] of space.eachPair())`. Several times as slow as a loop over
   * `pairs`, and makes garbage for each. Walks a copy: boxes may be changed, and updated, meanwhile.
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
   * The pairs that the last update found and the one before did not, as in `pairs` and in their order: with `events:
   * true` only. A view of the kernel's memory: valid as long as `pairs`.
   *
   * A pair whose box was deleted has ended with the next update, and has begun with it too where the id was set again
   * and overlaps again: it is another box. Boxes that `setAll`, `boxes` and `clear` take away were deleted.
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
   * The pairs that the update before the last found and the last did not, or whose boxes were deleted in between: see
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
   * Whether boxes `a` and `b` are a pair of the last update: constant time after the first question.
   * @param a an integer from 0 to 2^24 - 1, of a box or not; so is `b`
   * @throws RangeError for a bad id
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
   * space.isColliding(9, 7); // → true
   * space.isColliding(7, 8); // → false
   */
  isColliding(a: number, b: number): boolean;

  /**
   * The ids of the boxes that are in a pair with box `id` in the last update, in the order of `pairs`: takes time
   * proportional to the answer, after the first question.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box or not
   * @param out filled and returned, if given; else a new array
   * @throws RangeError for a bad id; TypeError where `out` is no array
   *
   * @example
   * const space = new BroadPhase();
   * space.set(1, 0, 0, 10, 10).set(2, 5, 5, 15, 15).set(3, 9, 0, 12, 4).update();
   * space.collisionsOf(1).sort((a, b) => a - b); // → [2, 3]
   */
  collisionsOf(id: number, out?: number[]): number[];

  /**
   * Every pair of a box here and a box of another space, `[here0, there0, here1, there1, …]`, as of the last update of
   * each: such as of a level at rest and of what moves in it. Kept from call to call, at the cost of what has changed since.
   * Filters and reaches count as between boxes of one space, boxes that are off are in no pair, and which are static or in
   * a group makes no difference. The order depends on the calls made. The array stays as it is until the next call.
   *
   * @param other a space of as many dimensions, and of the same `wrap` and `touching`
   * @throws TypeError for what is no other space; RangeError for one with another of these; Error for
   *   one that was disposed of, and as questions do: see {@link BroadPhase}
   *
   * @example
   * const level = new BroadPhase().set(0, 0, 0, 10, 1).set(1, 10, 0, 20, 1).update();
   * const movers = new BroadPhase().set(7, 9, 1, 11, 3).update();
   * movers.pairsWith(level); // → Uint32Array [7, 0, 7, 1]
   * movers.set(7, 5, 1, 6, 3).update().pairsWith(level); // → Uint32Array [7, 0]
   */
  pairsWith(other: BroadPhase<D>): Uint32Array;
}

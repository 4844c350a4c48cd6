// How broadphase/trace sees what stands in a space: a method under a registered symbol, since the two entries of the
// package are bundled apart and share nothing else.
import { boxesAt, doublesAt, groupsAt, idsAt, reachesAt, rulesAt } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';

/** What the options of a space say about pairs. */
export interface World {
  /** The size of the world along each axis, where it wraps around. */
  readonly wrap?: readonly number[] | undefined;
  /** Whether boxes that only touch are pairs. Left out: they are. */
  readonly touching?: boolean | undefined;
}

/** The key of the method of BroadPhase that sets its watcher, and gives its world. */
export const watch: unique symbol = Symbol.for('broadphase.watch') as never;

/** What boxes have of their own beside rules, one number each in the kernel's order: nothing where no box has one. */
export interface Own {
  /** The group of each box: two boxes of one are never a pair; 0 is none. */
  readonly groups?: Uint32Array | undefined;
  /** How far each box reaches: it is in a pair as if it were so much larger to all sides. */
  readonly reaches?: Float64Array | undefined;
}

/**
 * Called after each update with the boxes in the kernel's order, float32 where that holds all of them exactly; the id
 * of each, or nothing where the ids are 0, 1, 2, …; layer, mask and marks of each, or
 * nothing where no box was ever given such: 2 among the marks says that it is off, any other that it is static; and what
 * else boxes have of their own. All are views, valid during the call.
 */
export type Watcher = (
  boxes: Float32Array | Float64Array,
  ids: Uint32Array | undefined,
  rules: Uint32Array | undefined,
  own: Own,
) => void;

/** Shows a watcher what stands in a space. */
export function show(instance: KernelInstance, watcher: Watcher): void {
  instance.kernel.contents();
  const io = instance.io();
  const { size } = instance;
  const { buffer } = instance.kernel.memory;
  const length = size * instance.width;
  const words = (place: number, count: number) => (io[place] ? new Uint32Array(buffer, io[place], count) : undefined);
  const doubles = (place: number, count: number) =>
    io[place] ? new Float64Array(buffer, io[place], count) : undefined;
  watcher(
    doubles(doublesAt, length) ?? new Float32Array(buffer, io[boxesAt], length),
    words(idsAt, size),
    words(rulesAt, 3 * size),
    { groups: words(groupsAt, size), reaches: doubles(reachesAt, size) },
  );
}

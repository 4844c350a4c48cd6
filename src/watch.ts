// How broadphase/trace reads the contents of a space, and broadphase/shard its world: by a method of a fixed name, since
// the entry points are bundled separately and share nothing else.
import { badValue } from './errors.ts';
import { boxesAt, doublesAt, groupsAt, idsAt, reachesAt, rulesAt } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';

/** The options of a space that affect pairs. */
export interface World {
  /** The size of the world along each axis, if it wraps around. */
  readonly wrap?: readonly number[] | undefined;
  /** Whether boxes that only touch are pairs. Default true. */
  readonly touching?: boolean | undefined;
}

/** The name of the method of BroadPhase that sets its watcher, and gives its world. */
export const watch = '#watch';

/** Throws unless this is a space that was not disposed. */
export function checkSpace(where: string, space: unknown): void {
  const given = space as { [watch]?: unknown; size: number } | undefined | null;
  if (typeof given?.[watch] !== 'function') badValue(where, space, 'a BroadPhase', true);
  void given.size; // throws if it was disposed
}

/** Settings of boxes other than rules, one number for each box in the kernel's order; undefined if no box has one. */
export interface Own {
  /** The group of each box; 0: none. Two boxes of one group are never a pair. */
  readonly groups?: Uint32Array | undefined;
  /** The reach of each box: pairs are those of boxes enlarged by it on all sides. */
  readonly reaches?: Float64Array | undefined;
}

/**
 * Called after each update with the boxes in the kernel's order, as float32 if that represents all of them exactly;
 * their ids, or undefined if these are 0, 1, 2, …; layer, mask and marks of each, or undefined if no box has a rule
 * (mark 2: it is off; any other: it is static); and other settings. All are views, valid during the call.
 */
export type Watcher = (
  boxes: Float32Array | Float64Array,
  ids: Uint32Array | undefined,
  rules: Uint32Array | undefined,
  own: Own,
) => void;

/** Calls the watcher of a space, if any, with its contents. */
export function show(instance: KernelInstance): void {
  if (instance.watcher === undefined) return;
  instance.kernel.contents();
  const io = instance.io();
  const { size } = instance;
  const { buffer } = instance.kernel.memory;
  const length = size * instance.width;
  const words = (place: number, count: number) => (io[place] ? new Uint32Array(buffer, io[place], count) : undefined);
  const doubles = (place: number, count: number) =>
    io[place] ? new Float64Array(buffer, io[place], count) : undefined;
  instance.watcher(
    doubles(doublesAt, length) ?? new Float32Array(buffer, io[boxesAt], length),
    words(idsAt, size),
    words(rulesAt, 3 * size),
    { groups: words(groupsAt, size), reaches: doubles(reachesAt, size) },
  );
}

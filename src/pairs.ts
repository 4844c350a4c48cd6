// Updates, and views of the pairs that they find, in the kernel's memory.
import { badInPlace, checkExposed } from './boxes.ts';
import { addressStat, pairsStat } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { readStats } from './stats.ts';

/** Finds the pairs of the present boxes, and updates the counters if there are any. */
export function update(instance: KernelInstance, where = 'update'): void {
  checkExposed(instance, where);
  let bad = -1;
  try {
    bad = instance.ring.update();
  } catch (error) {
    try {
      instance.recover(error, where);
    } finally {
      readStats(instance);
    }
  }
  if (bad >= 0) badInPlace(instance, where, bad);
  instance.exposedIsOpen = false;
  readStats(instance);
}

// The three lists of pairs.
export const began = 0;
export const ended = 1;
const all = 2;

export function pairsIn(instance: KernelInstance): Uint32Array {
  const stats = instance.statsView();
  return instance.pairView(all, stats[addressStat]!, stats[pairsStat]!);
}

export const pairCount = (instance: KernelInstance): number => instance.statsView()[pairsStat]!;

/** The pairs that began with the last update, or those that ended. */
export function eventsIn(instance: KernelInstance, list: typeof began | typeof ended): Uint32Array {
  if (!instance.events) noEvents(list === began ? 'began' : 'ended');
  return instance.pairView(list, instance.exports.events(list), instance.io()[0]!);
}

export function* eachPair(pairs: Uint32Array): IterableIterator<[a: number, b: number]> {
  for (let k = 0; k < pairs.length; k += 2) yield [pairs[k]!, pairs[k + 1]!];
}

function noEvents(what: string): never {
  throw new Error(`${what}: this space records no events, expected one made with new BroadPhase({ events: true })`);
}

// Updates, and views of the pairs that they find, in the kernel's memory.
import { badInPlace, checkExposed } from './boxes.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { readStats, type Stats } from './stats.ts';

/** Finds the pairs of the present boxes, and updates the counters. */
export function update(instance: KernelInstance, stats: Stats, where = 'update'): void {
  checkExposed(instance, where);
  let bad = -1;
  try {
    bad = instance.kernel.update();
  } catch (error) {
    try {
      instance.recover(error, where);
    } finally {
      readStats(instance, stats);
    }
  }
  if (bad >= 0) badInPlace(instance, where, bad);
  instance.exposedIsOpen = false;
  readStats(instance, stats);
}

// The three lists of pairs.
const all = 0;
const began = 1;
const ended = 2;

export function pairsIn(instance: KernelInstance): Uint32Array {
  const { kernel } = instance;
  return instance.pairView(all, kernel.pairs_address(), kernel.pair_count());
}

export function beganIn(instance: KernelInstance): Uint32Array {
  if (!instance.events) noEvents('began');
  const { kernel } = instance;
  return instance.pairView(began, kernel.began_address(), kernel.began_count());
}

export function endedIn(instance: KernelInstance): Uint32Array {
  if (!instance.events) noEvents('ended');
  const { kernel } = instance;
  return instance.pairView(ended, kernel.ended_address(), kernel.ended_count());
}

export function* eachPair(pairs: Uint32Array): IterableIterator<[a: number, b: number]> {
  for (let k = 0; k < pairs.length; k += 2) yield [pairs[k]!, pairs[k + 1]!];
}

function noEvents(what: string): never {
  throw new Error(`${what}: this space records no events, expected one made with new BroadPhase({ events: true })`);
}

// `set` with its numbers in an array of any length: the types of `set` itself allow only the right number of them.
import type { BroadPhase } from 'broadphase';

export function setBox(space: BroadPhase<2 | 3>, id: number, box: readonly unknown[]): BroadPhase<2 | 3> {
  return (space.set as (...values: unknown[]) => BroadPhase).call(space, id, ...box);
}

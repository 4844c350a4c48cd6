// What one zone tells another at an exchange.
import { badBox, badValue } from '../errors.ts';

/**
 * What changed for one zone among the boxes that another owned, as typed arrays to send as they are. Deltas of one zone
 * have to arrive in the order in which they were made, and none may get lost.
 */
export interface Delta {
  /** The zone that tells. */
  from: number;
  /** The zone that is told. */
  to: number;
  /** The boxes to which something happened. */
  ids: Uint32Array;
  /** For each id bits of what happened: 1 enters, 2 leaves, 4 is owned from now on, 8 added, 16 gone; 0: it moved. */
  changes: Uint8Array;
  /** For each id its box, unless it is gone; behind it the box as of the update before, if it enters and was not added. */
  boxes: Float64Array;
}

/** The bits. */
export const Change = { enters: 1, leaves: 2, owned: 4, added: 8, gone: 16 } as const;

/** What is told of one box: its bits, and its boxes as a delta has them. */
export interface Told {
  id: number;
  change: number;
  boxes: readonly (readonly number[])[];
}

export const pack = (from: number, to: number, told: readonly Told[]): Delta => ({
  from,
  to,
  ids: Uint32Array.from(told, ({ id }) => id),
  changes: Uint8Array.from(told, ({ change }) => change),
  boxes: Float64Array.from(told.flatMap(({ boxes }) => boxes.flat())),
});

/** Throws for what is no delta for this zone: it comes from elsewhere, over a network. */
export function unpack({ to, ids, changes, boxes }: Delta, zone: number, dimensions: 2 | 3): Told[] {
  if (to !== zone) badValue('update: delta.to', to, `${zone}, this zone`);
  if (changes.length !== ids.length)
    badValue('update: delta.changes.length', changes.length, `${ids.length}, as of ids`);
  let at = 0;
  const next = (id: number) => {
    const box = Array.from(boxes.subarray(at, at + 2 * dimensions));
    at += 2 * dimensions;
    for (let a = 0; a < dimensions; a++) {
      if (!(box[a] <= box[a + dimensions])) badBox('update: delta.boxes', id, box, dimensions);
    }
    return box;
  };
  const told = Array.from(ids, (id, k) => {
    const change = changes[k];
    const count = change & Change.gone ? 0 : change & Change.enters && !(change & Change.added) ? 2 : 1;
    return { id, change, boxes: Array.from({ length: count }, () => next(id)) };
  });
  if (at !== boxes.length) badValue('update: delta.boxes.length', boxes.length, `${at}`);
  return told;
}

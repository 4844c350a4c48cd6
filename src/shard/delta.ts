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

/** Collects what one zone is told. */
export class DeltaWriter {
  readonly #ids: number[] = [];
  readonly #changes: number[] = [];
  readonly #boxes: number[] = [];

  add(id: number, change: number, box?: readonly number[], before?: readonly number[]): void {
    this.#ids.push(id);
    this.#changes.push(change);
    if (box) for (const value of box) this.#boxes.push(value);
    if (before) for (const value of before) this.#boxes.push(value);
  }

  get size(): number {
    return this.#ids.length;
  }

  /** What was collected; the writer is empty after it. */
  take(from: number, to: number): Delta {
    const delta: Delta = {
      from,
      to,
      ids: Uint32Array.from(this.#ids),
      changes: Uint8Array.from(this.#changes),
      boxes: Float64Array.from(this.#boxes),
    };
    this.#ids.length = this.#changes.length = this.#boxes.length = 0;
    return delta;
  }
}

/** Throws for what is no delta for this zone: it comes from elsewhere, over a network. */
export function checkDelta({ to, ids, changes, boxes }: Delta, zone: number, dimensions: 2 | 3): void {
  if (to !== zone) badValue('update: delta.to', to, `${zone}, this zone`);
  if (changes.length !== ids.length)
    badValue('update: delta.changes.length', changes.length, `${ids.length}, as of ids`);
  const width = 2 * dimensions;
  let at = 0;
  for (const [k, change] of changes.entries()) {
    const count = change & Change.gone ? 0 : change & Change.enters && !(change & Change.added) ? 2 : 1;
    for (const end = at + count * width; at < end; at += width) {
      const box = boxes.subarray(at, at + width);
      for (let a = 0; a < dimensions; a++) {
        if (!(box[a] <= box[a + dimensions])) badBox('update: delta.boxes', ids[k], box, dimensions);
      }
    }
  }
  if (at !== boxes.length) badValue('update: delta.boxes.length', boxes.length, `${at}`);
}

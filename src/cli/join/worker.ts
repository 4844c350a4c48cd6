// Finds the pairs of one tile after another, in a thread of its own. It reuses one space, and so its memory.
import { parentPort, workerData } from 'node:worker_threads';
import { BroadPhase } from 'broadphase';

/** Marks a thread of the command as a worker of the join. */
export const workerMark = 'broadphase join';

/** A tile to search. */
export interface Tile {
  /** Row numbers. */
  rows: Float64Array;
  /** Boxes, interleaved. */
  boxes: Float64Array;
  /** Per box 0 for red, 1 for blue, if only pairs of both colours are wanted; else undefined. */
  colours: Uint8Array | undefined;
  /** The tile's axis, where it begins along it, and before what it ends. */
  axis: number;
  from: number;
  /** NaN: it is unbounded. */
  to: number;
}

/** The most pairs in a message: each is two numbers. */
const pairsPerMessage = 2 ** 17;

/** A message of the result; the last one is marked. */
export interface Found {
  first: Float64Array;
  second: Float64Array;
  last: boolean;
}

export function serve(): void {
  const port = parentPort!;
  const space = new BroadPhase({ dimensions: workerData.dimensions });
  let found: Generator<Found> | undefined;
  port.on('message', (tile: Tile | 'more') => {
    if (tile !== 'more') found = search(space, tile);
    const { value } = found!.next();
    port.postMessage(value, [value.first.buffer, value.second.buffer]);
  });
}

/** The pairs that this tile reports, split into messages. */
export function* search(space: BroadPhase, { rows, boxes, colours, axis, from, to }: Tile): Generator<Found> {
  space.setAll(boxes);
  colours?.forEach((colour, k) => {
    space.setFilter(k, 1 << colour, 2 >> colour);
  });
  const { pairs } = space.update();
  const width = 2 * space.dimensions;
  let [first, second, count] = [new Float64Array(pairsPerMessage), new Float64Array(pairsPerMessage), 0];
  for (let k = 0; k < pairs.length; k += 2) {
    const [a, b] = [pairs[k], pairs[k + 1]];
    const corner = Math.max(boxes[a * width + axis], boxes[b * width + axis]);
    if (corner < from || corner >= to) continue;
    const swap = colours ? colours[a] === 1 : rows[a] > rows[b];
    first[count] = rows[swap ? b : a];
    second[count++] = rows[swap ? a : b];
    if (count < pairsPerMessage) continue;
    yield { first, second, last: false };
    [first, second, count] = [new Float64Array(pairsPerMessage), new Float64Array(pairsPerMessage), 0];
  }
  yield { first: first.slice(0, count), second: second.slice(0, count), last: true };
}

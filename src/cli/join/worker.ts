// Finds the pairs of one tile after another, in a thread of its own. It keeps one space, so that its memory is used again.
import { parentPort, workerData } from 'node:worker_threads';
import { BroadPhase } from 'broadphase';

/** What makes a thread of the command one of these. */
export const workerMark = 'broadphase join';

/** A tile to search. */
export interface Tile {
  /** Row numbers. */
  rows: Float64Array;
  /** Boxes, interleaved. */
  boxes: Float64Array;
  /** For each 0 if it is red, 1 if it is blue, where red ones are to meet blue ones; else undefined. */
  colours: Uint8Array | undefined;
  /** Along this axis the tile begins at one number and ends before the other. */
  axis: number;
  from: number;
  /** NaN: it has no end. */
  to: number;
}

/** Pairs at most that are sent at once: each is two numbers. */
const pairsPerMessage = 2 ** 17;

/** What comes back, message by message; the last one is marked. */
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

/** The pairs that this tile reports, a message's worth at a time. */
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

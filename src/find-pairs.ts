// One-shot search: pairs of an array of boxes, or between two, without keeping anything.
// A call with no options but `dimensions` reuses a spare space, since creating one costs many times as much as a search
// among a few boxes. A spare space is reset to its initial state, so that the order of pairs does not depend on earlier
// calls.
import { type Boxes, checkNumbers, checkValues, countBoxes, setAll } from './boxes.ts';
import type { Dimensions } from './dimensions.ts';
import { checkNumberArray } from './errors.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { builtDimensions } from './kernel/load.ts';
import { type BroadPhaseOptions, checkNames, open } from './options.ts';
import { pairsIn, update } from './pairs.ts';
import { isFloat32Array } from './values.ts';

/** Spare spaces by dimensions. A space in use is not in here, since a getter in the caller's array may call again. */
const spares: (KernelInstance | undefined)[] = [];

/** A space that has used more bytes of memory than this is not kept, since touched memory is not returned. */
const mostBytes = 64 * 2 ** 20;

/** A space with these options: the spare one of `spared` dimensions, if there is one, else a new one. */
function borrow(spared: Dimensions | 0, options?: BroadPhaseOptions<Dimensions>): KernelInstance {
  const spare = spares[spared];
  if (spare === undefined) return open(options);
  spares[spared] = undefined;
  return spare;
}

/** Keeps the space for the next call, if it may be spared. If a call throws, its space is dropped. */
function giveBack(space: KernelInstance, spared: Dimensions | 0): void {
  if (spared === 0) return;
  space.ring.forget();
  if (space.kernel.begin_anew() >>> 0 <= mostBytes) spares[spared] = space;
}

/**
 * The dimensions of the spare space that will do: those in the options, or 0 if there are other options too. Read once,
 * as a getter may change the options.
 */
function spareFor(where: string, options?: BroadPhaseOptions<Dimensions>): Dimensions | 0 {
  checkNames(where, options);
  if (options === undefined) return builtDimensions[0]!;
  for (const name in options) if (name !== 'dimensions') return 0;
  const { dimensions } = options;
  return builtDimensions.includes(dimensions!) ? dimensions! : 0;
}

/**
 * Every overlapping pair of an array of boxes, once: `[a0, b0, a1, b1, …]` with a < b, indices into the array. For
 * boxes that move, a {@link BroadPhase} is faster. Up to 64 MiB of memory stay allocated for the next call. With options
 * other than `dimensions`, each call creates a space: for many small searches, keep one, and call its `setAll`.
 *
 * @param boxes interleaved: minX, minY, maxX, maxY (3D: minX, minY, minZ, maxX, maxY, maxZ), box after box
 * @param options those of {@link BroadPhase}: `dimensions: 3` for boxes of six numbers
 * @returns a new array, independent of later calls
 * @throws RangeError or TypeError that names the first bad box or option
 *
 * @example
 * findPairs([0, 0, 10, 10, 5, 5, 15, 15]); // → Uint32Array [0, 1]
 */
export function findPairs(boxes: Boxes, options?: BroadPhaseOptions<Dimensions>): Uint32Array {
  const spared = spareFor('findPairs', options);
  const space = borrow(spared, options);
  setAll(space, boxes, undefined, 'findPairs');
  const pairs = search(space, 'findPairs');
  giveBack(space, spared);
  return pairs;
}

/**
 * Every pair of a red and a blue box that overlap, once: `[red0, blue0, red1, blue1, …]`, indices into each array.
 *
 * @param red interleaved boxes, as for {@link findPairs}
 * @param blue the same; the two together at most 2^24 boxes
 * @param options those of {@link BroadPhase}: `dimensions: 3` for boxes of six numbers
 * @returns a new array, independent of later calls
 * @throws RangeError or TypeError that names the first bad box by its array and index there, or the option
 *
 * @example
 * const players = [0, 0, 10, 10];
 * const coins = [5, 5, 15, 15, 20, 20, 30, 30];
 * findPairsBetween(players, coins); // → Uint32Array [0, 0]
 */
export function findPairsBetween(red: Boxes, blue: Boxes, options?: BroadPhaseOptions<Dimensions>): Uint32Array {
  const spared = spareFor('findPairsBetween', options);
  const space = borrow(spared, options);
  const { dimensions } = space;
  const reds = count('findPairsBetween: red', red, dimensions);
  const blues = count('findPairsBetween: blue', blue, dimensions);
  try {
    setAll(space, join(red, blue), undefined, 'findPairsBetween');
  } catch (error) {
    // A bad box is named by its index in the caller's array, not in the joined one.
    checkValues('findPairsBetween: red', red, reds, dimensions);
    checkValues('findPairsBetween: blue', blue, blues, dimensions);
    throw error;
  }
  split(space, reds);
  const pairs = search(space, 'findPairsBetween');
  giveBack(space, spared);
  for (let k = 1; k < pairs.length; k += 2) pairs[k]! -= reds;
  return pairs;
}

/** The pairs of the boxes in a space, as an independent array. */
function search(space: KernelInstance, where: string): Uint32Array {
  update(space, where);
  return pairsIn(space).slice();
}

/** Boxes 0 … red - 1 become red, the others blue; only pairs of both colours are reported. */
function split(space: KernelInstance, red: number): void {
  try {
    space.kernel.split(red);
  } catch (error) {
    space.recover(error, 'findPairsBetween');
  }
}

/** The number of boxes in an array of numbers. */
function count(where: string, boxes: Boxes, dimensions: Dimensions): number {
  checkNumberArray(where, boxes);
  const boxCount = countBoxes(where, boxes, dimensions);
  if (Array.isArray(boxes)) checkNumbers(where, boxes, boxCount, dimensions); // joining would convert other values
  return boxCount;
}

/** Both arrays as one, in double precision unless both are float32. */
function join(red: Boxes, blue: Boxes): Boxes {
  const single = isFloat32Array(red) && isFloat32Array(blue);
  const joined = new (single ? Float32Array : Float64Array)(red.length + blue.length);
  joined.set(red);
  joined.set(blue, red.length);
  return joined;
}

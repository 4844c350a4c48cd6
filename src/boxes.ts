// Boxes given as an array: copied into the kernel's memory, or written there in place.
import type { Dimensions } from './dimensions.ts';
import { badBox, badValue, checkBoxCount, checkNumberArray, isBoxCount } from './errors.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { isFloat32Array, isFloat64Array } from './values.ts';

/** Boxes in one array, such as for {@link BroadPhase.setAll}: the minima, then the maxima, box after box. */
export type Boxes = Float32Array | Float64Array | readonly number[];

/** Replaces all boxes. `where` is the name of the call in errors. */
export function setAll(instance: KernelInstance, boxes: Boxes, count: number | undefined, where = 'setAll'): void {
  const { width, dimensions } = instance;
  const single = isFloat32Array(boxes);
  checkNumberArray(where, boxes);
  if (count === undefined) count = countBoxes(where, boxes, dimensions);
  const { length } = boxes;
  // The text is made only after the test: a string in each call would be garbage.
  if (!isBoxCount(count)) checkBoxCount(`${where}: count`, count);
  if (count * width > length) {
    badValue(`${where}: count`, count, `at most ${Math.floor(length / width)}, as ${length} numbers were given`);
  }
  if (Array.isArray(boxes)) checkNumbers(where, boxes, count, dimensions); // typed arrays hold nothing else
  // The kernel checks values, but making room for them there may detach what boxes() returned.
  if (instance.exposed !== undefined) checkValues(where, boxes, count, dimensions);
  try {
    const { kernel } = instance;
    const at = (single ? kernel.stage(count) : kernel.stage_exact(count)) >>> 0;
    const view = instance.stagedView(at, count * width, single);
    instance.copyIn(where, view, 0, boxes, count * width);
    const { replace } = instance.kernel; // takes what a getter has set
    instance.ring.forget();
    const bad = replace(count, single ? 0 : 1);
    if (bad >= 0) badBox(where, bad, view.slice(bad * width, (bad + 1) * width), dimensions);
  } catch (error) {
    instance.recover(error, where);
  }
  instance.exposed = undefined;
}

/** The kernel's own memory for the boxes of ids 0 … count - 1, to be written in place. */
export function expose(instance: KernelInstance, count: number): Float32Array {
  checkBoxCount('boxes: count', count);
  try {
    const { kernel } = instance;
    instance.ring.forget();
    const at = kernel.expose(count) >>> 0;
    const length = count * instance.width;
    let view = instance.exposed;
    if (view?.byteOffset !== at || view.length !== length) {
      view = new Float32Array(kernel.memory.buffer, at, length);
      instance.exposed = view;
    }
    instance.exposedIsOpen = true;
    return view;
  } catch (error) {
    instance.recover(error, 'boxes');
  }
}

/** Throws if the array that boxes() returned was detached: it may have been written to since. */
export function checkExposed(instance: KernelInstance, where: string): void {
  if (instance.exposed?.byteOffset !== 0) return; // the offset is 0 only for detached views
  throw new Error(
    `${where}: the array of boxes() was detached when memory grew, and writes since are lost: ` +
      'call boxes(count) again before you write',
  );
}

/** Writes the numbers of a box to an array; false if there is no box of this id. */
export function readBox(instance: KernelInstance, id: number, out: Float32Array | Float64Array | number[]): boolean {
  const fits = (isFloat64Array(out) || isFloat32Array(out)) && out.length >= instance.width;
  if (!fits && !Array.isArray(out)) {
    badValue('get: out', out, `an array, or a Float64Array or Float32Array of ${instance.width} numbers`, true);
  }
  if (instance.reader.get(id) === 0) return false;
  const io = instance.io();
  for (let k = 0; k < instance.width; k++) out[k] = io[k]!;
  return true;
}

/** Reports a bad box that was written in place. */
export function badInPlace(instance: KernelInstance, where: string, id: number): never {
  const box = new Float32Array(instance.width);
  readBox(instance, id, box);
  badBox(where, id, box, instance.dimensions);
}

export const hasBox = (instance: KernelInstance, id: number): boolean =>
  instance.ring.knows(id) || instance.reader.has(id) === 1;

/** The ids of all present boxes, except those that are deleted before their turn. */
export const present = (instance: KernelInstance): IterableIterator<number> => stillThere(instance, listIds(instance));

function* stillThere(instance: KernelInstance, ids: Uint32Array): IterableIterator<number> {
  for (const id of ids) if (hasBox(instance, id)) yield id;
}

/** A copy of all ids, in the order in which they were added. */
function listIds(instance: KernelInstance): Uint32Array {
  try {
    const { kernel } = instance;
    const count = kernel.list_ids();
    return new Uint32Array(kernel.memory.buffer, kernel.answers_address() >>> 0, count).slice();
  } catch (error) {
    instance.recover(error, 'keys');
  }
}

/** The number of boxes in an array; throws if it is not a whole number. */
export function countBoxes(where: string, boxes: Boxes, dimensions: Dimensions): number {
  const width = 2 * dimensions;
  if (boxes.length % width !== 0) {
    badValue(`${where}: length`, boxes.length, `a multiple of ${width}: a flat array of ${dimensions}D boxes`);
  }
  return (boxes.length / width) | 0; // as an integer: a double returned from a call would be garbage
}

/** Checks that the elements of the first `count` boxes are numbers; the kernel checks their values. */
export function checkNumbers(where: string, boxes: ArrayLike<unknown>, count: number, dimensions: Dimensions): void {
  const width = 2 * dimensions;
  for (let k = 0; k < count * width; k++) {
    if (typeof boxes[k] !== 'number') badBoxOf(where, boxes, Math.floor(k / width), dimensions);
  }
}

/** Checks their values. */
export function checkValues(where: string, boxes: Boxes, count: number, dimensions: Dimensions): void {
  for (let k = 0; k < 2 * dimensions * count; k += k % dimensions === dimensions - 1 ? dimensions + 1 : 1) {
    if (!(boxes[k]! <= boxes[k + dimensions]!)) badBoxOf(where, boxes, Math.floor(k / 2 / dimensions), dimensions);
  }
}

function badBoxOf(where: string, boxes: ArrayLike<unknown>, id: number, dimensions: Dimensions): never {
  const at = 2 * dimensions * id;
  badBox(where, id, Array.prototype.slice.call(boxes, at, at + 2 * dimensions), dimensions);
}

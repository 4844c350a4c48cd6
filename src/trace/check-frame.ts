// Checks of a frame that somebody made, before it is written or played: they name what is wrong, and change nothing.
import { badValue, isFinitePositive } from '../errors.ts';
import { isFloat64Array, isTypedArray } from '../values.ts';
import { checkBoxes, checkLength, type Frame, maxBoxes } from './format.ts';
import type { IdSet } from './state.ts';

/** Whether boxes are doubles; throws unless they are that or float32. */
export function isDoubles(where: string, boxes: unknown): boolean {
  const doubles = isFloat64Array(boxes);
  if (!doubles) checkKind(`${where}: boxes`, boxes, 'Float32Array');
  return doubles;
}

/** The arrays of a frame; ids may be in any kind of array. */
type Arrays = Pick<Frame, 'boxes' | 'rules' | 'groups' | 'reaches'> & { ids?: ArrayLike<number> | undefined };

/** Throws unless a frame has `count` boxes, and as many ids, rules, groups and reaches, or none, all of them valid. */
export function checkFrame(where: string, dimensions: 2 | 3, count: number, frame: Arrays, seen: IdSet): void {
  checkLength(`${where}: boxes`, frame.boxes, 2 * dimensions * count);
  checkBoxes(where, frame.boxes, dimensions);
  if (frame.ids) checkIds(where, frame.ids, count, seen);
  checkEach(`${where}: rules`, frame.rules, 'Uint32Array', 3 * count);
  checkEach(`${where}: groups`, frame.groups, 'Uint32Array', count);
  checkEach(`${where}: reaches`, frame.reaches, 'Float64Array', count);
  for (const reach of frame.reaches ?? []) {
    if (!isFinitePositive(reach, 0)) badValue(`${where}: reaches`, reach, 'finite numbers, 0 or more');
  }
}

function checkKind(what: string, numbers: unknown, kind: string): void {
  if (!isTypedArray(numbers, kind)) badValue(what, numbers, `a ${kind}`, true);
}

/** Checks the kind and the length of an array, if there is one. */
function checkEach(what: string, numbers: ArrayLike<number> | undefined, kind: string, length: number): void {
  if (numbers === undefined) return;
  checkKind(what, numbers, kind);
  checkLength(what, numbers, length);
}

function checkIds(where: string, ids: ArrayLike<number>, count: number, seen: IdSet): void {
  checkLength(`${where}: ids`, ids, count);
  seen.clear();
  for (let k = 0; k < count; k++) {
    const id = ids[k];
    if (!(Number.isInteger(id) && id >= 0 && id < maxBoxes)) {
      throw new RangeError(`${where}: an id is ${id}, expected an integer from 0 to ${maxBoxes - 1}`);
    }
    if (!seen.add(id)) throw new RangeError(`${where}: id ${id} appears twice`);
  }
}

// Checks of input, one function per kind, and the errors that they throw: these name the call, the value, and what was
// expected. A call checks its input before it changes anything.

import { isAttached, isFloat32Array, isFloat64Array } from './values.ts';

/** Ids are integers from 0 to this. */
export const maxId = 2 ** 24 - 1;

/** The numbers of a box. */
export const corners = {
  2: ['minX', 'minY', 'maxX', 'maxY'],
  3: ['minX', 'minY', 'minZ', 'maxX', 'maxY', 'maxZ'],
} as const;

/** The numbers of a box by its centre. */
const centred = {
  2: ['x', 'y', 'halfWidth', 'halfHeight'],
  3: ['x', 'y', 'z', 'halfWidth', 'halfHeight', 'halfDepth'],
} as const;

/** The numbers of a moving box. */
export const sweep2 = [...corners[2], 'dx', 'dy'];
export const sweep3 = [...corners[3], 'dx', 'dy', 'dz'];

/** A value as a person would write it. */
export function show(value: unknown, depth = 0): string {
  if (typeof value === 'string') return JSON.stringify(value.length > 80 ? `${value.slice(0, 80)}…` : value);
  if (typeof value === 'bigint') return `${value}n`;
  try {
    if (Array.isArray(value) && depth < 2) {
      const shown = value.slice(0, 8).map((each) => show(each, depth + 1));
      return `[${shown.join(', ')}${value.length > 8 ? ', …' : ''}]`;
    }
    if (value && typeof value === 'object') return Object.prototype.toString.call(value);
    return Object.is(value, -0) ? '-0' : String(value);
  } catch {
    return `a hostile ${typeof value}`; // such as a revoked Proxy
  }
}

/** Whether it is an integer in range. */
export const isId = (id: unknown): id is number => typeof id === 'number' && id >>> 0 === id && id <= maxId;

export function checkId(where: string, id: unknown): asserts id is number {
  if (!isId(id)) badId(where, id);
}

/** An id that is no integer in range. */
export function badId(where: string, id: unknown): never {
  const message = `${where}: the id is ${show(id)}, expected an integer from 0 to ${maxId}`;
  throw typeof id === 'number' ? new RangeError(message) : new TypeError(message);
}

/** An id without a box, where there must be one. */
export function noBox(where: string, id: number): never {
  throw new RangeError(`${where}: there is no box ${id}, expected the id of a box: call set first`);
}

/** A bad box: says which of its numbers is wrong. */
export function badBox(where: string, id: number, box: ArrayLike<unknown>, dimensions: 2 | 3): never {
  const names = corners[dimensions];
  for (let k = 0; k < names.length; k++) {
    const value = box[k];
    if (typeof value !== 'number') {
      throw new TypeError(`${where}: ${names[k]} of box ${id} is ${show(value)}, expected a number`);
    }
    if (Number.isNaN(value)) throw new RangeError(`${where}: ${names[k]} of box ${id} is NaN, expected a number`);
  }
  for (let a = 0; ; a++) {
    const low = box[a] as number;
    const high = box[a + dimensions] as number;
    if (low <= high) continue;
    throw new RangeError(
      `${where}: box ${id} has ${names[a]} ${low} above ${names[a + dimensions]} ${high}, expected minima not above maxima`,
    );
  }
}

/** The id of a box, and the number of arguments of the call that sets it. */
function checkCount(
  where: string,
  id: unknown,
  got: number,
  dimensions: 2 | 3,
  names: readonly string[] = corners[dimensions],
): asserts id is number {
  checkId(where, id);
  if (got === 1 + names.length) return;
  throw new TypeError(
    `${where}: got ${got} arguments for box ${id}, expected ${1 + names.length} in ${dimensions}D: id, ${names.join(', ')}`,
  );
}

/** The space whose method got bad arguments: see `BroadPhase.set` for why these are passed on by `apply`. */
interface OfDimensions {
  dimensions: 2 | 3;
}

/** A bad box by centre and half size: says which of its numbers is wrong. */
export function badCentred(this: OfDimensions, ...all: unknown[]): never {
  const { dimensions } = this;
  const [id, ...given] = all;
  const where = 'setCentred';
  const names = centred[dimensions];
  checkCount(where, id, all.length, dimensions, names);
  const of = ` of box ${id}`;
  for (let k: number = dimensions; k < names.length; k++) checkDistance(`${where}: ${names[k]}${of}`, given[k]);
  badQuery(where, given, names.slice(0, dimensions), 'a finite number', of);
}

/** Any other argument or option. */
export function badValue(where: string, value: unknown, expected: string, wrongType = false): never {
  const message = `${where}: got ${show(value)}, expected ${expected}`;
  throw wrongType ? new TypeError(message) : new RangeError(message);
}

/** An argument or option that must be a number of some kind. */
export function badNumber(where: string, value: unknown, expected: string): never {
  badValue(where, value, expected, typeof value !== 'number');
}

/** Whether a value is a finite number above 0, or 0 if that is allowed. */
export const isFinitePositive = (value: unknown, least = Number.MIN_VALUE): value is number =>
  Number.isFinite(value) && Number(value) >= least;

export function checkBoolean(what: string, value: unknown): asserts value is boolean {
  if (typeof value !== 'boolean') badValue(what, value, 'true or false', true);
}

export const isBoxCount = (count: unknown): boolean =>
  Number.isInteger(count) && Number(count) >= 0 && Number(count) <= maxId + 1;

// Made once: a string in each call would be garbage in each frame.
const boxCounts = `an integer from 0 to ${maxId + 1}`;

export function checkBoxCount(what: string, count: unknown): void {
  if (!isBoxCount(count)) badNumber(what, count, boxCounts);
}

/** Refuses an array whose memory is gone. */
export function checkAttached(where: string, array: ArrayLike<number> & ArrayBufferView): void {
  if (array.length > 0 || isAttached(array)) return;
  throw new TypeError(`${where}: got a detached array: its memory was transferred or resized`);
}

/** Numbers come in one of three kinds of array. */
export function checkNumberArray(where: string, numbers: unknown): void {
  if (isFloat32Array(numbers) || isFloat64Array(numbers)) checkAttached(where, numbers);
  else if (!Array.isArray(numbers))
    badValue(where, numbers, 'a Float32Array, a Float64Array or an array of numbers', true);
}

/** Whether the arguments are a good id and a good box. */
export function checkBox(where: string, id: number, box: readonly number[], dimensions: 2 | 3): void {
  checkCount(where, id, 1 + box.length, dimensions);
  let good = box.every((value) => typeof value === 'number');
  for (let k = 0; k < dimensions; k++) good &&= box[k]! <= box[k + dimensions]!;
  if (!good) badBox(where, id, box, dimensions);
}

/** The size of a world that wraps around. */
export function checkWrap(wrap: readonly number[], dimensions: 2 | 3): void {
  const expected = `${dimensions} numbers above 0 and no more than 1e300`;
  if (!Array.isArray(wrap)) badValue('wrap', wrap, expected, true);
  let good = wrap.length === dimensions;
  for (const size of wrap) good &&= typeof size === 'number' && size > 0 && size <= 1e300; // also visits holes
  if (!good) badValue('wrap', wrap, expected);
}

/** Layers and masks are 32 bits. */
export function checkBits(where: string, bits: unknown): void {
  if (typeof bits !== 'number') badValue(where, bits, 'an integer from 0 to 4294967295', true);
  if (bits >>> 0 === bits) return;
  badValue(where, bits, `an integer from 0 to 4294967295${bits < 0 ? ' (of signed bits, write bits >>> 0)' : ''}`);
}

/** An array to write answers to: the given one, or a new one. */
export function checkOut<Out extends unknown[]>(where: string, out = [] as unknown[] as Out): Out {
  if (!Array.isArray(out)) badValue(`${where}: out`, out, 'an ordinary array', true);
  return out;
}

/** Whether a hit can be written to it. */
export const isHit = (out: unknown): boolean => Array.isArray((out as { normal?: unknown } | null | undefined)?.normal);

/** Reports an object that a hit cannot be written to: `time` or `distance` is its number. */
export function badHit(where: string, out: unknown, far: 'distance' | 'time'): never {
  badValue(where, out, `an object { id: 0, ${far}: 0, normal: [] }`, true);
}

/** Checks an object of options: all must be known, except undefined ones. */
export function checkOptions(where: string, options: unknown, known: readonly string[]): void {
  if (options === undefined) return;
  // Neither an array, nor a Map, nor a space.
  if (!options || typeof options !== 'object' || Symbol.iterator in options) {
    badValue(where, options, 'an object of options', true);
  }
  for (const name in options) {
    // Scripts may extend all objects: that is no option, nor is one without a value.
    if (known.includes(name) || options[name as never] === {}[name as never]) continue;
    const [nearest = ''] = [...known].sort((a, b) => edits(name, a) - edits(name, b));
    const isClose = name.includes(nearest) || edits(name, nearest) < 0.35 * Math.max(name.length, nearest.length);
    const meant = isClose ? `did you mean ${show(nearest)}? T` : 't';
    throw new TypeError(`${where}: there is no option ${show(name)}, ${meant}here are ${known.join(', ')}`);
  }
}

/** A wrong number is reported before a missing one. */
const leftOut = 0.4;

/** The edit distance of two words: letters changed, inserted or left out. */
function edits(from: string, to: string): number {
  let row = Array.from({ length: to.length + 1 }, (_, k) => k * leftOut);
  for (let k = 0; k < from.length; k++) {
    const above = row;
    row = [k + 1];
    for (let n = 0; n < to.length; n++) {
      const same = from[k]!.toLowerCase() === to[n]!.toLowerCase() ? 0 : 1;
      row.push(Math.min(above[n]! + same, above[n + 1]! + 1, row[n]! + leftOut));
    }
  }
  return row[to.length]!;
}

/** Reports wrong numbers of a query: `names` are their names, `expected` what each must be, `of` whose they are. */
export function badQuery(
  where: string,
  given: readonly unknown[],
  names: readonly string[],
  expected: 'a number' | 'a finite number',
  of = '',
): never {
  for (const [k, name] of names.entries()) {
    const value = given[k];
    const what = `${where}: ${name}${of}`;
    const unbounded = expected === 'a number' && /^m(in|ax)[XYZ]$/.test(name);
    if (typeof value !== 'number') badNumber(what, value, 'a number');
    if (Number.isNaN(value)) badValue(what, value, expected);
    if (!unbounded && !Number.isFinite(value)) badValue(what, value, 'a finite number');
  }
  for (const [k, name] of names.entries()) {
    const above = names.indexOf(name.replace('min', 'max'));
    const low = given[k] as number;
    const high = given[above] as number;
    if (low > high) badValue(`${where}: ${name}${of}`, low, `no more than ${names[above]}, which is ${high}`);
  }
  badValue(where, given, names.join(', '), true);
}

export const areNumbers = (
  a: unknown,
  b: unknown,
  c: unknown = 0,
  d: unknown = 0,
  e: unknown = 0,
  f: unknown = 0,
): boolean =>
  typeof a === 'number' &&
  typeof b === 'number' &&
  typeof c === 'number' &&
  typeof d === 'number' &&
  typeof e === 'number' &&
  typeof f === 'number';

/** Half the size of a box, a radius or a distance: infinite ones too. */
export const isSize = (size: unknown): size is number => typeof size === 'number' && size >= 0;

export function checkDistance(where: string, distance: unknown): number {
  if (!isSize(distance)) badNumber(where, distance, 'a number, at least 0');
  return distance;
}

/** Finds what is wrong with the arguments of `set`. */
export function badSet(this: OfDimensions, ...all: unknown[]): never {
  const [id, ...box] = all;
  checkCount('set', id, all.length, this.dimensions);
  badBox('set', id, box, this.dimensions);
}

/** Finds what is wrong with the arguments of `setSwept`. */
export function badSwept(this: OfDimensions, ...all: unknown[]): never {
  const [id, ...given] = all;
  const names = this.dimensions === 2 ? sweep2 : sweep3;
  checkCount('setSwept', id, all.length, this.dimensions, names);
  badQuery('setSwept', given, names, 'a number', ` of box ${id}`);
}

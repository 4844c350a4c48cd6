// Many queries in one call: all their numbers in, all their answers out, in typed arrays. The kernel answers them
// (kernel/questions/bulk.hpp); here they are checked, and the answers copied.
import { isNumber, known, normalAlong, number, point2, point3, tooFar } from './answers.ts';
import type { Dimensions } from './dimensions.ts';
import {
  badId,
  badQuery,
  badValue,
  checkAttached,
  checkDistance,
  checkNumberArray,
  checkOptions,
  corners,
  isId,
  isSize,
  maxId,
  sweep2,
  sweep3,
} from './errors.ts';
import { asks, limitAt, touchingAt } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { ray2, ray3 } from './queries.ts';
import {
  checkMost,
  checkSwitch,
  everything,
  isCount,
  type ManyBoxOptions,
  type ManyFarOptions,
  type ManyIds,
  maskOf,
  nobody,
} from './query-options.ts';
import { isTypedArray } from './values.ts';

/** The answer to any kind of query. */
export type Answer = ManyIds & {
  distances?: Float64Array;
  times?: Float64Array;
  normals?: Int8Array;
  of?: Uint32Array;
};
type Options = ManyBoxOptions & ManyFarOptions<Answer>;

const arrays = {
  ids: Uint32Array,
  offsets: Uint32Array,
  of: Uint32Array,
  distances: Float64Array,
  times: Float64Array,
  normals: Int8Array,
};
type Part = keyof typeof arrays;

const points = { 2: point2, 3: point3 };
const circles = { 2: [...point2, 'radius'], 3: [...point3, 'radius'] };
const rays = { 2: ray2, 3: ray3 };
const ways = { 2: sweep2, 3: sweep3 };
/** One query for each box: no numbers are given. */
export const nothing: readonly number[] = [];
const nobodys = { 2: ['box'], 3: ['box'] };

const idParts: readonly Part[] = ['ids', 'offsets'];
const nearParts: readonly Part[] = [...idParts, 'distances'];
const ofParts: readonly Part[] = [...nearParts, 'of'];
const rayParts: readonly Part[] = [...nearParts, 'normals'];
const wayParts: readonly Part[] = [...idParts, 'times', 'normals'];

const idOptions = ['mask', 'ignoreEach', 'out'];
const areaOptions = [...idOptions, 'touching'];
const boxOptions = [...areaOptions, 'within'];
const farOptions = [...idOptions, 'maxDistance'];
const ofAllOptions = ['mask', 'maxDistance', 'out'];

interface QueryKind {
  kind: number;
  /** The numbers of one query, by dimensions. */
  names: Record<Dimensions, readonly string[]>;
  parts: readonly Part[];
  options: readonly string[];
}

/** The kind of query, by the name of the call. */
const queryKinds = {
  queryBoxes: { kind: asks.box, names: corners, parts: idParts, options: boxOptions },
  queryPoints: { kind: asks.point, names: points, parts: idParts, options: areaOptions },
  queryCircles: { kind: asks.circle, names: circles, parts: idParts, options: areaOptions },
  rayCasts: { kind: asks.ray, names: rays, parts: rayParts, options: farOptions },
  sweeps: { kind: asks.way, names: ways, parts: wayParts, options: idOptions },
  nearests: { kind: asks.nearest, names: points, parts: nearParts, options: farOptions },
  nearestsOfAll: { kind: asks.others, names: nobodys, parts: ofParts, options: ofAllOptions },
} satisfies Record<string, QueryKind>;

/** Checks queries, runs them, and collects the answers, up to a limit for each. */
export function askMany(
  instance: KernelInstance,
  where: keyof typeof queryKinds,
  numbers: ArrayLike<number>,
  options: Options | undefined,
  most: number,
): Answer {
  const query: QueryKind = queryKinds[where];
  checkOptions(where, options, query.options);
  const names = query.names[instance.dimensions];
  const { parts } = query;
  let { kind } = query;
  const {
    within = false,
    touching = instance.touching,
    mask: given,
    ignoreEach,
    maxDistance = Number.POSITIVE_INFINITY,
    out,
  } = options ?? {};
  checkSwitch(where, 'within', within);
  if (within) kind = asks.within; // boxes alone take it
  // Compared first, since returning a large number would be garbage.
  if (!isCount(most)) checkMost(where, most);
  checkNumberArray(where, numbers);
  const { length } = numbers;
  const count = length / names.length;
  if (!Number.isInteger(count))
    badValue(`${where}: length`, length, `a multiple of ${names.length}: ${names.join(', ')}`);
  if (Array.isArray(numbers)) {
    for (let k = 0; k < length; k++) {
      if (typeof numbers[k] !== 'number') badNumbers(where, numbers, Math.floor(k / names.length), names);
    }
  }
  const mask = maskOf(where, given);
  checkSwitch(where, 'touching', touching);
  // The text is made only after the test: a string in each call would be garbage.
  if (!isSize(maxDistance)) checkDistance(`${where}: maxDistance`, maxDistance);
  checkFar(instance, where, kind, numbers, maxDistance);
  if (ignoreEach !== undefined) checkIgnored(where, ignoreEach, count);
  if (out !== undefined) checkAnswer(instance, where, out, parts);
  const ignored = outside(instance, ignoreEach);
  try {
    const at = instance.kernel.stage_questions(length + count) >>> 3;
    const doubles = instance.doubleView();
    instance.copyIn(where, doubles, at, numbers, length);
    if (ignored === undefined) doubles.fill(nobody, at + length, at + length + count);
    else instance.copyIn(where, doubles, at + length, ignored, count);
    const bad = instance.kernel.bad_question(kind, count);
    if (bad >= 0) badNumbers(where, numbers, bad, names);
    const io = instance.io(); // only now: a getter among the options may have asked a query itself
    io[touchingAt] = Number(touching);
    io[limitAt] = kind === asks.way ? 1 : maxDistance;
    const asked = known(instance, where, instance.kernel.ask_many(kind, count, mask, Math.min(most, everything)));
    return collect(instance, asked, parts, out);
  } catch (error) {
    instance.recover(error, where);
  }
}

/** In a world that wraps around: refuses rays and paths through too many worlds. */
function checkFar(
  instance: KernelInstance,
  where: string,
  kind: number,
  numbers: ArrayLike<number>,
  maxDistance: number,
): void {
  const most = instance.farthest;
  if (most === Number.POSITIVE_INFINITY) return;
  if (kind === asks.ray && maxDistance > most && maxDistance < Number.POSITIVE_INFINITY) {
    tooFar(`${where}: maxDistance`, maxDistance, most);
  }
  const each = instance.width + instance.dimensions;
  for (
    let k = instance.width;
    kind === asks.way && k < numbers.length;
    k += k % each === each - 1 ? instance.width + 1 : 1
  ) {
    if (Math.abs(numbers[k]!) > most) tooFar(`${where}: query ${Math.floor(k / each)}: the motion`, numbers[k]!, most);
  }
}

/** Copies what the kernel has found. */
function collect(instance: KernelInstance, count: number, names: readonly Part[], out: Answer | undefined): Answer {
  const words = instance.wordView();
  const ends = instance.kernel.offsets_address() >>> 2;
  const total = words[ends + count]!;
  const to = (out ?? {}) as Record<Part, Uint32Array | Float64Array | Int8Array>;
  for (const name of names) {
    const least =
      name === 'offsets' ? count + 1 : name === 'of' ? count : name === 'normals' ? total * instance.dimensions : total;
    if (!(to[name]?.length >= least)) to[name] = new arrays[name](to[name] ? least + (least >> 1) : least);
  }
  const answer = to as unknown as Answer;
  const { ids, offsets } = answer;
  // An array that another kind of query left in `out` is not touched.
  const ranks = names.includes('times') ? answer.times! : answer.distances!;
  const normals = names.includes('normals') ? answer.normals : undefined;
  const of = names.includes('of') ? answer.of : undefined;
  const ordered = names !== idParts; // hits, each with a distance or a time
  const first = (ordered ? instance.kernel.many_hits_address() : instance.kernel.many_ids_address()) >>> 2;
  for (let k = 0; k <= count; k++) offsets[k] = words[ends + k]!;
  for (let n = 0; n < total; n++) {
    if (ordered) copyHit(instance, ids, ranks, normals, n, first + 4 * n);
    else ids[n] = words[first + n]!;
  }
  const all = instance.kernel.answers_address() >>> 2;
  if (of !== undefined) for (let k = 0; k < count; k++) of[k] = words[all + k]!;
  return answer;
}

/** Copies the hit at a place in the kernel's memory. */
function copyHit(
  instance: KernelInstance,
  ids: Uint32Array,
  ranks: Float64Array,
  normals: Int8Array | undefined,
  n: number,
  at: number,
): void {
  const words = instance.wordView();
  ids[n] = words[at + 2]! & maxId; // the bits above it say whether it was met at a corner
  ranks[n] = instance.doubleView()[at >>> 1]!;
  if (normals === undefined) return;
  const side = words[at + 3]! | 0;
  for (let axis = 0; axis < instance.dimensions; axis++) {
    normals[n * instance.dimensions + axis] = normalAlong(axis, side);
  }
}

/** Reports what is wrong with the numbers of a query. */
function badNumbers(where: string, numbers: ArrayLike<number>, k: number, names: readonly string[]): never {
  const given = Array.prototype.slice.call(numbers, k * names.length, (k + 1) * names.length);
  const what = `${where}: query ${k}`;
  const round = names.at(-1) === 'radius';
  if (round && given.slice(0, -1).every(isNumber)) checkDistance(`${what}: radius`, given.at(-1)!);
  badQuery(what, given, round ? names.slice(0, -1) : names, number);
}

/** One id for each query. */
function checkIgnored(where: string, ids: ArrayLike<number>, count: number): void {
  where += ': ignoreEach';
  if (isTypedArray(ids, 'Uint32Array')) checkAttached(where, ids as Uint32Array);
  else if (!Array.isArray(ids)) badValue(where, ids, 'a Uint32Array or an array', true);
  if (ids.length !== count) badValue(`${where}: length`, ids.length, `${count}, one id for each query`);
  for (let k = 0; k < count; k++) if (!isId(ids[k])) badId(`${where}[${k}]`, ids[k]);
}

/** The same ids; copied if they are in this space's memory, as `pairs` is, which growing memory would detach. */
function outside(instance: KernelInstance, ids: Options['ignoreEach']): Options['ignoreEach'] {
  return ArrayBuffer.isView(ids) && ids.buffer === instance.exports.memory.buffer ? ids.slice() : ids;
}

/** The answer of an earlier call of the same kind. No two arrays share memory, nor any with the space. */
function checkAnswer(instance: KernelInstance, where: string, out: Partial<Answer>, parts: readonly Part[]): void {
  if (!out || typeof out !== 'object') badValue(`${where}: out`, out, 'the answer of an earlier call', true);
  for (let k = 0; k < parts.length; k++) {
    const part = parts[k]!;
    const { name } = arrays[part];
    const array = out[part];
    if (!isTypedArray(array, name)) badPart(where, part, array, true);
    let apart = array!.buffer !== instance.exports.memory.buffer;
    for (let n = 0; n < k; n++) apart &&= !overlap(array!, out[parts[n]!]!);
    if (!apart) badPart(where, part, array, false);
  }
}

function badPart(where: string, part: Part, array: unknown, wrongType: boolean): never {
  const { name } = arrays[part];
  const expected = `${name === 'Int8Array' ? 'an' : 'a'} ${name}${wrongType ? '' : ' with memory of its own'}`;
  badValue(`${where}: out.${part}`, array, expected, wrongType);
}

const overlap = (a: ArrayBufferView, b: ArrayBufferView) =>
  a.buffer === b.buffer && a.byteOffset < b.byteOffset + b.byteLength && b.byteOffset < a.byteOffset + a.byteLength;

// How a space queries its kernel and reads the answers: the code that all queries share. The files of the queries check
// their arguments and write them to the kernel's io array; the kernel answers (kernel/questions/queries.hpp); the code
// here copies the answers to where the caller wants them. A visitor gets them in parts, so that it can end the search,
// and may make queries itself.
import { badQuery, badValue, checkBoolean, checkOut, maxId } from './errors.ts';
import { afterAt, ioLength, orderNear, orderRay, orderWay } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { type Asked, everything, type IdsOptions, nobody, readOptions, release } from './query-options.ts';

/** Instead of a number of planes: the query is for the box or circle in the array. */
const shape = -1;

/** How many answers a search computes ahead for a visitor; for `accept`, which often takes the first, it begins with fewer. */
const part = 64;
const firstPart = 4;

/** A hit of a ray or of a moving box: it has one of the two numbers. */
type Hit = { id: number; distance?: number; time?: number; normal: number[] };
type Visitor = (id: number, rank: number, hit?: Hit) => unknown;
type Accept = (id: number, hit: Hit) => unknown;

/** The state of a query, saved while its visitor is called, which may make other queries. */
class Visit {
  turn = 0;
  readonly query = new Float64Array(ioLength);
  readonly ids = new Uint32Array(part);
  readonly ranks = new Float64Array(part);
  readonly sides = new Int32Array(part);
  readonly hits = { [orderRay]: { id: 0, distance: 0, normal: [] }, [orderWay]: { id: 0, time: 0, normal: [] } };
}

// A stack: one for each query, of any space, whose visitor is being called.
const visits: Visit[] = [];
let visiting = 0;

/** The answer of a query whose visitor has got the results. */
export const none: readonly unknown[] = Object.freeze([]);

export const number = 'a number';
export const finite = 'a finite number';
export const point2 = ['x', 'y'];
export const point3 = ['x', 'y', 'z'];

/** A finite number. */
export const isPlace = Number.isFinite as (value: unknown) => value is number;
export const isNumber = (value: unknown): value is number => typeof value === 'number';

/** Writes a point, as a box of zero size, to the io array, after the options, which follow the numbers. */
export function point(
  instance: KernelInstance,
  where: string,
  names: readonly string[],
  x: number,
  y: number,
  z: unknown,
  options: unknown,
): Asked {
  const flat = instance.width === 4;
  const good = isPlace(x) && isPlace(y);
  if (flat) {
    if (!good) badQuery(where, [x, y], point2, finite);
    options = z;
  } else if (!(good && isPlace(z))) {
    badQuery(where, [x, y, z], point3, finite);
  }
  const asked = readOptions(instance, where, options as IdsOptions | undefined, names);
  const io = instance.io();
  io[0] = x;
  io[1] = y;
  if (flat) {
    io[2] = x;
    io[3] = y;
  } else {
    io[2] = z as number;
    io[3] = x;
    io[4] = y;
    io[5] = z as number;
  }
  return asked;
}

/** Finds the boxes that touch the box or circle in the io array, or that are not behind the `planes` planes there. */
export function area(instance: KernelInstance, where: string, asked: Asked, planes = shape): number[] {
  if (asked.visit !== undefined) {
    visitArea(instance, where, planes, asked);
    return none as number[];
  }
  const { mask, ignored, others } = asked;
  const out = checkOut(where, asked.out as number[] | undefined);
  release();
  try {
    return copyIds(instance, ids(instance, where, planes, mask, ignored, 0, everything), out, others);
  } catch (error) {
    instance.recover(error, where);
  }
}

/** Finds the first boxes that the box in the io array meets, or the nearest ones; returns how many. */
export function order(instance: KernelInstance, where: string, kind: number, asked: Asked, most: number): number {
  const { mask, ignored, others } = asked;
  release();
  try {
    const wanted = Math.min(most + (others?.length ?? 0), everything);
    const count = known(instance, where, instance.asker.ask_order(kind, mask, ignored, nobody, wanted));
    return others === undefined ? count : leaveOut(instance, others, count, most);
  } catch (error) {
    instance.recover(error, where);
  }
}

/** Removes ignored boxes from the kernel's hits; returns how many are left, at most `most`. */
function leaveOut(instance: KernelInstance, others: readonly number[], count: number, most: number): number {
  const words = instance.wordView();
  const first = instance.exports.hits_address() >>> 2;
  let kept = 0;
  for (let k = 0; k < count && kept < most; k++) {
    if (others.includes(words[first + 4 * k + 2]! & maxId)) continue;
    words.copyWithin(first + 4 * kept++, first + 4 * k, first + 4 * k + 4);
  }
  return kept;
}

/** The number of ids that the kernel has found, at most `most`, from place `from` of its index on. */
function ids(
  instance: KernelInstance,
  where: string,
  planes: number,
  mask: number,
  ignored: number,
  from: number,
  most: number,
): number {
  const { asker } = instance;
  const count =
    planes === shape ? asker.ask_area(mask, ignored, from, most) : asker.ask_planes(planes, mask, ignored, from, most);
  return known(instance, where, count);
}

function visitArea(instance: KernelInstance, where: string, planes: number, asked: Asked): void {
  const { mask, ignored, others } = asked;
  const visitor = asked.visit as (id: number, inside: boolean) => unknown;
  const visit = startVisit(instance);
  try {
    for (let from = 0; from >= 0; ) {
      instance.io().set(visit.query);
      const count = ids(instance, where, planes, mask, ignored, from, part);
      from = instance.io()[0]!;
      const first = instance.exports.answers_address() >>> 2;
      const words = instance.wordView();
      for (let k = 0; k < count; k++) visit.ids[k] = words[first + k]!;
      for (let k = 0; k < count; k++) {
        const id = visit.ids[k]!; // for planes, the bits above it say whether it is in front of all
        if (others?.includes(id & maxId)) continue;
        const returned = planes === shape ? (visitor as (id: number) => unknown)(id) : visitor(id & maxId, id > maxId);
        if (ends(instance, where, visit, returned)) return;
      }
    }
  } catch (error) {
    instance.recover(error, where);
  } finally {
    visiting--;
  }
}

/**
 * Goes through the answers in order, at most `most`. With `into`, writes each hit there until one is accepted, and
 * returns whether one was; else calls the visitor until it returns `false`.
 */
export function walk(
  instance: KernelInstance,
  where: string,
  kind: number,
  asked: Asked,
  most: number,
  into?: Hit,
): boolean {
  const { mask, ignored, others } = asked;
  const call = (into ? asked.accept : asked.visit) as Visitor & Accept;
  const visit = startVisit(instance);
  const hit = into ?? (kind === orderNear ? undefined : visit.hits[kind as typeof orderRay]);
  try {
    for (let left = most, after = nobody, ahead = into ? firstPart : part; left > 0; ahead = part) {
      const wanted = Math.min(left + (others?.length ?? 0), ahead);
      instance.io().set(visit.query);
      const count = known(instance, where, instance.asker.ask_order(kind, mask, ignored, after, wanted));
      keepHits(instance, visit, count);
      for (let k = 0; k < count && left > 0; k++) {
        const id = visit.ids[k]! & maxId;
        if (others?.includes(id)) continue;
        left--;
        if (hit !== undefined) writeHit(instance, visit, k, kind, hit);
        const returned = into ? call(id, into) : call(id, visit.ranks[k]!, hit);
        if (ends(instance, where, visit, returned, into)) return true;
      }
      if (count < wanted) return false;
      after = visit.ids[count - 1]!;
      visit.query[afterAt] = visit.ranks[count - 1]!;
    }
    return false;
  } catch (error) {
    instance.recover(error, where);
  } finally {
    visiting--;
  }
}

/** Copies the kernel's hits, which other queries will overwrite. */
function keepHits(instance: KernelInstance, visit: Visit, count: number): void {
  const first = instance.exports.hits_address();
  const words = instance.wordView();
  const doubles = instance.doubleView();
  for (let k = 0; k < count; k++) {
    visit.ids[k] = words[(first >>> 2) + 4 * k + 2]!;
    visit.sides[k] = words[(first >>> 2) + 4 * k + 3]!;
    visit.ranks[k] = doubles[(first >>> 3) + 2 * k]!;
  }
}

function writeHit(instance: KernelInstance, visit: Visit, k: number, kind: number, hit: Hit): void {
  hit.id = visit.ids[k]! & maxId;
  if (kind === orderRay) hit.distance = visit.ranks[k]!;
  else hit.time = visit.ranks[k]!;
  writeNormal(instance, visit.sides[k]!, hit.normal);
}

/** The normal along an axis of the side that was hit, from the kernel's number for it. */
export const normalAlong = (axis: number, side: number) => (side === axis + 1 ? 1 : side === -axis - 1 ? -1 : 0);

function writeNormal(instance: KernelInstance, side: number, normal: number[]): void {
  for (let axis = 0; axis < instance.dimensions; axis++) {
    normal[axis] = normalAlong(axis, side);
  }
  cut(normal, instance.dimensions);
}

/** Saves the query that is in the io array. */
function startVisit(instance: KernelInstance): Visit {
  release();
  const level = visiting++;
  let visit = visits[level];
  if (visit === undefined) {
    visit = new Visit();
    visits.push(visit);
  }
  visit.query.set(instance.io());
  visit.turn = instance.turn;
  return visit;
}

/** Copies the first of the kernel's answers. */
export function copyIds(instance: KernelInstance, count: number, out: number[], others?: readonly number[]): number[] {
  const words = instance.wordView();
  const first = instance.exports.answers_address() >>> 2;
  let kept = 0;
  if (others === out) others = [...out];
  for (let k = 0; k < count; k++) {
    const id = words[first + k]! & maxId;
    if (!others?.includes(id)) out[kept++] = id;
  }
  return cut(out, kept);
}

/**
 * Removes what an array holds beyond its answers. Setting its length instead would give back its memory, so that the
 * next longer answer makes garbage, and takes V8 50 ns even if the length stays the same.
 */
export function cut<T>(array: T[], length: number): T[] {
  while (array.length > length) array.pop();
  return array;
}

/** Reads the k-th of the kernel's hits; returns the place of its rank among the doubles. */
export function readHit(instance: KernelInstance, k: number, hit: { id: number; normal: number[] }): number {
  const at = instance.exports.hits_address() + 16 * k;
  const words = instance.wordView();
  hit.id = words[(at >>> 2) + 2]! & maxId; // the bits above it say whether it was met at a corner
  writeNormal(instance, words[(at >>> 2) + 3]! | 0, hit.normal);
  return at >>> 3;
}

/** After a query: the number of its answers; throws if the kernel has no copy of the boxes. */
export function known(instance: KernelInstance, where: string, count: number): number {
  instance.ring.follow();
  if (count !== -1) return count;
  throw new Error(
    `${where}: boxes have changed since the last update, and a large space that was never queried has no copy, ` +
      'or memory ran out: query right after an update',
  );
}

/** Whether what a visitor, or an `accept` with its hit, has returned ends the search. */
function ends(instance: KernelInstance, where: string, visit: Visit, returned: unknown, into?: Hit): boolean {
  const by = into ? 'accept' : 'visit';
  if (returned && (into ? returned !== true : (returned as { then?: unknown }).then))
    checkBoolean(`${where}: ${by} returned`, returned);
  if (instance.turn === visit.turn) return returned === !!into;
  throw new Error(`${where}: update or restore was called by ${by}, or memory ran out: expected after the search`);
}

/** Refuses a path or a distance that is too long in a world that wraps around. */
export function tooFar(where: string, distance: number, most: number): never {
  badValue(where, distance, `at most ${most}, since each world on the path costs a search`);
}

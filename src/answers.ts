// How a space asks its kernel and reads what it answers: what all questions share.
// The kernel answers (kernel/queries.hpp); the files of the questions check them and write them into its array of numbers;
// here the answers are copied to where they are wanted. A visitor gets them in parts, so that the search ends where it
// says so, and may ask questions itself.
import type { Dimensions } from './dimensions.ts';
import { badQuestion, checkOptions, checkOut, maxId } from './errors.ts';
import {
  checkVisitor,
  everything,
  type IdsOptions,
  idsOptions,
  ignoredOf,
  maskOf,
  nobody,
  type PlanesOptions,
  type QueryOptions,
} from './query-options.ts';
import { ioLength, Space } from './space.ts';

// Places in the kernel's array of numbers: see kernel/abi.cpp.
export const radiusAt = 12;
export const limitAt = 13;
export const lengthAt = 14;
const afterAt = 15;
export const planesAt = 16;

/** What the kernel is asked for: see there. */
export const near = 0;
export const onRay = 1;
export const onWay = 2;

/** In place of a number of planes: the box or circle that stands in the array. */
const shape = -1;

/** How many answers a visitor's search goes ahead. */
const part = 64;

/** What is remembered of a question while its visitor is called, which may ask other questions. */
class Visit {
  readonly question = new Float64Array(ioLength);
  readonly ids = new Uint32Array(part);
  readonly ranks = new Float64Array(part);
}

/** The answer where a visitor got it. */
export const none: readonly unknown[] = Object.freeze([]);

export const number = 'a number';
export const finite = 'a finite number';
export const point2 = ['x', 'y'];
export const point3 = ['x', 'y', 'z'];

/** A finite number. */
export const isPlace = Number.isFinite as (value: unknown) => value is number;
export const isNumber = (value: unknown): value is number => typeof value === 'number';

/** A space that asks its kernel. */
export abstract class Answers<D extends Dimensions> extends Space<D> {
  #words = new Uint32Array();
  #doubles = new Float64Array();
  readonly #visits: Visit[] = [];
  #visiting = 0;

  override dispose(): void {
    super.dispose();
    this.#words = new Uint32Array();
    this.#doubles = new Float64Array();
  }

  /** Puts a point, as a box without size, where the kernel reads it; returns the options behind its numbers. @internal */
  protected point(where: string, x: number, y: number, z?: unknown, options?: unknown): IdsOptions | undefined {
    const io = this.io();
    const good = isPlace(x) && isPlace(y);
    if (this.width === 4) {
      if (!good || options !== undefined) badQuestion(where, [x, y, z, options], point2, finite);
      io[2] = x;
      io[3] = y;
      options = z;
    } else {
      if (!(good && isPlace(z))) badQuestion(where, [x, y, z], point3, finite);
      io[2] = z;
      io[3] = x;
      io[4] = y;
      io[5] = z;
    }
    io[0] = x;
    io[1] = y;
    return options as IdsOptions | undefined;
  }

  /** Asks for the boxes that touch what stands in the kernel's array, or that are not behind so many planes there. @internal */
  protected area(where: string, options: IdsOptions | PlanesOptions | undefined, planes = shape): number[] {
    if (this.wraps) noQueries(where);
    checkOptions(where, options, idsOptions);
    const mask = maskOf(where, options);
    const ignored = ignoredOf(where, options);
    if (options?.visit !== undefined) {
      this.#visitArea(where, planes, mask, ignored, options.visit);
      return none as number[];
    }
    const out = options?.out ?? [];
    checkOut(where, out);
    try {
      return this.copyIds(this.#ids(where, planes, mask, ignored, 0, everything), out);
    } catch (error) {
      this.recover(error, where);
    }
  }

  /** Asks for the first boxes that the box in the kernel's array meets, or for the nearest; returns how many. @internal */
  protected order(where: string, kind: number, options: QueryOptions | undefined, most: number): number {
    if (this.wraps) noQueries(where);
    const mask = maskOf(where, options);
    const ignored = ignoredOf(where, options);
    try {
      return known(where, this.kernel.ask_order(kind, mask, ignored, nobody, most));
    } catch (error) {
      this.recover(error, where);
    }
  }

  /** How many ids the kernel has found, at most so many, beginning at place `from` of its index. */
  #ids(where: string, planes: number, mask: number, ignored: number, from: number, most: number): number {
    const { kernel } = this;
    const count =
      planes === shape
        ? kernel.ask_area(mask, ignored, from, most)
        : kernel.ask_planes(planes, mask, ignored, from, most);
    return known(where, count);
  }

  #visitArea(
    where: string,
    planes: number,
    mask: number,
    ignored: number,
    visitor: (id: number, inside: boolean) => unknown,
  ): void {
    checkVisitor(where, visitor);
    const visit = this.#startVisit();
    try {
      for (let from = 0; from >= 0; ) {
        this.io().set(visit.question);
        const count = this.#ids(where, planes, mask, ignored, from, part);
        from = this.io()[0]!;
        const first = this.kernel.answers_address() >>> 2;
        const words = this.wordView();
        for (let k = 0; k < count; k++) visit.ids[k] = words[first + k]!;
        const updates = this.kernel.updates();
        for (let k = 0; k < count; k++) {
          const id = visit.ids[k]!; // of planes: above it stands whether it is in front of all
          if ((planes === shape ? (visitor as (id: number) => unknown)(id) : visitor(id & maxId, id > maxId)) === false)
            return;
          if (this.kernel.updates() !== updates) updatedInside(where);
        }
      }
    } catch (error) {
      this.recover(error, where);
    } finally {
      this.#visiting--;
    }
  }

  /** @internal */
  protected visitOrder(
    where: string,
    kind: number,
    options: QueryOptions,
    most: number,
    visitor: (id: number, rank: number) => unknown,
  ): void {
    if (this.wraps) noQueries(where);
    const mask = maskOf(where, options);
    const ignored = ignoredOf(where, options);
    checkVisitor(where, visitor);
    const visit = this.#startVisit();
    try {
      for (let left = most, after = nobody; left > 0; left -= part) {
        const wanted = Math.min(left, part);
        this.io().set(visit.question);
        const count = known(where, this.kernel.ask_order(kind, mask, ignored, after, wanted));
        const first = this.kernel.hits_address();
        const words = this.wordView();
        const doubles = this.doubleView();
        for (let k = 0; k < count; k++) {
          visit.ids[k] = words[(first >>> 2) + 4 * k + 2]!;
          visit.ranks[k] = doubles[(first >>> 3) + 2 * k]!;
        }
        const updates = this.kernel.updates();
        for (let k = 0; k < count; k++) {
          if (visitor(visit.ids[k]! & maxId, visit.ranks[k]!) === false) return;
          if (this.kernel.updates() !== updates) updatedInside(where);
        }
        if (count < wanted) return;
        after = visit.ids[count - 1]!;
        visit.question[afterAt] = visit.ranks[count - 1]!;
      }
    } catch (error) {
      this.recover(error, where);
    } finally {
      this.#visiting--;
    }
  }

  /** Remembers the question that stands in the kernel's array. */
  #startVisit(): Visit {
    const level = this.#visiting++;
    let visit = this.#visits[level];
    if (visit === undefined) {
      visit = new Visit();
      this.#visits.push(visit);
    }
    visit.question.set(this.io());
    return visit;
  }

  /** Copies the first of the kernel's answers. @internal */
  protected copyIds(count: number, out: number[]): number[] {
    const words = this.wordView();
    const first = this.kernel.answers_address() >>> 2;
    for (let k = 0; k < count; k++) out[k] = words[first + k]! & maxId;
    out.length = count;
    return out;
  }

  /** Reads the k-th of the kernel's hits; returns the place of its rank among the doubles. @internal */
  protected readHit(k: number, hit: { id: number; normal: number[] }): number {
    const at = this.kernel.hits_address() + 16 * k;
    const words = this.wordView();
    hit.id = words[(at >>> 2) + 2]! & maxId; // above it stands whether it was met at a corner
    const side = words[(at >>> 2) + 3]! | 0;
    for (let axis = 0; axis < this.dimensions; axis++) {
      hit.normal[axis] = side === axis + 1 ? 1 : side === -axis - 1 ? -1 : 0;
    }
    hit.normal.length = this.dimensions;
    return at >>> 3;
  }

  /** The kernel's memory. @internal */
  protected wordView(): Uint32Array {
    if (this.#words.length === 0) this.#words = new Uint32Array(this.kernel.memory.buffer);
    return this.#words;
  }
  /** @internal */
  protected doubleView(): Float64Array {
    if (this.#doubles.length === 0) this.#doubles = new Float64Array(this.kernel.memory.buffer);
    return this.#doubles;
  }
}

/** A number of answers, where the kernel knows them. */
function known(where: string, count: number): number {
  if (count !== -1) return count;
  throw new Error(
    `${where}: boxes have changed since the last update, and a space of so many keeps none of before until it was ` +
      'asked, expected the first question right after an update',
  );
}

function updatedInside(where: string): never {
  throw new Error(`${where}: update was called by the visitor, expected it to wait until the search has ended`);
}

function noQueries(where: string): never {
  throw new Error(
    `${where}: this world wraps around, in which queries are not answered, expected a space without wrap`,
  );
}

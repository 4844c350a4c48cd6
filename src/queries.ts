// What a space can be asked between two updates: who collides with whom, what is there, what is ahead, what is near.
// Everything is answered as of the last update; what the questions need is made at the first after it. The kernel
// answers (kernel/queries.hpp); this file checks the questions, and copies the answers to where they are wanted. A
// visitor gets them in parts, so that the search ends where it says so, and may ask questions itself.
import type {
  BoxQuestion,
  Dimensions,
  NearestQuestion,
  PointQuestion,
  RayQuestion,
  RoundQuestion,
  SweepQuestion,
} from './dimensions.ts';
import {
  badHit,
  badId,
  badQuestion,
  badValue,
  checkOptions,
  checkOut,
  corners,
  isHit,
  isId,
  maxId,
  sweep2,
  sweep3,
} from './errors.ts';
import {
  checkDistance,
  checkVisitor,
  everything,
  farOptions,
  type IdsOptions,
  idsOptions,
  ignoredOf,
  maskOf,
  type NearestOptions,
  nobody,
  type QueryOptions,
  type RayAllOptions,
  type RayHit,
  type RayOptions,
  rayOptions,
  type SweepHit,
  type SweepOptions,
} from './query-options.ts';
import { Space } from './space.ts';

// Places in the kernel's array of numbers: see kernel/abi.cpp.
const radiusAt = 12;
const limitAt = 13;
const lengthAt = 14;
const afterAt = 15;

/** What the kernel is asked for: see there. */
const near = 0;
const onRay = 1;
const onWay = 2;

/** How many answers a visitor's search goes ahead. */
const part = 64;

/** What is remembered of a question while its visitor is called, which may ask other questions. */
class Visit {
  readonly question = new Float64Array(16);
  readonly ids = new Uint32Array(part);
  readonly ranks = new Float64Array(part);
}

/** The answer where a visitor got it. */
const none: readonly unknown[] = Object.freeze([]);

const number = 'a number';
const finite = 'a finite number';
const point2 = ['x', 'y'];
const point3 = ['x', 'y', 'z'];
const ray2 = [...point2, 'directionX', 'directionY'];
const ray3 = [...point3, 'directionX', 'directionY', 'directionZ'];

/** A finite number. */
const isPlace = Number.isFinite as (value: unknown) => value is number;
const isNumber = (value: unknown): value is number => typeof value === 'number';

/**
 * A space that answers. Users meet it as BroadPhase.
 *
 * All questions are answered by what the last update saw: boxes that were set, moved or deleted since then make no
 * difference until the next, and before the first update there is nothing. A large space that has not been asked keeps no
 * copy of its boxes (above 16,384, and 4,096 written in place): its first question is to follow an update, or throws.
 * Boxes are closed: what touches counts. Rays and sweeps meet a box where their way leads into a face of it: along a
 * face or away from it is no hit. All is decided in double precision. The options are read at each call; to
 * make no garbage, keep and reuse them with an `out` in them, whose answers stay about as many.
 *
 * All questions throw RangeError for NaN, a minimum above its maximum, infinite points, ways and directions, negative
 * distances, and masks and ids out of range; TypeError for other than numbers, for a wrong number of them, and for
 * options that there are not.
 */
export abstract class Queries<D extends Dimensions> extends Space<D> {
  #words = new Uint32Array();
  #doubles = new Float64Array();
  readonly #visits: Visit[] = [];
  /** Left over where an answer was shorter than the one before: for a longer one. */
  readonly #spare: RayHit[] = [];
  #visiting = 0;

  /**
   * Whether boxes `a` and `b` are a pair of the last update: constant time after the first question.
   * @param a an integer from 0 to 2^24 - 1, of a box or not; so is `b`
   * @throws RangeError for a bad id
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
   * space.isColliding(9, 7); // → true
   * space.isColliding(7, 8); // → false
   */
  isColliding(a: number, b: number): boolean {
    if (!isId(a)) badId('isColliding', a);
    if (!isId(b)) badId('isColliding', b);
    try {
      return this.kernel.is_pair(a, b) === 1;
    } catch (error) {
      this.recover(error, 'isColliding');
    }
  }

  /**
   * The ids of the boxes that are in a pair with box `id` in the last update, in the order of `pairs`: takes time
   * proportional to the answer, after the first question.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box or not
   * @param out filled and returned, if given; else a new array
   * @throws RangeError for a bad id; TypeError where `out` is no array
   *
   * @example
   * const space = new BroadPhase();
   * space.set(1, 0, 0, 10, 10).set(2, 5, 5, 15, 15).set(3, 9, 0, 12, 4).update();
   * space.collisionsOf(1).sort(); // → [2, 3]
   */
  collisionsOf(id: number, out: number[] = []): number[] {
    if (!isId(id)) badId('collisionsOf', id);
    checkOut('collisionsOf', out);
    try {
      return this.#copyIds(this.kernel.partners(id), out);
    } catch (error) {
      this.recover(error, 'collisionsOf');
    }
  }

  /**
   * The ids of the boxes that overlap or touch a box, which may be infinite: in no particular order, but the same one
   * for the same boxes. 2D: `queryBox(minX, minY, maxX, maxY, options?)`, 3D:
   * `queryBox(minX, minY, minZ, maxX, maxY, maxZ, options?)`.
   *
   * @param question the least coordinates, in the units of your world: any numbers but NaN; then the largest ones, not
   *   below the least; then options, if any
   * @throws as all questions do: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase();
   * const enemy = 2;
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).setFilter(7, 1, 3).setFilter(9, enemy, 3).update();
   * space.queryBox(8, 8, 12, 12).sort(); // → [7, 9]
   * space.queryBox(8, 8, 12, 12, { mask: enemy }); // → [9]
   * let hurt = 0;
   * space.queryBox(8, 8, 12, 12, { visit: () => hurt++ }); // → []
   * hurt; // → 2
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).update();
   * space.queryBox(1, 1, 1, 2, 2, 2); // → [7]
   */
  queryBox(...question: BoxQuestion<D, IdsOptions>): number[];
  queryBox(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: IdsOptions): number[] {
    const io = this.io();
    if (this.width === 4) {
      if (!(isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && a <= c && b <= d) || f !== undefined) {
        badQuestion('queryBox', [a, b, c, d, e, f, options], corners[2], number);
      }
      options = e as IdsOptions | undefined;
    } else {
      const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && isNumber(e) && isNumber(f);
      if (!(good && a <= d && b <= e && c <= f)) {
        badQuestion('queryBox', [a, b, c, d, e, f], corners[3], number);
      }
      io[4] = e;
      io[5] = f;
    }
    io[0] = a;
    io[1] = b;
    io[2] = c;
    io[3] = d;
    io[radiusAt] = -1;
    return this.#area('queryBox', options);
  }

  /**
   * The ids of the boxes that hold a point or touch it: as {@link BroadPhase.queryBox}. 2D: `queryPoint(x, y, options?)`, 3D:
   * `queryPoint(x, y, z, options?)`.
   *
   * @param question where it is: finite coordinates; then options, if any
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).update();
   * space.queryPoint(10, 3); // → [7]
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).update();
   * space.queryPoint(0.5, 0.5, 2); // → []
   */
  queryPoint(...question: PointQuestion<D, IdsOptions>): number[];
  queryPoint(x: number, y: number, z?: unknown, options?: IdsOptions): number[] {
    options = this.#point('queryPoint', x, y, z, options);
    this.io()[radiusAt] = -1;
    return this.#area('queryPoint', options);
  }

  /**
   * 2D: the ids of the boxes that a circle overlaps or touches: as {@link BroadPhase.queryBox}.
   * @param question its centre: finite coordinates; its radius: at least 0, in the units of your world; then options, if any
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).update();
   * space.queryCircle(13, 14, 5); // → [7]
   * space.queryCircle(14, 14, 5); // → []
   */
  queryCircle(...question: D extends 2 ? RoundQuestion<2, IdsOptions> : never): number[];
  queryCircle(x: number, y: number, radius: number, options?: IdsOptions): number[] {
    if (this.width !== 4) wrongShape('queryCircle', this.dimensions, 'querySphere');
    this.#point('queryCircle', x, y);
    this.io()[radiusAt] = checkDistance('queryCircle: radius', radius);
    return this.#area('queryCircle', options);
  }

  /**
   * 3D: the ids of the boxes that a sphere overlaps or touches: as {@link BroadPhase.queryBox}.
   * @param question its centre: finite coordinates; its radius: at least 0, in the units of your world; then options, if any
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).update();
   * space.querySphere(2, 0.5, 0.5, 1); // → [7]
   */
  querySphere(...question: D extends 3 ? RoundQuestion<3, IdsOptions> : never): number[];
  querySphere(x: number, y: number, z: number, radius: number, options?: IdsOptions): number[] {
    if (this.width !== 6) wrongShape('querySphere', this.dimensions, 'queryCircle');
    this.#point('querySphere', x, y, z);
    this.io()[radiusAt] = checkDistance('querySphere: radius', radius);
    return this.#area('querySphere', options);
  }

  /**
   * The first box that a ray meets, or `undefined`: of several at the same distance as in `sweep`.
   * The direction may have any length; where it has none the ray is a point. A ray that begins at a face meets it
   * where it leads into the box, at distance 0; one that leads along it or away does not. One that begins inside has
   * distance 0 and no normal. Edges and corners count. 2D:
   * `rayCast(x, y, directionX, directionY, options?)`, 3D: `rayCast(x, y, z, directionX, directionY, directionZ, options?)`.
   *
   * @param question where the ray begins, and where it points: finite numbers; then options, if any
   * @returns the box, the distance to it in the units of your world, and the normal of the side that was hit
   * @throws as all questions do: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase();
   * const me = 1;
   * space.set(me, -1, -1, 1, 1).set(7, 10, -5, 20, 5).update();
   * space.rayCast(0, 0, 1, 0, { ignore: me }); // → { id: 7, distance: 10, normal: [-1, 0] }
   * space.rayCast(0, 0, 1, 0, { ignore: me, maxDistance: 9 }); // → undefined
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 10, 1, 1, 11).update();
   * space.rayCast(0.5, 0.5, 0, 0, 0, 1)?.distance; // → 10
   */
  rayCast(...question: RayQuestion<D, RayOptions>): RayHit | undefined;
  rayCast(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: RayOptions) {
    options = this.#ray('rayCast', rayOptions, a, b, c, d, e, f, options);
    if (options?.out !== undefined && !isHit(options.out)) badHit('rayCast: out', options.out, 'distance');
    if (this.#order('rayCast', onRay, options, 1) === 0) return undefined;
    const hit: RayHit = options?.out ?? { id: 0, distance: 0, normal: [] };
    hit.distance = this.#doubleView()[this.#readHit(0, hit)]!;
    return hit;
  }

  /**
   * All boxes that a ray meets, by distance and then by id: as {@link BroadPhase.rayCast}. 2D: `rayCastAll(x, y,
   * directionX, directionY, options?)`, 3D:
   * `rayCastAll(x, y, z, directionX, directionY, directionZ, options?)`.
   *
   * @param question where the ray begins, and where it points: finite numbers; then options, if any
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 10, -5, 20, 5).set(9, 30, -5, 40, 5).update();
   * space.rayCastAll(0, 0, 1, 0).map((hit) => hit.id); // → [7, 9]
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 10, 1, 1, 11).update();
   * space.rayCastAll(0.5, 0.5, 0, 0, 0, 1, { maxDistance: 5 }); // → []
   */
  rayCastAll(...question: RayQuestion<D, RayAllOptions>): RayHit[];
  rayCastAll(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: RayAllOptions): RayHit[] {
    options = this.#ray('rayCastAll', farOptions, a, b, c, d, e, f, options);
    if (options?.visit !== undefined) {
      this.#visitOrder('rayCastAll', onRay, options, everything, options.visit);
      return none as RayHit[];
    }
    const out = options?.out ?? [];
    checkOut('rayCastAll', out);
    for (let k = 0; k < out.length; k++) if (!isHit(out[k])) badHit(`rayCastAll: out[${k}]`, out[k], 'distance');
    const count = this.#order('rayCastAll', onRay, options, everything);
    for (let k = 0; k < count; k++) {
      const hit = out[k] ?? this.#spare.pop() ?? { id: 0, distance: 0, normal: [] };
      hit.distance = this.#doubleView()[this.#readHit(k, hit)]!;
      out[k] = hit;
    }
    while (out.length > count) this.#spare.push(out.pop()!);
    return out;
  }

  /**
   * The first box that a moving box meets, or `undefined`: the swept test for what is too fast to be looked at from
   * frame to frame. It meets what its way leads into: who stands on a floor meets it only on a way down. Where it
   * overlaps a box from the start the time is 0, and the normal all 0. Of several met at the same time, faces come
   * before corners, then the smallest id. A box that is in the space meets itself: name it in `ignore`. Who stops at
   * `x + dx * time` touches, up to rounding, and never ends inside: see the guide to queries. 2D: `sweep(minX, minY,
   * maxX, maxY, dx, dy, options?)`, 3D: `sweep(minX, minY, minZ, maxX, maxY, maxZ, dx, dy, dz, options?)`.
   *
   * @param question where the box stands now: any numbers but NaN; how far it moves along each axis: finite numbers; then
   *   options, if any
   * @returns the box, the share of the way until they touch, and the normal of the side that was hit
   * @throws as all questions do: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase();
   * const bullet = 1;
   * space.set(bullet, 0, 0, 1, 1).set(7, 21, -5, 22, 5).update();
   * const hit = space.sweep(0, 0, 1, 1, 40, 0, { ignore: bullet }); // → { id: 7, time: 0.5, normal: [-1, 0] }
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 5, 1, 1, 6).update();
   * space.sweep(0, 0, 0, 1, 1, 1, 0, 0, 8)?.time; // → 0.5
   */
  sweep(...question: SweepQuestion<D, SweepOptions>): SweepHit | undefined;
  sweep(
    a: number,
    b: number,
    c: number,
    d: number,
    e: number,
    f: number,
    g?: unknown,
    h?: unknown,
    i?: unknown,
    options?: SweepOptions,
  ) {
    const io = this.io();
    if (this.width === 4) {
      const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && a <= c && b <= d;
      if (!(good && isPlace(e) && isPlace(f)) || h !== undefined) {
        badQuestion('sweep', [a, b, c, d, e, f, g, h, i, options], sweep2, number);
      }
      options = g as SweepOptions | undefined;
    } else {
      const all = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && isNumber(e) && isNumber(f);
      const good = all && a <= d && b <= e && c <= f;
      if (!(good && isPlace(g) && isPlace(h) && isPlace(i))) {
        badQuestion('sweep', [a, b, c, d, e, f, g, h, i], sweep3, number);
      }
      io[6] = g;
      io[7] = h;
      io[8] = i;
    }
    io[0] = a;
    io[1] = b;
    io[2] = c;
    io[3] = d;
    io[4] = e;
    io[5] = f;
    io[limitAt] = 1;
    io[lengthAt] = 1;
    checkOptions('sweep', options, idsOptions);
    if (options?.visit !== undefined) {
      this.#visitOrder('sweep', onWay, options, everything, options.visit);
      return undefined;
    }
    if (options?.out !== undefined && !isHit(options.out)) badHit('sweep: out', options.out, 'time');
    if (this.#order('sweep', onWay, options, 1) === 0) return undefined;
    const hit: SweepHit = options?.out ?? { id: 0, time: 0, normal: [] };
    hit.time = this.#doubleView()[this.#readHit(0, hit)]!;
    return hit;
  }

  /**
   * The ids of the `k` boxes nearest to a point, by the distance to the box, which is 0 inside, and then by id. 2D:
   * `nearest(x, y, k, options?)`, 3D:
   * `nearest(x, y, z, k, options?)`.
   *
   * @param question where from: finite coordinates; how many: an integer from 1 on, or Infinity for all; then options, if any
   * @returns fewer than k where there are no more, or none within `maxDistance`
   * @throws as all questions do: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 15, 0, 20, 5).update();
   * space.nearest(13, 2, 2); // → [9, 7]
   * space.nearest(13, 2, 2, { maxDistance: 2 }); // → [9]
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).set(9, 0, 0, 5, 1, 1, 6).update();
   * space.nearest(0, 0, 4, 1); // → [9]
   */
  nearest(...question: NearestQuestion<D, NearestOptions>): number[];
  nearest(x: number, y: number, z: number, k?: unknown, options?: NearestOptions): number[] {
    const flat = this.width === 4;
    const most = flat ? z : k;
    if (flat) {
      if (options !== undefined) badQuestion('nearest', [x, y, z, k, options], [...point2, 'k'], number);
      options = k as NearestOptions | undefined;
      this.#point('nearest', x, y);
    } else {
      this.#point('nearest', x, y, z);
    }
    if (typeof most !== 'number') badValue('nearest: k', most, 'an integer from 1 on, or Infinity', true);
    if (!(Number.isInteger(most) && most >= 1) && most !== Number.POSITIVE_INFINITY) {
      badValue('nearest: k', most, 'an integer from 1 on, or Infinity');
    }
    const wanted = Math.min(most, everything);
    checkOptions('nearest', options, farOptions);
    const { maxDistance = Number.POSITIVE_INFINITY } = options ?? {};
    checkDistance('nearest: maxDistance', maxDistance);
    this.io()[limitAt] = maxDistance;
    if (options?.visit !== undefined) {
      this.#visitOrder('nearest', near, options, wanted, options.visit);
      return none as number[];
    }
    const out = options?.out ?? [];
    checkOut('nearest', out);
    const count = this.#order('nearest', near, options, wanted);
    const words = this.#wordView();
    const first = this.kernel.hits_address() >>> 2;
    for (let n = 0; n < count; n++) out[n] = words[first + 4 * n + 2]!;
    out.length = count;
    return out;
  }

  override dispose(): void {
    super.dispose();
    this.#words = new Uint32Array();
    this.#doubles = new Float64Array();
  }

  /** Puts a point, as a box without size, where the kernel reads it; returns the options behind its numbers. */
  #point(where: string, x: number, y: number, z?: unknown, options?: unknown): IdsOptions | undefined {
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

  /** The same for a ray, with its limit. */
  #ray<Options extends { maxDistance?: number }>(
    where: string,
    known: readonly string[],
    a: number,
    b: number,
    c: number,
    d: number,
    e: unknown,
    f: unknown,
    options: Options | undefined,
  ): Options | undefined {
    const io = this.io();
    const good = isPlace(a) && isPlace(b) && isPlace(c) && isPlace(d);
    if (this.width === 4) {
      if (!good || f !== undefined) badQuestion(where, [a, b, c, d, e, f, options], ray2, finite);
      io[2] = a;
      io[3] = b;
      io[4] = c;
      io[5] = d;
      options = e as Options | undefined;
    } else {
      if (!(good && isPlace(e) && isPlace(f))) badQuestion(where, [a, b, c, d, e, f], ray3, finite);
      io[2] = c;
      io[3] = a;
      io[4] = b;
      io[5] = c;
      io[6] = d;
      io[7] = e;
      io[8] = f;
    }
    io[0] = a;
    io[1] = b;
    writeLength(io, this.width, this.dimensions);
    checkOptions(where, options, known);
    const { maxDistance = Number.POSITIVE_INFINITY } = options ?? {};
    io[limitAt] = checkDistance(`${where}: maxDistance`, maxDistance);
    return options;
  }

  /** Asks for the boxes that touch what stands in the kernel's array. */
  #area(where: string, options: IdsOptions | undefined): number[] {
    if (this.wraps) noQueries(where);
    checkOptions(where, options, idsOptions);
    const mask = maskOf(where, options);
    const ignored = ignoredOf(where, options);
    if (options?.visit !== undefined) {
      this.#visitArea(where, mask, ignored, options.visit);
      return none as number[];
    }
    const out = options?.out ?? [];
    checkOut(where, out);
    try {
      return this.#copyIds(known(where, this.kernel.ask_area(mask, ignored, 0, everything)), out);
    } catch (error) {
      this.recover(error, where);
    }
  }

  /** Asks for the first boxes that the box in the kernel's array meets, or for the nearest; returns how many. */
  #order(where: string, kind: number, options: QueryOptions | undefined, most: number): number {
    if (this.wraps) noQueries(where);
    const mask = maskOf(where, options);
    const ignored = ignoredOf(where, options);
    try {
      return known(where, this.kernel.ask_order(kind, mask, ignored, nobody, most));
    } catch (error) {
      this.recover(error, where);
    }
  }

  #visitArea(where: string, mask: number, ignored: number, visitor: (id: number) => unknown): void {
    checkVisitor(where, visitor);
    const visit = this.#startVisit();
    try {
      for (let from = 0; from >= 0; ) {
        this.io().set(visit.question);
        const count = known(where, this.kernel.ask_area(mask, ignored, from, part));
        from = this.io()[0]!;
        const first = this.kernel.answers_address() >>> 2;
        const words = this.#wordView();
        for (let k = 0; k < count; k++) visit.ids[k] = words[first + k]!;
        const updates = this.kernel.updates();
        for (let k = 0; k < count; k++) {
          if (visitor(visit.ids[k]!) === false) return;
          if (this.kernel.updates() !== updates) updatedInside(where);
        }
      }
    } catch (error) {
      this.recover(error, where);
    } finally {
      this.#visiting--;
    }
  }

  #visitOrder(
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
        const words = this.#wordView();
        const doubles = this.#doubleView();
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

  /** Copies the first of the kernel's answers. */
  #copyIds(count: number, out: number[]): number[] {
    const words = this.#wordView();
    const first = this.kernel.answers_address() >>> 2;
    for (let k = 0; k < count; k++) out[k] = words[first + k]!;
    out.length = count;
    return out;
  }

  /** Reads the k-th of the kernel's hits; returns the place of its rank among the doubles. */
  #readHit(k: number, hit: { id: number; normal: number[] }): number {
    const at = this.kernel.hits_address() + 16 * k;
    const words = this.#wordView();
    hit.id = words[(at >>> 2) + 2]! & maxId; // above it stands whether it was met at a corner
    const side = words[(at >>> 2) + 3]! | 0;
    for (let axis = 0; axis < this.dimensions; axis++) {
      hit.normal[axis] = side === axis + 1 ? 1 : side === -axis - 1 ? -1 : 0;
    }
    hit.normal.length = this.dimensions;
    return at >>> 3;
  }

  /** The kernel's memory. */
  #wordView(): Uint32Array {
    if (this.#words.length === 0) this.#words = new Uint32Array(this.kernel.memory.buffer);
    return this.#words;
  }
  #doubleView(): Float64Array {
    if (this.#doubles.length === 0) this.#doubles = new Float64Array(this.kernel.memory.buffer);
    return this.#doubles;
  }
}

/**
 * Writes the length of the way that begins in place `first` of the kernel's array: without overflow, and the same on
 * every machine, as Math.hypot is not. It reads and writes the array because doubles in and out of a call are garbage.
 */
function writeLength(io: Float64Array, first: number, dimensions: number): void {
  let most = 0;
  for (let k = first; k < first + dimensions; k++) most = Math.max(most, Math.abs(io[k]!));
  let sum = 0;
  for (let k = first; most > 0 && k < first + dimensions; k++) sum += (io[k]! / most) * (io[k]! / most);
  io[lengthAt] = most * Math.sqrt(sum);
}

/** A number of answers, where the kernel knows them. */
function known(where: string, count: number): number {
  if (count !== -1) return count;
  throw new Error(
    `${where}: boxes have changed since the last update, and a space of so many keeps none of before until it was ` +
      'asked, expected the first question right after an update',
  );
}

function wrongShape(where: string, dimensions: number, right: string): never {
  throw new TypeError(`${where}: this space has ${dimensions} dimensions, expected a call of ${right}`);
}

function updatedInside(where: string): never {
  throw new Error(`${where}: update was called by the visitor, expected it to wait until the search has ended`);
}

function noQueries(where: string): never {
  throw new Error(
    `${where}: this world wraps around, in which queries are not answered, expected a space without wrap`,
  );
}

// What a space can be asked between two updates: who collides with whom, what is there, what is in view, what is
// ahead, what is near. Everything is answered as of the last update; what the questions need is made at the first
// after it. Here are what is ahead and what is near; the others are in plane-queries.ts and place-queries.ts.
import {
  type Accept,
  finite,
  isNumber,
  isPlace,
  limitAt,
  near,
  none,
  number,
  onRay,
  onWay,
  point2,
  point3,
  tooFar,
  type Visitor,
} from './answers.ts';
import type { Dimensions, NearestQuestion, RayQuestion, SweepQuestion } from './dimensions.ts';
import { badHit, badQuestion, badValue, checkOptions, checkOut, isHit, sweep2, sweep3 } from './errors.ts';
import { PlaneQueries } from './plane-queries.ts';
import {
  checkDistance,
  checkMost,
  everything,
  farOptions,
  type NearestOptions,
  nearestOptions,
  type RayAllOptions,
  type RayHit,
  type RayOptions,
  rayOptions,
  type SweepHit,
  type SweepOptions,
  sweepOptions,
} from './query-options.ts';

export const ray2 = [...point2, 'directionX', 'directionY'];
export const ray3 = [...point3, 'directionX', 'directionY', 'directionZ'];

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
export abstract class Queries<D extends Dimensions> extends PlaneQueries<D> {
  /** Left over where an answer was shorter than the one before: for a longer one. */
  readonly #spare: RayHit[] = [];

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
   * space.rayCast(0, 0, 1, 0, { ignore: [me, 7] }); // → undefined
   * space.rayCast(5, 0, -1, 0, { accept: (id, hit) => hit.normal[0] === 1 })?.id; // → 1
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
    if (options?.accept !== undefined) {
      const hit: RayHit = options.out ?? { id: 0, distance: 0, normal: [] };
      return this.firstAccepted('rayCast', onRay, options, hit, options.accept as Accept) ? hit : undefined;
    }
    if (this.order('rayCast', onRay, options, 1) === 0) return undefined;
    const hit: RayHit = options?.out ?? { id: 0, distance: 0, normal: [] };
    hit.distance = this.doubleView()[this.readHit(0, hit)]!;
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
      this.visitOrder('rayCastAll', onRay, options, everything, options.visit as Visitor);
      return none as RayHit[];
    }
    const out = options?.out ?? [];
    checkOut('rayCastAll', out);
    for (let k = 0; k < out.length; k++) if (!isHit(out[k])) badHit(`rayCastAll: out[${k}]`, out[k], 'distance');
    const count = this.order('rayCastAll', onRay, options, everything);
    for (let k = 0; k < count; k++) {
      const hit = out[k] ?? this.#spare.pop() ?? { id: 0, distance: 0, normal: [] };
      hit.distance = this.doubleView()[this.readHit(k, hit)]!;
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
   * const solid = (id: number) => id !== bullet && id !== 7;
   * space.sweep(0, 0, 1, 1, 40, 0, { accept: solid }); // → undefined
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
    for (let k = this.width; this.farthest < Number.POSITIVE_INFINITY && k < this.width + this.dimensions; k++) {
      if (Math.abs(io[k]!) > this.farthest) tooFar('sweep: the way', io[k]!, this.farthest);
    }
    checkOptions('sweep', options, sweepOptions);
    if (options?.visit !== undefined) {
      this.visitOrder('sweep', onWay, options, everything, options.visit as Visitor);
      return undefined;
    }
    if (options?.out !== undefined && !isHit(options.out)) badHit('sweep: out', options.out, 'time');
    if (options?.accept !== undefined) {
      const hit: SweepHit = options.out ?? { id: 0, time: 0, normal: [] };
      return this.firstAccepted('sweep', onWay, options, hit, options.accept as Accept) ? hit : undefined;
    }
    if (this.order('sweep', onWay, options, 1) === 0) return undefined;
    const hit: SweepHit = options?.out ?? { id: 0, time: 0, normal: [] };
    hit.time = this.doubleView()[this.readHit(0, hit)]!;
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
   * const distances: number[] = [];
   * space.nearest(13, 2, 2, { distances });
   * distances; // → [2, 3]
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
      this.point('nearest', x, y);
    } else {
      this.point('nearest', x, y, z);
    }
    const wanted = checkMost('nearest', most);
    checkOptions('nearest', options, nearestOptions);
    const { maxDistance = Number.POSITIVE_INFINITY } = options ?? {};
    checkDistance('nearest: maxDistance', maxDistance);
    this.io()[limitAt] = maxDistance;
    if (options?.visit !== undefined) {
      this.visitOrder('nearest', near, options, wanted, options.visit);
      return none as number[];
    }
    const out = options?.out ?? [];
    checkOut('nearest', out);
    const distances = options?.distances;
    if (distances !== undefined && !Array.isArray(distances))
      badValue('nearest: distances', distances, 'an array', true);
    const count = this.order('nearest', near, options, wanted);
    const words = this.wordView();
    const first = this.kernel.hits_address();
    for (let n = 0; n < count; n++) out[n] = words[(first >>> 2) + 4 * n + 2]!;
    out.length = count;
    if (distances !== undefined) {
      const doubles = this.doubleView();
      for (let n = 0; n < count; n++) distances[n] = doubles[(first >>> 3) + 2 * n]!;
      distances.length = count;
    }
    return out;
  }

  /** Puts a ray, with its limit, where the kernel reads it; returns the options behind its numbers. */
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
    checkOptions(where, options, known);
    const { maxDistance = Number.POSITIVE_INFINITY } = options ?? {};
    io[limitAt] = checkDistance(`${where}: maxDistance`, maxDistance);
    if (maxDistance > this.farthest && maxDistance < Number.POSITIVE_INFINITY) {
      tooFar(`${where}: maxDistance`, maxDistance, this.farthest);
    }
    return options;
  }
}

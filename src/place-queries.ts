// The questions about places: who collides with whom, and what is in a box, at a point, or in a circle.
import { Answers, isNumber, number, radiusAt } from './answers.ts';
import type { BoxQuestion, Dimensions, PointQuestion, RoundQuestion } from './dimensions.ts';
import { badId, badQuestion, badValue, checkOut, corners, isId } from './errors.ts';
import { type BoxOptions, boxOptions, checkDistance, type IdsOptions } from './query-options.ts';

/** In place of a radius: see kernel/abi.cpp. */
const noCircle = -1;
const whole = -2;

/** A space that says what is where. */
export abstract class PlaceQueries<D extends Dimensions> extends Answers<D> {
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
   * space.collisionsOf(1).sort((a, b) => a - b); // → [2, 3]
   */
  collisionsOf(id: number, out: number[] = []): number[] {
    if (!isId(id)) badId('collisionsOf', id);
    checkOut('collisionsOf', out);
    try {
      return this.copyIds(this.kernel.partners(id), out);
    } catch (error) {
      this.recover(error, 'collisionsOf');
    }
  }

  /**
   * The ids of the boxes that overlap or touch a box, which may be infinite: in no particular order, but the same one
   * until the next update. 2D: `queryBox(minX, minY, maxX, maxY, options?)`, 3D:
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
   * space.queryBox(8, 8, 12, 12).sort((a, b) => a - b); // → [7, 9]
   * space.queryBox(8, 8, 12, 12, { mask: enemy }); // → [9]
   * space.queryBox(4, 4, 15, 15, { within: true }); // → [9]
   * let hurt = 0;
   * space.queryBox(8, 8, 12, 12, { visit: () => hurt++ }); // → []
   * hurt; // → 2
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).update();
   * space.queryBox(1, 1, 1, 2, 2, 2); // → [7]
   */
  queryBox(...question: BoxQuestion<D, BoxOptions>): number[];
  queryBox(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: BoxOptions): number[] {
    const io = this.io();
    if (this.width === 4) {
      if (!(isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && a <= c && b <= d) || f !== undefined) {
        badQuestion('queryBox', [a, b, c, d, e, f, options], corners[2], number);
      }
      options = e as BoxOptions | undefined;
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
    const within = options?.within ?? false;
    if (typeof within !== 'boolean') badValue('queryBox: within', within, 'true or false', true);
    io[radiusAt] = within ? whole : noCircle;
    return this.area('queryBox', options, boxOptions);
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
    options = this.point('queryPoint', x, y, z, options);
    this.io()[radiusAt] = noCircle;
    return this.area('queryPoint', options);
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
    this.point('queryCircle', x, y);
    this.io()[radiusAt] = checkDistance('queryCircle: radius', radius);
    return this.area('queryCircle', options);
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
    this.point('querySphere', x, y, z);
    this.io()[radiusAt] = checkDistance('querySphere: radius', radius);
    return this.area('querySphere', options);
  }
}

function wrongShape(where: string, dimensions: number, right: string): never {
  throw new TypeError(`${where}: this space has ${dimensions} dimensions, expected a call of ${right}`);
}

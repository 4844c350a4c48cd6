// What a space can be asked between two updates: what is there, in view, ahead, near.
import type {
  BoxQuery,
  Dimensions,
  NearestQuery,
  Numbers,
  PointQuery,
  RayQuery,
  RoundQuery,
  SweepQuery,
} from '../dimensions.ts';
import type {
  BoxOptions,
  IdsOptions,
  NearestOptions,
  PlanesOptions,
  RayAllOptions,
  RayHit,
  RayOptions,
  SweepHit,
  SweepOptions,
} from '../query-options.ts';

/** What a space can be asked between two updates: what is there, in view, ahead, near. */
export interface Queries<D extends Dimensions> {
  /**
   * The ids of the boxes that overlap or touch a box, which may be infinite. The order is arbitrary, and may differ from
   * one call to the next. 2D: `queryBox(minX, minY, maxX, maxY, options?)`, 3D: `queryBox(minX, minY, minZ, maxX, maxY,
   * maxZ, options?)`.
   *
   * @param query the minima, in the units of your world: any numbers but NaN; then the maxima, not below the minima;
   *   then options, if any
   * @throws as all queries do: see {@link BroadPhase}
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
  queryBox(...query: BoxQuery<D, BoxOptions>): number[];

  /**
   * The ids of the boxes that contain or touch a point: as {@link BroadPhase.queryBox}. 2D: `queryPoint(x, y,
   * options?)`, 3D: `queryPoint(x, y, z, options?)`.
   *
   * @param query the point: finite coordinates; then options, if any
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
  queryPoint(...query: PointQuery<D, IdsOptions>): number[];

  /**
   * 2D: the ids of the boxes that a circle overlaps or touches: as {@link BroadPhase.queryBox}.
   * @param query its centre: finite coordinates; its radius: at least 0, in the units of your world; then options, if any
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).update();
   * space.queryCircle(13, 14, 5); // → [7]
   * space.queryCircle(14, 14, 5); // → []
   */
  queryCircle(...query: D extends 2 ? RoundQuery<2, IdsOptions> : never): number[];

  /**
   * 3D: the ids of the boxes that a sphere overlaps or touches: as {@link BroadPhase.queryBox}.
   * @param query its centre: finite coordinates; its radius: at least 0, in the units of your world; then options, if any
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).update();
   * space.querySphere(2, 0.5, 0.5, 1); // → [7]
   */
  querySphere(...query: D extends 3 ? RoundQuery<3, IdsOptions> : never): number[];

  /**
   * The ids of the boxes that are not wholly behind any of up to eight planes, such as the six of a camera's view, in
   * arbitrary order. A plane is a normal n and an offset d; a point p is behind it if n · p + d, summed in doubles
   * along x, y and z in turn, is below 0. A box is behind it if all of it is; a box that touches it is not. The planes
   * may bound anything convex, or nothing: without planes all boxes are answers. A box near a corner of the view may be
   * outside it and yet not behind any single plane: it is among the answers.
   *
   * In a world that wraps around, three copies of a box count along each axis: the one whose minimum is in the world, from
   * 0 on, and those one world back and forth. The box is in the answer once, and inside if one of these copies is.
   *
   * @param planes 4 numbers for each plane, its normal, of any length, and its offset: `[nx, ny, nz, d, …]`; in 2D 3:
   *   `[nx, ny, d, …]`. All finite
   * @param options as for `queryBox`; `visit` also gets whether the box is wholly inside, in front of all planes, so
   *   that its parts need not be tested again
   * @throws as all queries do: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).set(8, 4, 0, 0, 6, 1, 1).set(9, 8, 0, 0, 9, 1, 1).update();
   * const planes = [1, 0, 0, 0, -1, 0, 0, 5]; // x from 0 to 5
   * space.queryPlanes(planes).sort((a, b) => a - b); // → [7, 8]
   * const whole: number[] = [];
   * space.queryPlanes(planes, { visit: (id, inside) => { if (inside) whole.push(id); } });
   * whole; // → [7]
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1).set(8, 4, 4, 6, 6).update();
   * space.queryPlanes([-1, -1, 3]); // → [7]
   */
  queryPlanes(planes: Numbers, options?: PlanesOptions): number[];

  /**
   * The first box that a ray hits, or `undefined`; ties are decided as in `sweep`. The direction may have any length;
   * if it is 0, the ray is a point. A ray that starts on a face hits it, at distance 0, if it leads into the box; one
   * that leads along it or away does not. One that starts inside has distance 0 and a normal of zeros. Edges and
   * corners count. 2D: `rayCast(x, y, directionX, directionY, options?)`, 3D: `rayCast(x, y, z, directionX, directionY,
   * directionZ, options?)`.
   *
   * @param query the origin of the ray, and its direction: finite numbers; then options, if any
   * @returns the box, the distance to it in the units of your world, and the normal of the side that was hit
   * @throws as all queries do: see {@link BroadPhase}
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
  rayCast(...query: RayQuery<D, RayOptions>): RayHit | undefined;

  /**
   * All boxes that a ray hits, by distance: as {@link BroadPhase.rayCast}. At the same distance, faces come before
   * corners, then the smallest id first. 2D: `rayCastAll(x, y, directionX, directionY, options?)`, 3D: `rayCastAll(x, y,
   * z, directionX, directionY, directionZ, options?)`.
   *
   * @param query the origin of the ray, and its direction: finite numbers; then options, if any
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
  rayCastAll(...query: RayQuery<D, RayAllOptions>): RayHit[];

  /**
   * The first box that a moving box hits, or `undefined`: the swept test for boxes that move too fast to be tested
   * frame by frame. It hits the boxes that its path leads into: a box on a floor hits the floor only when it moves down. A
   * box of zero size along an axis also hits the edges there, as a ray does: in a row of tiles, the next tile. If it
   * overlaps a box from the start, the time is 0 and the normal is all zeros, unless it also moves into a box with a smaller
   * id that it touches, which then comes first. Of several boxes hit at the same time, those hit on a face come before those
   * hit at a corner, then the smallest id. A box that is in the space hits itself: name it in `ignore`. A box that stops at
   * `x + dx * time` touches, up to rounding, and never ends inside: see the guide to queries. 2D: `sweep(minX, minY, maxX,
   * maxY, dx, dy, options?)`, 3D: `sweep(minX, minY, minZ, maxX, maxY, maxZ, dx, dy, dz, options?)`.
   *
   * @param query the box as it is now: any numbers but NaN; how far it moves along each axis: finite numbers; then
   *   options, if any
   * @returns the box, the fraction of the motion until they touch, and the normal of the side that was hit
   * @throws as all queries do: see {@link BroadPhase}
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
  sweep(...query: SweepQuery<D, SweepOptions>): SweepHit | undefined;

  /**
   * The ids of the `k` boxes nearest to a point, by the distance to the box, which is 0 inside, and then by id. 2D:
   * `nearest(x, y, k, options?)`, 3D: `nearest(x, y, z, k, options?)`.
   *
   * @param query a point: finite coordinates; how many boxes: an integer from 1 on, or Infinity for all; then
   *   options, if any
   * @returns fewer than k ids if there are no more boxes, or no more within `maxDistance`
   * @throws as all queries do: see {@link BroadPhase}
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
  nearest(...query: NearestQuery<D, NearestOptions>): number[];
}

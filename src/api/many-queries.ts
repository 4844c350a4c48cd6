// Many queries in one call: all their numbers in, all their answers out.
import type { Boxes } from '../boxes.ts';
import type { Numbers } from '../dimensions.ts';
import type {
  ManyAreaOptions,
  ManyBoxOptions,
  ManyFarOptions,
  ManyIds,
  ManyNearest,
  ManyNearestOfAll,
  ManyOptions,
  ManyRayHits,
  ManySweepHits,
} from '../query-options.ts';

/** Many queries in one call: all their numbers in, all their answers out. */
export interface ManyQueries {
  /**
   * The boxes in each of many boxes, as `queryBox` returns them: those of query k are `ids[offsets[k]]` up to
   * `ids[offsets[k + 1] - 1]`. One call for all, without an array for each.
   *
   * @param boxes the numbers of each, minima first, box after box
   * @param options `ignoreEach[k]` is left out of the answers to query k; `out`, the result of an earlier call, is
   *   filled and returned: its arrays are reused while they are long enough, and may then be longer than the answers
   * @throws as all queries do, with the number of the query: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]);
   * space.update();
   * const { ids, offsets } = space.queryBoxes([8, 8, 9, 9, 30, 30, 40, 40, 12, 12, 13, 13]);
   * offsets; // → Uint32Array [0, 2, 2, 3]
   * ids[2]; // → 1
   */
  queryBoxes(boxes: Boxes, options?: ManyBoxOptions): ManyIds;

  /**
   * The boxes at each of many points: as {@link BroadPhase.queryBoxes}.
   *
   * @param points 2 numbers (3D: 3) for each point
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).update();
   * space.queryPoints([10, 3, 11, 3]).offsets; // → Uint32Array [0, 1, 1]
   */
  queryPoints(points: Numbers, options?: ManyAreaOptions): ManyIds;

  /**
   * The boxes in each of many circles, in 3D of many spheres: as {@link BroadPhase.queryBoxes}.
   *
   * @param circles 3 numbers (3D: 4) for each: its centre, then its radius
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).update();
   * space.queryCircles([13, 14, 5, 14, 14, 5]).offsets; // → Uint32Array [0, 1, 1]
   */
  queryCircles(circles: Numbers, options?: ManyAreaOptions): ManyIds;

  /**
   * The first box that each of many rays hits, as `rayCast`: at most one answer per ray. As {@link
   * BroadPhase.queryBoxes}, with the distances and the normals, each of one number per axis.
   *
   * @param rays 4 numbers (3D: 6) for each: its origin, then its direction
   *
   * @example
   * const space = new BroadPhase().set(7, 10, -5, 20, 5).update();
   * const hits = space.rayCasts([0, 0, 1, 0, 0, 0, -1, 0]);
   * hits.offsets; // → Uint32Array [0, 1, 1]
   * hits.distances; // → Float64Array [10]
   * hits.normals; // → Int8Array [-1, 0]
   */
  rayCasts(rays: Numbers, options?: ManyFarOptions<ManyRayHits>): ManyRayHits;

  /**
   * The first box that each of many moving boxes hits, as `sweep`: as {@link BroadPhase.rayCasts}, with times instead of
   * distances.
   *
   * @param boxes 6 numbers (3D: 9) for each: its box, then how far it moves along each axis
   *
   * @example
   * const space = new BroadPhase().set(7, 21, -5, 22, 5).update();
   * space.sweeps([0, 0, 1, 1, 40, 0]).times; // → Float64Array [0.5]
   */
  sweeps(boxes: Numbers, options?: ManyOptions<ManySweepHits>): ManySweepHits;

  /**
   * The `k` boxes nearest to each of many points, the nearest first, as `nearest`. As {@link BroadPhase.queryBoxes}, with
   * the distances.
   *
   * @param points 2 numbers (3D: 3) for each point
   * @param k an integer from 1 on, or Infinity for all
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 15, 0, 20, 5).update();
   * const { ids, distances } = space.nearests([13, 2, 0, 2], 1);
   * ids; // → Uint32Array [9, 7]
   * distances; // → Float64Array [2, 0]
   */
  nearests(points: Numbers, k: number, options?: ManyFarOptions<ManyNearest>): ManyNearest;

  /**
   * The `k` other boxes nearest to each box, by the distance between boxes, then by id: those of box `of[n]` are
   * `ids[offsets[n]]` up to `ids[offsets[n + 1] - 1]`. The order of `of` depends on earlier calls: it is ascending if ids
   * came in ascending order and none was deleted. A box that is off has no answers. In an `out` that is longer than
   * needed, only the first places are written: one in `of` for each box of the last update.
   *
   * @param k an integer from 1 on, or Infinity for all
   * @throws as {@link BroadPhase.nearests}
   *
   * @example
   * const space = new BroadPhase().setAll([0, 0, 1, 1, 5, 0, 6, 1, 8, 0, 9, 1]);
   * space.update();
   * const { of, ids, distances } = space.nearestsOfAll(1);
   * of; // → Uint32Array [0, 1, 2]
   * ids; // → Uint32Array [1, 2, 1]
   * distances; // → Float64Array [4, 2, 2]
   */
  nearestsOfAll(k: number, options?: Omit<ManyFarOptions<ManyNearestOfAll>, 'ignoreEach'>): ManyNearestOfAll;
}

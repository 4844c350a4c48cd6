/**
 * The library: boxes in, overlapping pairs out, and questions between. `broadphase/all` has the same API and every
 * technique. Numbers are in whatever units the boxes are given in; ids are integers from 0 to 2^24 - 1.
 *
 * @module broadphase
 */
export {
  type Boxes,
  BroadPhase,
  type BroadPhaseOptions,
  type ConstructorOptions,
  type DimensionsSaid,
  type Reason,
  type Stats,
  type TechniqueName,
} from './broad-phase.ts';
export type { Filter } from './contents.ts';
export type * from './dimensions.ts';
export { findPairs, findPairsBetween } from './find-pairs.ts';
export { init } from './kernel.ts';
export type {
  BoxOptions,
  IdsOptions,
  ManyAreaOptions,
  ManyBoxOptions,
  ManyFarOptions,
  ManyIds,
  ManyNearest,
  ManyNearestOfAll,
  ManyOptions,
  ManyRayHits,
  ManySweepHits,
  NearestOptions,
  PlanesOptions,
  QueryOptions,
  RayAllOptions,
  RayHit,
  RayOptions,
  SweepHit,
  SweepOptions,
} from './query-options.ts';

/**
 * The library: boxes in, overlapping pairs out, and queries in between. `broadphase/all` has the same API and every
 * technique. Numbers are in whatever units the boxes are given in; ids are integers from 0 to 2^24 - 1.
 *
 * @module broadphase
 */
// biome-ignore-all assist/source/organizeImports: the kernel's text comes first. It is longer than the window of gzip,
// so code before it would not help to compress the code after it: 0.6 kB less.
export { init } from './kernel/load.ts';

export type { Boxes } from './boxes.ts';
export { BroadPhase } from './broad-phase.ts';
export type * from './dimensions.ts';
export { findPairs, findPairsBetween } from './find-pairs.ts';
export type { BroadPhaseOptions, ConstructorOptions, DimensionsSaid } from './options.ts';
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
export type { Filter } from './rules.ts';
export type { Reason, Stats } from './stats.ts';
export type { TechniqueName } from './techniques.ts';

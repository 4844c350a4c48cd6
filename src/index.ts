// What `import 'broadphase'` gives.
export {
  type Boxes,
  BroadPhase,
  type BroadPhaseOptions,
  type Reason,
  type Stats,
  type TechniqueName,
} from './broad-phase.ts';
export { findPairs, findPairsBetween } from './find-pairs.ts';
export { init } from './kernel.ts';
export type {
  IdsOptions,
  NearestOptions,
  QueryOptions,
  RayAllOptions,
  RayHit,
  RayOptions,
  SweepHit,
  SweepOptions,
} from './query-options.ts';

// What `import 'broadphase'` gives.
export { type Boxes, BroadPhase, type BroadPhaseOptions, type Stats, type TechniqueName } from './broad-phase.ts';
export { findPairs, findPairsBetween } from './find-pairs.ts';
export { init } from './kernel.ts';

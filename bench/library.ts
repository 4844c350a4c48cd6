// What the benchmark bundles of the repository: the library, the scenes, and the exact reference.
export { BroadPhase, findPairs, findPairsBetween } from '../src/index.ts';
export { createScene, gameNames, sceneNames } from '../src/scenes/index.ts';
export { createRandom } from '../src/scenes/random.ts';
export { framesOf } from '../src/scenes/recorded.ts';
export { openPlain } from '../src/trace/import.ts';
export { keysOf, referencePairs } from '../test/support/reference.ts';
export { createMotion, motionNames } from './motions/index.ts';
export { createJitter } from './motions/jitter.ts';

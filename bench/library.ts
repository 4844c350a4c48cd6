// What the benchmark bundles of the repository: the library, the scenes, and the exact reference.
export { BroadPhase } from '../src/index.ts';
export { createScene, sceneNames } from '../src/scenes/index.ts';
export { keysOf, referencePairs } from '../test/reference.ts';

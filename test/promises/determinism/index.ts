// What scripts/determinism.mjs bundles, for Node and for browsers.
export { readRecording } from '../../../src/scenes/recorded.ts';
export { play, techniqueNames } from './play.ts';
export { framesTape, randomTape } from './tape.ts';

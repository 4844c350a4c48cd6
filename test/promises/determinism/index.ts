// What scripts/determinism.mjs bundles, for Node and for browsers.
export { framesOf } from '../../../src/scenes/recorded.ts';
export { openTrace } from '../../../src/trace/reader.ts';
export { play, techniqueNames } from './play.ts';
export { framesTape, randomTape } from './tape.ts';

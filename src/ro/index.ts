// What `broadphase/ro` gives: every name on its own, and all of them once more as `ro`, so that
// `import * as ro from 'broadphase/ro'` and `import { ro } from 'broadphase/ro'` mean the same `ro.World`.
export * from './engine.ts';
export * as ro from './engine.ts';

/**
 * A small canvas game engine, to learn broad phases with: worlds, entities, a screen and an input, and collision
 * techniques written to be read. Positions are in world units, x to the right and y downwards; times in milliseconds.
 *
 * Every name is exported on its own, and all of them once more as `ro`, so that `import * as ro from 'broadphase/ro'` and
 * `import { ro } from 'broadphase/ro'` mean the same `ro.World`.
 *
 * @module broadphase/ro
 */
export * from './engine.ts';
export * as ro from './engine.ts';

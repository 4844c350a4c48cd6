// The engine's names, in one place: the parts of a game, and the three namespaces math, ov3 and coltech.
export type { AABB, Collidable } from './aabb.ts';
export * as coltech from './coltech/index.ts';
export { Entity } from './entity.ts';
export { Input, type Pointer } from './input.ts';
export * as math from './math.ts';
export * as ov3 from './ov3.ts';
export { Screen } from './screen.ts';
export type { Vector } from './vector.ts';
export { World, type WorldOptions } from './world.ts';

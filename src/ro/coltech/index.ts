/**
 * The collision techniques, all with one interface: any of them can be a world's `coltech`.
 *
 * @module
 */
export { BroadPhase } from './broad-phase.ts';
export { BruteForce } from './brute-force.ts';
export { type CellSize, SpatialGrid } from './spatial-grid.ts';
export { EntityList, type Pair, type Technique } from './technique.ts';

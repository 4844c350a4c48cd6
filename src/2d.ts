/**
 * The types of `broadphase/2d`: those of `broadphase` for two dimensions. The code that runs is index.ts with a kernel
 * for two dimensions only; this file has no code.
 *
 * @module broadphase/2d
 */
import { BroadPhase as Both, type Boxes, type BroadPhaseOptions as Options } from './index.ts';

export * from './index.ts';

/** Options of {@link BroadPhase}, all optional. */
export interface BroadPhaseOptions extends Options<2> {}

/** As in `broadphase`, of two dimensions. */
export declare class BroadPhase<D extends 2 = 2> extends Both<D> {
  constructor(options?: BroadPhaseOptions);
}

/** As in `broadphase`, in two dimensions. */
export declare function findPairs(boxes: Boxes, options?: BroadPhaseOptions): Uint32Array;
/** As in `broadphase`, in two dimensions. */
export declare function findPairsBetween(red: Boxes, blue: Boxes, options?: BroadPhaseOptions): Uint32Array;

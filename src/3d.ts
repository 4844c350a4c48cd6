/**
 * The types of `broadphase/3d`: those of `broadphase` for three dimensions, which are the default. The code that runs
 * is index.ts with a kernel for three dimensions only; this file has no code.
 *
 * @module broadphase/3d
 */
import { BroadPhase as Both, type Boxes, type BroadPhaseOptions as Options } from './index.ts';

export * from './index.ts';

/** Options of {@link BroadPhase}, all optional. */
export interface BroadPhaseOptions extends Options<3> {}

/** As in `broadphase`, of three dimensions. */
export declare class BroadPhase<D extends 3 = 3> extends Both<D> {
  constructor(options?: BroadPhaseOptions);
}

/** As in `broadphase`, in three dimensions. */
export declare function findPairs(boxes: Boxes, options?: BroadPhaseOptions): Uint32Array;
/** As in `broadphase`, in three dimensions. */
export declare function findPairsBetween(red: Boxes, blue: Boxes, options?: BroadPhaseOptions): Uint32Array;

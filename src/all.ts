/**
 * The types of `broadphase/all`: those of `broadphase`, and the names of all techniques. The code that runs is index.ts
 * with another kernel; this file has no code.
 *
 * @module broadphase/all
 */
import type {
  Boxes,
  ConstructorOptions,
  Dimensions,
  BroadPhase as Lean,
  BroadPhaseOptions as Options,
  TechniqueName,
} from './index.ts';

export * from './index.ts';

/** Options of {@link BroadPhase}, all optional. */
export interface BroadPhaseOptions<D extends Dimensions = 2> extends Options<D, TechniqueName> {}

/** The class of `broadphase` without its list of techniques, which is shorter. */
declare const Common: new <D extends Dimensions>(...options: ConstructorOptions<D, TechniqueName>) => Lean<D>;

/** As in `broadphase`, with every technique. */
export declare class BroadPhase<D extends Dimensions = 2> extends Common<D> {
  /** The names of all techniques, in order. */
  static get techniques(): readonly TechniqueName[];
  constructor(...options: ConstructorOptions<D, TechniqueName>);
  override get technique(): TechniqueName;
  override set technique(name: TechniqueName);
}

/** As in `broadphase`, with every technique. */
export declare function findPairs(boxes: Boxes, options?: BroadPhaseOptions<Dimensions>): Uint32Array;
/** As in `broadphase`, with every technique. */
export declare function findPairsBetween(red: Boxes, blue: Boxes, options?: BroadPhaseOptions<Dimensions>): Uint32Array;

import type { BroadPhase, SweepOptions } from 'broadphase';

export interface Body {
  /** The least corner: one number per axis. */
  position: number[] | Float32Array | Float64Array;
  size: ArrayLike<number>;
}

export function moveAndSlide(
  space: BroadPhase<2 | 3>,
  body: Body,
  way: ArrayLike<number>,
  options?: SweepOptions,
  met?: number[],
): number[];

export function moveAndBounce(
  space: BroadPhase<2 | 3>,
  body: Body,
  velocity: number[],
  options?: SweepOptions,
): boolean;

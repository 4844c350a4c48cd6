import type { Plan } from './frames.mjs';

export interface BenchScene {
  boxes: Float32Array | Float64Array;
  step(frame: number): void;
}
export interface Contender {
  give?(boxes: Float32Array | Float64Array): void;
  update(boxes: Float32Array | Float64Array): number;
  walk?(): number;
  pairs(): ArrayLike<number>;
}
export interface Notes {
  frames: number[];
  update: number[];
  pairs: number[];
  found: string[];
  seen: string[];
}
export class Player {
  constructor(scene: BenchScene, contender: Contender, plan: Plan, stride?: number);
  readonly over: boolean;
  readonly notes: Notes;
  play(frames: number): void;
  /** Milliseconds of a frame, once some have been played. */
  probe(frames: number, milliseconds: number): number;
}

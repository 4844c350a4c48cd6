import type { BroadPhase } from '../src/index.ts';
import type { Row } from './coherence.mjs';

export interface Play {
  dimensions: 2 | 3;
  count: number;
  boxes: Float32Array;
  start(space: BroadPhase): void;
  move(space: BroadPhase, frame: number): void;
  ask(space: BroadPhase, frame: number): void;
}
export function openPlay(row: Row, seed: number): Play;

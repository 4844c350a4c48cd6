import type { BroadPhase } from '../src/index.ts';
import type { Row } from './coherence.mjs';

export interface Play {
  dimensions: 2 | 3;
  count: number;
  start(space: BroadPhase): void;
  move(space: BroadPhase, frame: number): void;
  ask(space: BroadPhase, frame: number): void;
}
export function preparePlay(row: Row, seed: number, frames: number): () => Play;

// The counters of the last update, read out of the kernel's memory (kernel/search/stats.hpp).
import type { KernelInstance } from './kernel/instance.ts';
import { type TechniqueName, techniques } from './techniques.ts';

const reasons = [
  'asked for',
  'a handful of boxes',
  'what was found is kept: boxes rest or move little',
  'all is found anew: how boxes move is being watched',
  'all is found anew: boxes move too far, or there are few',
  'all is found anew: after a snapshot, no update before may show in the order of pairs',
] as const;

/** Why a technique ran. */
export type Reason = (typeof reasons)[number];

/** Counters of the last update. */
export interface Stats {
  /** The technique that ran: what `auto` chose. */
  technique: TechniqueName;
  /** Why it ran: where `auto` chose it, what it saw. */
  reason: Reason;
  /** Boxes tested against boxes. */
  tests: number;
  /** Pairs found in float32, before the exact test in double precision and the last of the filters. */
  candidates: number;
  /** Pairs reported. */
  pairs: number;
  /** Cells, strips or nodes in use. */
  cells: number;
  /** Places of boxes in them: more than there are boxes where a box stands in several. */
  entries: number;
  /** Bytes of memory in use by the space. */
  bytes: number;
}

/** One object for all updates, which are to make no garbage. */
export const noStats = (): Stats => ({
  technique: 'auto',
  reason: 'asked for',
  tests: 0,
  candidates: 0,
  pairs: 0,
  cells: 0,
  entries: 0,
  bytes: 0,
});

/** Makes the counters those of the last update. */
export function readStats(instance: KernelInstance, stats: Stats): void {
  const from = instance.statsView();
  stats.tests = from[0]!;
  stats.candidates = from[1]!;
  stats.pairs = from[2]!;
  stats.cells = from[3]!;
  stats.entries = from[4]!;
  stats.bytes = from[5]!;
  stats.technique = techniques[from[6]!]!;
  stats.reason = reasons[from[7]!]!;
}

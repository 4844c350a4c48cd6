// The counters of the last update, read from the kernel's memory (kernel/search/stats.hpp).
import {
  bytesStat,
  candidatesStat,
  cellsStat,
  entriesStat,
  pairsStat,
  reasonStat,
  reasons,
  techniqueStat,
  techniques,
  testsStat,
} from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import type { TechniqueName } from './techniques.ts';

/** Why a technique ran. */
export type Reason = (typeof reasons)[number];

/** Counters of the last update. */
export interface Stats {
  /** The technique that ran: with `auto`, the one it chose. */
  technique: TechniqueName;
  /** Why it ran: with `auto`, the reason for its choice. */
  reason: Reason;
  /** Tests of one box against another. */
  tests: number;
  /** Pairs found in float32, before the exact test in double precision and the last of the filters. */
  candidates: number;
  /** Pairs reported. */
  pairs: number;
  /** Cells, strips or nodes in use. */
  cells: number;
  /** Entries of boxes in them: more than the number of boxes if a box is in several. */
  entries: number;
  /** Bytes of memory in use by the space. */
  bytes: number;
}

/** The counters of the last update, in an object for all updates to come, to make no garbage. */
export function statsOf(instance: KernelInstance): Stats {
  if (instance.stats === undefined) {
    instance.stats = {
      technique: 'auto',
      reason: 'asked for',
      tests: 0,
      candidates: 0,
      pairs: 0,
      cells: 0,
      entries: 0,
      bytes: 0,
    };
    if (instance.exports.updates() > 0) readStats(instance);
  }
  return instance.stats;
}

/** Reads the counters of the last update, if somebody has asked for them: it takes a tenth of a small update. */
export function readStats(instance: KernelInstance): void {
  const { stats } = instance;
  if (stats === undefined) return;
  const from = instance.statsView();
  stats.tests = from[testsStat]!;
  stats.candidates = from[candidatesStat]!;
  stats.pairs = from[pairsStat]!;
  stats.cells = from[cellsStat]!;
  stats.entries = from[entriesStat]!;
  stats.bytes = from[bytesStat]!;
  stats.technique = techniques[from[techniqueStat]!]!;
  stats.reason = reasons[from[reasonStat]!]!;
}

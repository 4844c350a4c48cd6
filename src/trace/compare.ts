// All techniques on the same frames, side by side.
import { BroadPhase, type TechniqueName } from 'broadphase';
import { badNumber, checkOptions } from '../errors.ts';
import { checkProgress, checkSource, checkTechniques, type FrameSource, worldOf } from './format.ts';
import { begin, type ReplayOptions, spaceOptions, timeUpdate, withSpaces } from './replay.ts';
import { type Summary, summarize } from './statistics.ts';

/** Options of {@link compare}, including those of the spaces to compare. */
export interface CompareOptions extends Omit<ReplayOptions, 'technique'> {
  /** Which techniques. Default: all of {@link BroadPhase.techniques}. */
  techniques?: readonly TechniqueName[] | undefined;
  /** How many times the frames are run, from 1 on; each frame counts with its fastest time. Default 3. */
  passes?: number | undefined;
  /** Called after each frame of each pass. */
  progress?: ((done: number, total: number) => void) | undefined;
}

/** How one technique did. */
export interface Compared {
  /** Its name. */
  technique: TechniqueName;
  /** Milliseconds of `update()` of each frame; the first, which starts from nothing, is not in the summary. */
  times: number[];
  /** The summary of the times. */
  ms: Summary;
  /** Tests of one box against another in a frame, on average. */
  tests: number;
  /** The most memory in use, in bytes. */
  bytes: number;
  /** The technique that ran: with `auto`, the one it chose. */
  ran: TechniqueName[];
  /** The first frame whose pairs differ from those of the first technique; `null` if all agree. */
  disagrees: number | null;
}

/**
 * Runs the frames with every technique, in turns within each frame, so that other load on the machine affects all
 * alike.
 *
 * @returns one result for each technique, in the given order
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const results = compare(openTrace(recording.bytes()), { techniques: ['brute-force', 'strip-sweep'], passes: 1 });
 * results.map(({ technique }) => technique); // → ['brute-force', 'strip-sweep']
 * results[1].disagrees; // → null
 */
export function compare(source: FrameSource, options: CompareOptions = {}): Compared[] {
  checkSource('compare', source);
  const own = ['techniques', 'passes', 'progress'];
  checkOptions('compare', options, [...own, ...spaceOptions.filter((name) => name !== 'technique')]);
  const { techniques = BroadPhase.techniques, passes = 3, progress, ...settings } = options;
  checkTechniques('compare', techniques);
  if (!(Number.isInteger(passes) && passes > 0)) badNumber('compare: passes', passes, 'an integer, 1 or more');
  checkProgress('compare', progress);
  const { dimensions } = source;
  const each = techniques.map((technique) => ({ ...worldOf(source, settings), technique, dimensions }));
  return withSpaces(each, (spaces) => {
    const contenders = techniques.map((technique, k) => ({
      technique,
      space: spaces[k],
      times: [] as number[],
      tests: 0,
      bytes: 0,
      ran: new Set<TechniqueName>(),
      disagrees: null as number | null,
    }));
    for (let pass = 0; pass < passes; pass++) {
      for (const frame of source) {
        let expected: number | undefined;
        for (const contender of contenders) {
          const { space, times } = contender;
          if (frame.index === 0) begin(space, frame, pass === 0);
          const ms = timeUpdate(space, frame);
          times[frame.index] = pass === 0 ? ms : Math.min(ms, times[frame.index]);
          if (pass > 0) continue;
          contender.tests += space.stats.tests;
          contender.bytes = Math.max(contender.bytes, space.stats.bytes);
          contender.ran.add(space.stats.technique);
          const digest = pairsDigest(space.pairs);
          expected ??= digest;
          if (digest !== expected) contender.disagrees ??= frame.index;
        }
        progress?.(pass * source.frames + frame.index + 1, passes * source.frames);
      }
    }
    return contenders.map(({ technique, times, tests, bytes, ran, disagrees }) => ({
      technique,
      times,
      ms: summarize(times.length > 1 ? times.slice(1) : times),
      tests: tests / Math.max(1, source.frames),
      bytes,
      ran: [...ran],
      disagrees,
    }));
  });
}

/** A hash of the pairs that does not depend on their order. */
export function pairsDigest(pairs: Uint32Array): number {
  let low = 0;
  let high = pairs.length;
  for (let k = 0; k < pairs.length; k += 2) {
    let mixed = Math.imul(pairs[k] ^ 0x9e3779b9, 0x85ebca6b) ^ Math.imul(pairs[k + 1], 0xc2b2ae35);
    mixed = Math.imul(mixed ^ (mixed >>> 15), 0x2c1b3c6d);
    low = (low + mixed) | 0;
    high = (high + Math.imul(mixed ^ (mixed >>> 13), 0x297a2d39)) | 0;
  }
  return (high >>> 0) * 2 ** 21 + (low >>> 11);
}

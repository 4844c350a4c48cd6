// Which technique, and which cell size or margin, for these frames? Tries all techniques on a few frames, searches the
// parameters of those that have any, one after the other, and lets the best run against each other, and against `auto`,
// on all frames.
//
// Machines are noisy, so every time is the fastest of several, candidates take turns, and those far behind the best are
// dropped early. Whether a technique uses a parameter at all is found by trying: its counters change.
import { BroadPhase, type TechniqueName } from 'broadphase';
import { badNumber, checkBoolean, checkOptions, isSize } from '../errors.ts';
import type { World } from '../watch.ts';
import { checkProgress, checkSource, checkTechniques, type Frame, type FrameSource, worldOf } from './format.ts';
import { applyFrame, begin, timeUpdate, withSpaces } from './replay.ts';
import { percentile, type Summary, summarize } from './statistics.ts';
import { longestSides } from './survey.ts';

/** Options of {@link tune}. */
export interface TuneOptions {
  /** Which techniques are tried. Default: all of {@link BroadPhase.techniques}. `auto` is always measured too. */
  techniques?: readonly TechniqueName[] | undefined;
  /** For how many seconds the finalists run against each other. Default 8. */
  seconds?: number | undefined;
  /** Tries every technique with every value of each parameter on all frames: slow; serves to check the search. */
  exhaustive?: boolean | undefined;
  /** Called now and then with what is being done, and the progress. */
  progress?: ((what: string, done: number, total: number) => void) | undefined;
}

/** Options for `new BroadPhase`. */
export interface Candidate {
  /** Its name. */
  technique: TechniqueName;
  /** As in `BroadPhaseOptions`. Default: chosen from the boxes. */
  cellSize?: number;
  /** The same. */
  margin?: number;
}

/** A parameter that is searched. */
export type Parameter = 'cellSize' | 'margin';

/**
 * The range of each, in quarters of a doubling, relative to the typical box: cells from 1/4 to 256 times its size,
 * margins from 1/64 to 4 times.
 */
const searched: readonly { parameter: Parameter; least: number; most: number }[] = [
  { parameter: 'cellSize', least: -8, most: 32 },
  { parameter: 'margin', least: -24, most: 8 },
];

/** A candidate, and how it did. */
export interface Measured extends Candidate {
  /** Milliseconds of `update()` for each frame: the fastest of all passes. */
  times: number[];
  /** The summary of the times. */
  ms: Summary;
}

/** How a candidate did on a few frames. */
export interface Screened extends Candidate {
  /** Mean milliseconds of `update()`. */
  ms: number;
}

/** How the time of a technique depends on a parameter. */
export interface Curve {
  /** Whose time. */
  technique: TechniqueName;
  /** On what. */
  parameter: Parameter;
  /** Values of the parameter, ascending, each with mean milliseconds of `update()`. */
  points: CurvePoint[];
}

/** One point of a {@link Curve}. */
export interface CurvePoint {
  /** Of the parameter. */
  value: number;
  /** Mean milliseconds of `update()`. */
  ms: number;
}

/** A frame that counts. */
export interface TunedFrame {
  /** Its place in the trace, from 0. */
  index: number;
  /** How many boxes there are. */
  boxes: number;
  /** How many of them are new or moved. */
  changed: number;
  /** How many pairs there are. */
  pairs: number;
}

/** The best options for the frames: see {@link tune}. */
export interface Tuned {
  /** The recommendation; `auto` itself if nothing is faster by more than the noise. */
  best: Measured;
  /** How `auto` did. */
  auto: Measured;
  /** The time of `auto` divided by that of the recommendation. */
  margin: number;
  /** The noise: `auto` runs twice, and this is the relative difference of the two means. */
  noise: number;
  /** All candidates that ran on all frames, fastest first. */
  finalists: Measured[];
  /** Mean milliseconds of each technique on a few frames, in its best setting, fastest first. */
  techniques: Screened[];
  /** The same for each value of a parameter, for techniques that use it. */
  curves: Curve[];
  /** The frames that count: all whose previous frame was used too, of all frames or of windows of a long trace. */
  frames: TunedFrame[];
  /** To paste. */
  code: string;
}

/** The most bytes of frames to keep in memory while tuning; of longer traces, windows are kept. */
const keptBytes = 2 ** 27;
const windows = 4;

/**
 * Screening uses this many frames from the middle, and the one before them, in as many passes as fit in this many
 * milliseconds, within limits.
 */
const screenFrames = 11;
const screenTime = 40;
const screenPasses = { least: 3, most: 20 };

/** Candidates this many times slower than the best so far, or than the best of their technique, are stopped early. */
const hopeless = { atAll: 20, ofTechnique: 4 };

/**
 * Finalists: at most this much slower than the best in screening, at most this many, and at most this many of one
 * technique, since a setting may look better on a few frames than on all.
 */
const closeEnough = 1.5;
const mostFinalists = 6;
const mostOfTechnique = 2;
const leastPasses = 3;
const mostPasses = 25;

/**
 * A gain over `auto` below this share is not worth an option that may not suit the next level; nor is one below this
 * many times the noise, which is the difference of two runs of `auto`.
 */
const worthwhile = 1.03;
export const timesNoise = 2;
/**
 * Milliseconds per frame: a gain below the first does not justify an option, nor one below the second, 0.6 % of a frame
 * at 60 Hz, loading 'broadphase/all'.
 */
const worthAnOption = 0.01;
const worthLoading = 0.1;

/**
 * Finds the technique, cell size and margin that suit these frames best: tries all techniques on a few frames, searches
 * the parameters of those that have any, and lets the best run against each other and against `auto` on all frames.
 *
 * @throws RangeError if there are no frames
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const { code, frames } = tune(openTrace(recording.bytes()), { techniques: ['brute-force'], seconds: 0.01 });
 * code.includes('const space = new BroadPhase('); // → true
 * frames.length; // → 2
 */
export function tune(source: FrameSource, options: TuneOptions = {}): Tuned {
  checkSource('tune', source);
  checkOptions('tune', options, ['techniques', 'seconds', 'exhaustive', 'progress']);
  const { techniques = BroadPhase.techniques, seconds = 8, exhaustive = false, progress } = options;
  checkTechniques('tune', techniques);
  if (!isSize(seconds)) badNumber('tune: seconds', seconds, 'a number, at least 0');
  checkBoolean('tune: exhaustive', exhaustive);
  checkProgress('tune', progress);
  const { dimensions } = source;
  const frames = keepFrames(source);
  if (frames.length === 0) throw new RangeError('tune: the trace has no frames');
  const middle = Math.max(0, (frames.length - screenFrames) >> 1);
  const few = exhaustive ? frames : frames.slice(middle, middle + screenFrames);

  const { screened, curves } = screenAll(techniques, few, dimensions, exhaustive, progress);
  const close = closest(screened);
  // A second `auto`, at the other end of the turns, measures the noise of the machine.
  const twin: Candidate = { technique: 'auto' };
  const ran = runFinal([twin, ...close], dimensions, frames, seconds, (done) => progress?.('final', done, 1));
  const second = ran.find(({ candidate }) => candidate === twin)!.measured;
  const finalists = ran.map(({ measured }) => measured).filter((measured) => measured !== second);
  const auto = finalists.find(isAuto)!;
  const noise = Math.abs(second.ms.mean / auto.ms.mean - 1) || 0;
  const best = finalists.find((each) => isWorth(each, auto, noise)) ?? auto;
  return {
    best,
    auto,
    margin: auto.ms.mean / best.ms.mean,
    noise,
    finalists,
    techniques: techniques.map((name) => screened.find(({ technique }) => technique === name)!).sort(byTime),
    curves,
    frames: counted(frames, describeFrames(frames, dimensions)),
    code: codeOf(best, dimensions, source),
  };
}

/** Screens every technique on a few frames, with each value of its parameters that is worth trying; fastest first. */
function screenAll(
  techniques: readonly TechniqueName[],
  few: readonly Frame[],
  dimensions: 2 | 3,
  exhaustive: boolean,
  progress: TuneOptions['progress'],
): { screened: Screened[]; curves: Tuned['curves'] } {
  const screened: Screened[] = [];
  const curves: Tuned['curves'] = [];
  let fastest = Infinity;
  let fastestOfTechnique = Infinity;
  const screen = (candidate: Candidate): number => {
    const limit = Math.min(hopeless.atAll * fastest, hopeless.ofTechnique * fastestOfTechnique);
    const ms = measure(candidate, dimensions, few, limit);
    fastest = Math.min(fastest, ms);
    fastestOfTechnique = Math.min(fastestOfTechnique, ms);
    screened.push({ ...candidate, ms });
    return ms;
  };
  techniques.forEach((technique, k) => {
    progress?.(technique, k, techniques.length);
    fastestOfTechnique = Infinity;
    screen({ technique });
    if (technique === 'auto') return;
    const typical = typicalSide(few[0], dimensions);
    // Each parameter is searched with the best of those before it.
    let found: Candidate = { technique };
    for (const { parameter, least, most } of searched) {
      if (!usesParameter(found, parameter, dimensions, few)) continue;
      const begun = screened.length;
      const at = (steps: number) => screen({ ...found, [parameter]: rounded(typical * 2 ** (steps / 4)) });
      if (exhaustive) for (let steps = least; steps <= most; steps++) at(steps);
      else searchSteps(at, least, most);
      const points = screened.slice(begun).map(({ ms, ...candidate }) => ({ value: candidate[parameter]!, ms }));
      curves.push({ technique, parameter, points: points.sort((a, b) => a.value - b.value) });
      const { ms: _, ...best } = screened.filter((each) => each.technique === technique).sort(byTime)[0];
      found = best;
    }
  });
  screened.sort(byTime);
  return { screened, curves };
}

/** Selects the finalists, which run on all frames, fastest first; `auto` is always among them. */
function closest(screened: readonly Screened[]): Candidate[] {
  const close: Candidate[] = [];
  for (const { ms, ...candidate } of screened) {
    const ofTechnique = close.filter(({ technique }) => technique === candidate.technique).length;
    if (close.length === mostFinalists || ms > closeEnough * screened[0].ms) break;
    if (ofTechnique < mostOfTechnique) close.push(candidate);
  }
  if (!close.some(isAuto)) close.push({ technique: 'auto' });
  return close;
}

const byTime = (a: { ms: number }, b: { ms: number }) => a.ms - b.ms;
/** Whether a finalist is worth recommending instead of `auto`. */
const isWorth = ({ technique, ms }: Measured, auto: Measured, noise: number) =>
  auto.ms.mean / ms.mean >= Math.max(worthwhile, 1 + timesNoise * noise) &&
  auto.ms.mean - ms.mean >= (isLean(technique) ? worthAnOption : worthLoading);

const isAuto = ({ technique }: Candidate) => technique === 'auto';

/** Rounds to three digits, so that the value measured is the value recommended. */
const rounded = (value: number) => Number(value.toPrecision(3));

/**
 * Copies of all frames, or of evenly spaced windows of successive frames, which techniques that retain structure need.
 */
function keepFrames(source: FrameSource): Frame[] {
  const kept: Frame[] = [];
  let largest = 1; // the first frame may come before the level is loaded
  for (const { boxes } of source) largest = Math.max(largest, boxes.byteLength);
  const allowed = Math.min(source.frames, Math.max(windows, Math.floor(keptBytes / largest)));
  for (const frame of source) {
    const windowLength = Math.ceil(allowed / windows);
    if (allowed < source.frames && frame.index % Math.ceil(source.frames / windows) >= windowLength) continue;
    kept.push({
      ...frame,
      ...worldOf(source),
      boxes: frame.boxes.slice(),
      ids: frame.ids?.slice(),
      rules: frame.rules?.slice(),
      groups: frame.groups?.slice(),
      reaches: frame.reaches?.slice(),
    });
  }
  return kept;
}

/**
 * Whether the previous frame of a frame is missing in the list. Such a frame is played, for those after it, but does
 * not count, unless there are no others.
 */
function leads(frames: readonly Frame[], k: number): boolean {
  return k === 0 || frames[k].index !== frames[k - 1].index + 1;
}

/** The values of the frames that count. */
function counted<T>(frames: readonly Frame[], values: readonly T[]): T[] {
  const following = values.filter((_, k) => !leads(frames, k));
  return following.length > 0 ? following : [...values];
}

/**
 * Mean milliseconds per frame. Stops early if the mean is certain to exceed `limit`, in two passes, since one may be
 * noise. Frames differ, and a frame cannot be timed again on its own, so only their sum counts.
 */
function measure(candidate: Candidate, dimensions: 2 | 3, frames: readonly Frame[], limit: number): number {
  return withSpaces([optionsOf(candidate, dimensions, frames)], ([space]) => {
    const times: number[] = [];
    const { least, most } = screenPasses;
    const allowed = limit * counted(frames, [...frames.keys()]).length;
    const started = performance.now();
    let strikes = 0;
    for (
      let pass = 0;
      pass < most && (pass < least || performance.now() - started < screenTime) && strikes < 2;
      pass++
    ) {
      let spent = 0;
      for (let k = 0; k < frames.length && spent <= allowed; k++) {
        if (k === 0) begin(space, frames[0], pass === 0);
        const ms = timeUpdate(space, frames[k]);
        if (!leads(frames, k)) spent += ms;
        times[k] = Math.min(ms, times[k] ?? Infinity);
      }
      if (spent > allowed) strikes++;
    }
    const mean = meanOf(counted(frames, times));
    return strikes < 2 ? mean : Math.max(limit, mean);
  });
}

/** The options of a space for a candidate, in the world of the frames. */
const optionsOf = (candidate: Candidate, dimensions: 2 | 3, [first]: readonly Frame[]) => ({
  ...worldOf(first),
  ...candidate,
  dimensions,
});

const meanOf = (times: readonly number[]) => times.reduce((sum, ms) => sum + ms, 0) / times.length;

/** Whether another value of a parameter changes the technique's counters, on some frames. */
export function usesParameter(
  candidate: Candidate,
  parameter: Parameter,
  dimensions: 2 | 3,
  frames: readonly Frame[],
): boolean {
  const options = optionsOf(candidate, dimensions, frames);
  const two = [1, 8].map((sides) => ({ ...options, [parameter]: rounded(sides * typicalSide(frames[0], dimensions)) }));
  return withSpaces(two, (spaces) =>
    frames.some((frame) => {
      const [one, other] = spaces.map((space) => {
        applyFrame(space, frame);
        const { tests, cells, entries } = space.update().stats;
        return `${tests} ${cells} ${entries}`;
      });
      return one !== other;
    }),
  );
}

/** The median of the boxes' longest sides. */
export function typicalSide(frame: Pick<Frame, 'boxes'>, dimensions: 2 | 3): number {
  const sides = longestSides(frame.boxes, dimensions).filter((side) => side > 0 && Number.isFinite(side));
  return percentile(sides.sort(), 0.5) || 1;
}

/**
 * Finds a minimum of the cost over a parameter, in quarters of a doubling relative to the typical box: first by
 * doublings, while the cost improves or hardly worsens, then in finer steps around the best.
 */
function searchSteps(costAt: (steps: number) => number, least: number, most: number): void {
  const tried = new Map<number, number>();
  const cost = (steps: number) => {
    const known = tried.get(steps) ?? costAt(steps);
    tried.set(steps, known);
    return known;
  };
  let best = 0;
  const look = (steps: number) => {
    if (cost(steps) < cost(best)) best = steps;
    return cost(steps) < 2 * cost(best);
  };
  look(0);
  for (const direction of [4, -4]) {
    let worse = 0;
    for (let steps = direction; steps <= most && steps >= least && worse < 2; steps += direction) {
      worse = look(steps) ? 0 : worse + 1;
    }
  }
  for (const step of [2, 1]) {
    const centre = best;
    look(centre - step);
    look(centre + step);
  }
}

/** Runs all finalists in turns until the time is over; fastest first. */
function runFinal(
  candidates: readonly Candidate[],
  dimensions: 2 | 3,
  frames: readonly Frame[],
  seconds: number,
  progress: (done: number) => void,
): { candidate: Candidate; measured: Measured }[] {
  const each = candidates.map((candidate) => optionsOf(candidate, dimensions, frames));
  return withSpaces(each, (spaces) => {
    const runs = candidates.map((candidate, k) => ({ candidate, space: spaces[k], times: [] as number[] }));
    const started = performance.now();
    for (let pass = 0; pass < mostPasses; pass++) {
      const spent = (performance.now() - started) / 1000 / seconds;
      progress(Math.min(1, Math.max(spent, pass / mostPasses)));
      if (pass >= leastPasses && spent > 1) break;
      for (const { space, times } of runs) {
        for (const [k, frame] of frames.entries()) {
          if (k === 0) begin(space, frame, pass === 0);
          const ms = timeUpdate(space, frame);
          times[k] = pass === 0 ? ms : Math.min(ms, times[k]);
        }
      }
    }
    return runs
      .map(({ candidate, times }) => {
        const those = counted(frames, times);
        return { candidate, measured: { ...candidate, times: those, ms: summarize(those) } };
      })
      .sort((a, b) => a.measured.ms.mean - b.measured.ms.mean);
  });
}

function describeFrames(frames: readonly Frame[], dimensions: 2 | 3): Tuned['frames'] {
  return withSpaces([optionsOf({ technique: 'auto' }, dimensions, frames)], ([space]) =>
    frames.map((frame) => {
      applyFrame(space, frame);
      const pairs = space.update().pairCount;
      return { index: frame.index, boxes: frame.count, changed: frame.changed, pairs };
    }),
  );
}

/** The techniques of `import 'broadphase'`; for others, the code to paste imports from 'broadphase/all'. */
const lean: readonly TechniqueName[] = ['auto', 'brute-force', 'strip-sweep', 'incremental'];
export const isLean = (technique: TechniqueName): boolean => lean.includes(technique);

export function codeOf(
  { technique, cellSize, margin }: Candidate,
  dimensions: 2 | 3,
  { wrap, touching = true }: World = {},
): string {
  const options = [
    dimensions === 3 ? 'dimensions: 3' : '',
    wrap ? `wrap: [${wrap.join(', ')}]` : '',
    touching ? '' : 'touching: false',
    technique === 'auto' ? '' : `technique: '${technique}'`,
    cellSize === undefined ? '' : `cellSize: ${cellSize}`,
    margin === undefined ? '' : `margin: ${margin}`,
  ].filter(Boolean);
  const space = `const space = new BroadPhase(${options.length > 0 ? `{ ${options.join(', ')} }` : ''});`;
  return `import { BroadPhase } from 'broadphase${isLean(technique) ? '' : '/all'}';\n\n${space}`;
}

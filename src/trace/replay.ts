// Plays frames into a BroadPhase and measures each update.
import { BroadPhase, type BroadPhaseOptions, type TechniqueName } from 'broadphase';
import { badValue, checkBoolean, checkOptions } from '../errors.ts';
import { optionNames } from '../options.ts';
import { checkSpace } from '../watch.ts';
import { checkFrame, isDoubles } from './check-frame.ts';
import { type Difference, differenceOf, exactPairs, pairKeys } from './exact.ts';
import { checkSource, type Frame, type FrameSource, marks, worldOf } from './format.ts';
import { all, IdSet } from './state.ts';

/** The last frame played into a space: a copy, since frames are views. */
interface Applied {
  count: number;
  ids: Uint32Array | undefined;
  rules: Uint32Array | undefined;
  groups: Uint32Array | undefined;
  reaches: Float64Array | undefined;
}

const applied = new WeakMap<BroadPhase<2 | 3>, Applied>();

const seen = new IdSet();

/**
 * Replaces the boxes and rules of a space by those of a frame, in their recorded order. The caller calls `update()`.
 * Nothing else may change the space between two frames: of the rules, only differences are set. Boxes are given by
 * `setAll` if their ids are 0, 1, 2, …, otherwise by `set`. If the recorded space was given them in the same way from its
 * first update on, pairs come in the same order too; otherwise `auto` and `incremental` may give another order. After a
 * `snapshot()` of both spaces, each before its first update, the order is always the same, and updates are slower. If ids
 * change, the space is filled again: all its pairs end and begin.
 *
 * @throws RangeError if the space has other dimensions, for a bad box, id or reach, and if lengths do not fit; TypeError
 * for anything but a space and a frame. The space is as before.
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const copy = new BroadPhase();
 * for (const frame of openTrace(recording.bytes())) {
 *   applyFrame(copy, frame);
 *   copy.update();
 * }
 * copy.pairs; // → Uint32Array [7, 9]
 */
export function applyFrame(space: BroadPhase<2 | 3>, frame: Frame): void {
  checkSpace('applyFrame', space);
  if (!frame) badValue('applyFrame', frame, 'a frame of a trace', true);
  const { ids, boxes, count } = frame;
  const { dimensions } = space;
  isDoubles('applyFrame', boxes);
  const theirs = boxes.length / count / 2;
  if (count > 0 && theirs !== dimensions) {
    throw new RangeError(`applyFrame: got a frame of ${theirs} dimensions, expected ${dimensions}`);
  }
  checkFrame('applyFrame', dimensions, count, frame, seen);
  let before = applied.get(space);
  // Boxes with explicit ids are in the order in which they were set, so if ids differ, the space is filled again.
  if (!before || !sameIds(before.ids, ids) || (ids && space.size !== count)) {
    space.clear();
    before = { count: 0, ids: ids?.slice(), rules: undefined, groups: undefined, reaches: undefined };
    applied.set(space, before);
  }
  if (!ids) space.setAll(boxes);
  else if (dimensions === 2) {
    for (let k = 0, at = 0; k < count; k++, at += 4) {
      space.set(ids[k], boxes[at], boxes[at + 1], boxes[at + 2], boxes[at + 3]);
    }
  } else {
    for (let k = 0, at = 0; k < count; k++, at += 6) {
      space.set(ids[k], boxes[at], boxes[at + 1], boxes[at + 2], boxes[at + 3], boxes[at + 4], boxes[at + 5]);
    }
  }
  if (frame.rules || before.rules) applyRules(space, frame, before);
  if (frame.groups || before.groups) {
    applyEach(frame, frame.groups, before, before.groups, (id, group) => space.setGroup(id, group));
    before.groups = frame.groups?.slice();
  }
  if (frame.reaches || before.reaches) {
    applyEach(frame, frame.reaches, before, before.reaches, (id, reach) => space.setReach(id, reach));
    before.reaches = frame.reaches?.slice();
  }
  before.count = count;
}

/** Sets the number of each box (group or reach) if it differs from before; the default is 0. */
function applyEach(
  { ids, count }: Frame,
  now: ArrayLike<number> | undefined,
  before: Applied,
  were: ArrayLike<number> | undefined,
  give: (id: number, value: number) => void,
): void {
  for (let place = 0; place < count; place++) {
    const value = now?.[place] ?? 0;
    const was = place < before.count ? (were?.[place] ?? 0) : 0;
    if (value !== was) give(ids ? ids[place] : place, value);
  }
}

function applyRules(space: BroadPhase<2 | 3>, { ids, rules, count }: Frame, before: Applied): void {
  const were = before.rules;
  const had = were ? Math.min(before.count, count) : 0;
  let changed = before.count !== count;
  for (let place = 0, k = 0; place < count; place++, k += 3) {
    const layer = rules ? rules[k] : all;
    const mask = rules ? rules[k + 1] : all;
    const its = rules ? rules[k + 2] : 0;
    const known = were !== undefined && place < had;
    const filtered = layer !== (known ? were[k] : all) || mask !== (known ? were[k + 1] : all);
    const differ = its ^ (known ? were[k + 2] : 0);
    const id = ids ? ids[place] : place;
    if (filtered) space.setFilter(id, layer, mask);
    if (differ & marks.still) space.setStatic(id, (its & marks.still) !== 0);
    if (differ & marks.off) space.setEnabled(id, (its & marks.off) === 0);
    changed ||= filtered || differ !== 0;
  }
  if (changed) before.rules = rules?.slice();
}

function sameIds(a: Uint32Array | undefined, b: Uint32Array | undefined): boolean {
  if (!a || !b) return a === b;
  if (a.length !== b.length) return false;
  for (let k = 0; k < a.length; k++) if (a[k] !== b[k]) return false;
  return true;
}

/** Options of a space to play frames into, which determine its dimensions. */
export type ReplayOptions = Omit<BroadPhaseOptions, 'dimensions'>;

/** Their names. */
export const spaceOptions = optionNames.filter((name) => name !== 'dimensions');

/** The time and the results of one update of a replay. */
export interface ReplayedFrame {
  /** From 0. */
  index: number;
  /** How many boxes there were. */
  boxes: number;
  /** How many of them are new or moved. */
  changed: number;
  /** Milliseconds of `update()` alone. */
  ms: number;
  /** The technique that ran. */
  technique: TechniqueName;
  /** As in the `stats` of a space, like those that follow: tests of one box against another. */
  tests: number;
  /** Pairs found in float32. */
  candidates: number;
  /** Pairs reported. */
  pairs: number;
  /** Cells, strips or nodes in use. */
  cells: number;
  /** Places of boxes in them. */
  entries: number;
  /** Bytes of memory in use. */
  bytes: number;
  /** If it was checked: how the pairs differ from the exact answer, or `null` if they do not. */
  difference?: Difference | null;
}

/**
 * Runs all frames, with one result for each. The first starts from nothing, all others from the previous frame.
 * @param verify compare the pairs of each frame with an exact sweep, written independently of the kernel
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const played = [...replay(openTrace(recording.bytes()), { technique: 'strip-sweep' }, true)];
 * played.map(({ pairs }) => pairs); // → [0, 1, 1]
 * played[2].difference; // → null
 */
export function* replay(source: FrameSource, options: ReplayOptions = {}, verify = false): Generator<ReplayedFrame> {
  checkSource('replay', source);
  checkOptions('replay', options, spaceOptions);
  checkBoolean('replay: verify', verify);
  const { dimensions } = source;
  const world = worldOf(source, options);
  const space = new BroadPhase({ ...world, dimensions });
  try {
    for (const frame of source) {
      if (frame.index === 0) begin(space, frame, true);
      const ms = timeUpdate(space, frame);
      const { technique, tests, candidates, pairs, cells, entries, bytes } = space.stats;
      const { index, count: boxes, changed } = frame;
      const result = { index, boxes, changed, ms, technique, tests, candidates, pairs, cells, entries, bytes };
      if (!verify) {
        yield result;
        continue;
      }
      const own = { ...frame, touching: world.touching };
      const expected = exactPairs(frame.boxes, dimensions, frame.ids, frame.rules, world.wrap, own);
      yield { ...result, difference: differenceOf(pairKeys(space.pairs), expected) ?? null };
    }
  } finally {
    space.dispose();
  }
}

/** Runs with a space for each of the options. All are disposed of, however it ends. */
export function withSpaces<Result>(
  options: readonly BroadPhaseOptions<2 | 3>[],
  run: (spaces: readonly BroadPhase<2 | 3>[]) => Result,
): Result {
  const spaces: BroadPhase<2 | 3>[] = [];
  try {
    for (const each of options) spaces.push(new BroadPhase(each as { dimensions: 2 | 3 }));
    return run(spaces);
  } finally {
    for (const space of spaces) space.dispose();
  }
}

/**
 * Engines recompile code that has run for a while, so it runs for this many milliseconds, and updates, before it is
 * timed.
 */
const warmUpTime = 30;
const warmUpUpdates = 50;

/** Empties a space, so that techniques drop the structure they retain. */
function startOver(space: BroadPhase<2 | 3>): void {
  applied.delete(space);
  space.clear();
  space.update();
}

/**
 * Prepares a space for a first frame, whose update then starts from nothing.
 * @param cold whether the space has not run yet: then the frame is played a few times
 */
export function begin(space: BroadPhase<2 | 3>, frame: Frame, cold: boolean): void {
  const begun = performance.now();
  for (let k = 0; cold && k < warmUpUpdates && performance.now() - begun < warmUpTime; k++) {
    startOver(space);
    applyFrame(space, frame);
    space.update();
  }
  startOver(space);
}

/**
 * Plays one frame, and returns the milliseconds of its update. The space must have the previous frame, since the time
 * of techniques that retain structure depends on how much has moved.
 */
export function timeUpdate(space: BroadPhase<2 | 3>, frame: Frame): number {
  applyFrame(space, frame);
  const started = performance.now();
  space.update();
  return performance.now() - started;
}

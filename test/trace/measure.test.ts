// Times are those of a game: each frame is measured after the one before it, never twice in a row, since techniques
// that keep their structure have nothing to do where nothing has moved.
import { BroadPhase } from 'broadphase';
import { compare, type Frame, type FrameSource, replay, survey, tune } from 'broadphase/trace';
import { afterEach, beforeEach, expect, test } from 'vitest';
import { lean } from '../../scripts/compile.mjs';
import { codeOf } from '../../src/trace/tune.ts';

const { update } = BroadPhase.prototype;
/** What the updates of each space saw: the frame, which box 0 tells by where it is, or -1 where it was empty. */
let seen: Map<BroadPhase, number[]>;

beforeEach(() => {
  seen = new Map();
  BroadPhase.prototype.update = function (this: BroadPhase) {
    const frames = seen.get(this) ?? [];
    seen.set(this, [...frames, this.size === 0 ? -1 : this.get(0)![0]]);
    return update.call(this);
  };
});
afterEach(() => {
  BroadPhase.prototype.update = update;
});

/** A trace of 40 boxes that all move by 1 per frame. */
function moving(frames: number): FrameSource {
  return {
    dimensions: 2,
    frames,
    *[Symbol.iterator](): Generator<Frame> {
      for (let index = 0; index < frames; index++) {
        const boxes = Float32Array.from({ length: 160 }, (_, k) => index + 3 * (k >> 2) + ((k % 4) >> 1) * 4);
        yield { index, count: 40, ids: undefined, boxes, changed: 40 };
      }
    },
  };
}

test.each([
  ['replay', (source: FrameSource) => [...replay(source)]],
  ['compare', (source: FrameSource) => compare(source)],
  ['tune', (source: FrameSource) => tune(source, { seconds: 0 })],
  ['tune, exhaustively', (source: FrameSource) => tune(source, { seconds: 0, exhaustive: true })],
])('%s plays each frame after the one before it, or from nothing', { tags: 'long' }, (_, measure) => {
  measure(moving(9));
  expect(seen.size).toBeGreaterThan(0);
  for (const frames of seen.values()) {
    for (let k = 1; k < frames.length; k++) {
      const [before, now] = [frames[k - 1], frames[k]];
      if (before < 0 || now < 0) continue; // from nothing, or to it
      expect(Math.abs(now - before), frames.join()).toBe(1);
    }
  }
});

test('the first frame, which starts from nothing, does not count where others do', () => {
  const [result] = compare(moving(4), { techniques: ['auto'] });
  expect(result.times).toHaveLength(4);
  expect(result.ms.max).toBe(Math.max(...result.times.slice(1)));
  const { frames, best } = tune(moving(4), { seconds: 0 });
  expect(frames.map(({ index }) => index)).toEqual([1, 2, 3]);
  expect(best.times).toHaveLength(3);
  expect(tune(moving(1), { seconds: 0 }).frames).toHaveLength(1);
});

test.each(BroadPhase.techniques)('code to paste for %s imports the build that has it', (technique) => {
  const code = codeOf({ technique }, 2);
  const library = lean.includes(technique) ? 'broadphase' : 'broadphase/all';
  expect(code).toMatch(
    new RegExp(`^import \\{ BroadPhase \\} from '${library}';\\n\\nconst space = new BroadPhase\\(`),
  );
});

test('the histogram of sizes has a bin for each doubling in between, and one for zeros', () => {
  const boxes = Float32Array.from([0, 1, 1, 5, 40, Infinity].flatMap((size) => [0, 0, size, 0]));
  const source: FrameSource = {
    dimensions: 2,
    frames: 1,
    *[Symbol.iterator](): Generator<Frame> {
      yield { index: 0, count: 6, ids: undefined, boxes, changed: 6 };
    },
  };
  expect(survey(source).histograms.side.map(({ from, to, count }) => [from, to, count])).toEqual([
    [0, 0, 1],
    [1, 2, 2],
    [2, 4, 0],
    [4, 8, 1],
    [8, 16, 0],
    [16, 32, 0],
    [32, 64, 1],
  ]);
});

// Options and arrays that `broadphase/trace` took, or blamed on another call, although they did not fit.
import { BroadPhase } from 'broadphase';
import {
  applyFrame,
  compare,
  exactPairs,
  type Frame,
  gunzip,
  importRecording,
  openAny,
  openTrace,
  record,
  replay,
  survey,
  TraceWriter,
  tune,
} from 'broadphase/trace';
import { describe, expect, test } from 'vitest';

const loose = (value: unknown) => value as never;
const none = [undefined, undefined, undefined] as const;
const boxes = [0, 0, 1, 1, 0, 0, 1, 1];
const recorded = new BroadPhase();
const recording = record(recorded);
recorded.setAll(boxes).update();
const bytes = recording.bytes();
const source = openTrace(bytes);
const spaceOptions = 'technique, cellSize, bounds, wrap, touching, events, margin, capacity';

describe('an option that there is not, and a value that it cannot have:', () => {
  test.each<[string, () => unknown]>([
    ['compare: there is no option "pass", did you mean "passes"?', () => compare(source, loose({ pass: 1 }))],
    ['compare: there is no option "technique", did you mean', () => compare(source, loose({ technique: 'auto' }))],
    ['compare: there is no option "dimensions", there are', () => compare(source, loose({ dimensions: 3 }))],
    ['compare: there is no option "pass"', () => compare(source, loose({ techniques: [], pass: 1 }))],
    ['compare: got null, expected an object of options', () => compare(source, loose(null))],
    ['compare: progress: got 1, expected a function', () => compare(source, loose({ progress: 1 }))],
    ['compare: techniques: got "auto", expected an array', () => compare(source, loose({ techniques: 'auto' }))],
    ['replay: there is no option "technik", did you mean', () => replay(source, loose({ technik: 'auto' })).next()],
    ['replay: there is no option "dimensions"', () => replay(source, loose({ dimensions: 3 })).next()],
    ['replay: got true, expected an object of options', () => replay(source, loose(true)).next()],
    ['replay: verify: got 1, expected true or false', () => replay(source, {}, loose(1)).next()],
    ['survey: progress: got true, expected a function', () => survey(source, loose(true))],
    ['tune: progress: got "no", expected a function', () => tune(source, loose({ progress: 'no' }))],
    ['tune: techniques: got "auto", expected an array of names', () => tune(source, loose({ techniques: 'auto' }))],
    ['tune: seconds: got "1", expected a number, at least 0', () => tune(source, loose({ seconds: '1' }))],
    ['tune: seconds: got NaN, expected a number, at least 0', () => tune(source, { seconds: Number.NaN })],
    ['tune: seconds: got -1, expected a number, at least 0', () => tune(source, { seconds: -1 })],
    ['tune: exhaustive: got 1, expected true or false', () => tune(source, loose({ exhaustive: 1 }))],
    ['openTrace: salvage: got "yes", expected true or false', () => openTrace(bytes, loose({ salvage: 'yes' }))],
    ['importRecording: salvage: got 1, expected true or false', () => importRecording(bytes, loose({ salvage: 1 }))],
    ['touching: got 0, expected true or false', () => new TraceWriter(2, undefined, loose(0))],
    ['wrap: got 0, expected 2 numbers above 0', () => new TraceWriter(2, loose(0))],
  ])('%s', (message, call) => {
    expect(call).toThrow(message);
  });

  test('of promises', async () => {
    await expect(openAny(bytes, loose({ salvage: 'yes' }))).rejects.toThrow('openTrace: salvage: got "yes"');
    await expect(gunzip(bytes, Number.NaN)).rejects.toThrow('gunzip: most: got NaN, expected a number, at least 0');
  });

  test('all options of a space are taken, but its dimensions', () => {
    expect(() => new BroadPhase(loose({ '?': 1 }))).toThrow(`there are dimensions, ${spaceOptions}`);
    expect(() => replay(source, loose({ '?': 1 })).next()).toThrow(`there are ${spaceOptions}`);
    const rest = spaceOptions.replace('technique, ', '');
    expect(() => compare(source, loose({ '?': 1 }))).toThrow(`there are techniques, passes, progress, ${rest}`);
  });
});

describe('an array that does not fit the boxes:', () => {
  const rule = [1, 1, 0];
  test.each<[string, () => unknown]>([
    ['rules.length: got 3, expected 6', () => exactPairs(boxes, 2, undefined, rule)],
    ['rules.length: got 9, expected 6', () => exactPairs(boxes, 2, undefined, [rule, rule, rule].flat())],
    ['wrap: got [9], expected 2 numbers above 0', () => exactPairs(boxes, 2, undefined, undefined, [9])],
    ['wrap: got [9, 9, 9], expected 2', () => exactPairs(boxes, 2, undefined, undefined, [9, 9, 9])],
    ['wrap: got [9, -9], expected 2', () => exactPairs(boxes, 2, undefined, undefined, [9, -9])],
    ['groups.length: got 1, expected 2', () => exactPairs(boxes, 2, ...none, { groups: Uint32Array.of(1) })],
    ['reaches.length: got 3, expected 2', () => exactPairs(boxes, 2, ...none, { reaches: Float64Array.of(1, 2, 3) })],
    ['touching: got 0, expected true or false', () => exactPairs(boxes, 2, ...none, { touching: loose(0) })],
    ['boxes: got undefined, expected an array of numbers', () => exactPairs(loose(undefined), 2)],
    ['boxes: got 5, expected an array of numbers', () => exactPairs(loose(5), 2)],
    ['boxes: got "0011", expected an array of numbers', () => exactPairs(loose('0011'), 2)],
    ['exactPairs: box 1 is [NaN, 0, 1, 1], expected', () => exactPairs([0, 0, 1, 1, Number.NaN, 0, 1, 1], 2)],
    ['exactPairs: box 0 is [0, 2, 1, 1], expected minima not above maxima', () => exactPairs([0, 2, 1, 1], 2, ...none)],
  ])('%s', (message, call) => {
    expect(call).toThrow(message);
  });

  test.each<[string, Uint32Array | undefined, object]>([
    ['trace: rules.length: got 3, expected 6', Uint32Array.from(rule), {}],
    ['trace: groups.length: got 1, expected 2', undefined, { groups: Uint32Array.of(1) }],
    ['trace: groups: got [1, 2], expected a Uint32Array', undefined, { groups: [1, 2] }],
    ['trace: reaches.length: got 3, expected 2', undefined, { reaches: Float64Array.of(1, 2, 3) }],
    ['trace: reaches: got -1, expected finite numbers, 0 or more', undefined, { reaches: Float64Array.of(0, -1) }],
  ])('%s, and nothing is written', (message, rules, own) => {
    const [writer, other] = [new TraceWriter(2), new TraceWriter(2)];
    expect(() => writer.frame(new Float32Array(boxes), undefined, rules, own)).toThrow(message);
    expect(writer.frame(new Float32Array(boxes))).toEqual(other.frame(new Float32Array(boxes)));
  });

  test.each<[string, Partial<Frame>]>([
    ['applyFrame: boxes.length: got 8, expected 0', { count: 0 }],
    ['applyFrame: ids.length: got 1, expected 2', { ids: Uint32Array.of(7) }],
    ['applyFrame: rules.length: got 2, expected 6', { rules: Uint32Array.of(1, 1) }],
    ['applyFrame: groups.length: got 3, expected 2', { groups: Uint32Array.of(1, 2, 3) }],
    ['applyFrame: reaches.length: got 1, expected 2', { reaches: Float64Array.of(1) }],
    ['applyFrame: box 1 is [NaN, 0, 1, 1]', { boxes: Float64Array.of(0, 0, 1, 1, Number.NaN, 0, 1, 1) }],
    [
      'applyFrame: box 0 is [3, 0, 1, 1]',
      { boxes: Float32Array.of(3, 0, 1, 1, 0, 0, 1, 1), ids: Uint32Array.of(7, 9) },
    ],
    ['applyFrame: boxes: got [0, 0, 1, 1, 0, 0, 1, 1], expected a Float32Array', { boxes: loose(boxes) }],
    ['applyFrame: boxes: got undefined, expected a Float32Array', { boxes: loose(undefined) }],
    ['applyFrame: id 7 appears twice', { ids: Uint32Array.of(7, 7) }],
    ['applyFrame: an id is 16777216, expected an integer', { ids: Uint32Array.of(7, 2 ** 24) }],
    ['applyFrame: an id is -1, expected an integer', { ids: loose([7, -1]) }],
    ['applyFrame: rules: got [1, 1, 0, 1, 1, 0], expected a Uint32Array', { rules: loose([...rule, ...rule]) }],
    ['applyFrame: reaches: got -1, expected finite numbers, 0 or more', { reaches: Float64Array.of(1, -1) }],
  ])('%s, and the space is as before', (message, wrong) => {
    const space = new BroadPhase().set(9, 5, 5, 6, 6);
    const frame: Frame = { index: 0, count: 2, ids: undefined, boxes: new Float32Array(boxes), changed: 2 };
    expect(() => applyFrame(space, { ...frame, ...wrong })).toThrow(message);
    expect([...space]).toEqual([[9, new Float64Array([5, 5, 6, 6])]]);
    expect(() => applyFrame(loose({}), frame)).toThrow('applyFrame: got [object Object], expected a BroadPhase');
    expect(() => applyFrame(space, loose(undefined))).toThrow('applyFrame: got undefined, expected a frame of a trace');
  });
});

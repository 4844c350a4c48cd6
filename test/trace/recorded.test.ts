// Recordings: the raw layout and traces give the same numbers, and what is not a recording is told apart clearly.

import { openTrace, TraceWriter } from 'broadphase/trace';
import { expect, test } from 'vitest';
import { framesOf } from '../../src/scenes/recorded.ts';
import { rawMagic, readRecording } from '../../src/trace/raw.ts';
import { readTrace, traceNames } from '../support/recordings.ts';
import { referencePairs } from '../support/reference.ts';

const frames = [
  [0, 1, 2, 3, -4.5, 5, 6, 7.25],
  [0.1, 1, 2, 3, -4.5, 5, 6, 7.5],
].map((frame) => Float32Array.from(frame));

function encode(magic: number, body: Uint8Array, header: number[] = [2, 2, 2]): Uint8Array {
  const bytes = new Uint8Array(16 + body.length);
  const view = new DataView(bytes.buffer);
  [magic, ...header].forEach((value, k) => {
    view.setInt32(4 * k, value, true);
  });
  bytes.set(body, 16);
  return bytes;
}

const raw = new Uint8Array(Float32Array.from(frames.flatMap((frame) => [...frame])).buffer);

test('a recording gives its frames, minima then maxima', () => {
  const recording = readRecording(encode(rawMagic, raw));
  expect(recording).toMatchObject({ dimensions: 2, count: 2, frames: 2 });
  expect(recording.frame(0)).toEqual(frames[0]);
  expect(recording.frame(1)).toEqual(frames[1]);
});

test('the frames of a trace, or a part of them, are at hand', () => {
  const writer = new TraceWriter(2);
  const pieces = [writer.header(), ...frames.map((frame) => writer.frame(frame))];
  const trace = openTrace(Buffer.concat([...pieces, writer.end()]));
  expect(framesOf(trace)).toMatchObject({ dimensions: 2, count: 2, frames: 2 });
  expect(framesOf(trace).frame(0)).toEqual(frames[0]);
  expect(framesOf(trace).frame(1)).toEqual(frames[1]);
  expect(framesOf(trace, 1).frame(0)).toEqual(frames[1]);
  expect(framesOf(trace, 0, 1)).toMatchObject({ frames: 1 });
  expect(() => framesOf(trace, 2)).toThrow('No frame from 2 to 2 among 2');
  for (const k of [-1, 2, 0.5, Number.NaN]) expect(() => framesOf(trace).frame(k)).toThrow(`Frame ${k}`);
  const more = new TraceWriter(2);
  const grown = [more.header(), more.frame(frames[0]), more.frame(Float32Array.of(0, 0, 1, 1)), more.end()];
  expect(() => framesOf(openTrace(Buffer.concat(grown)))).toThrow('Frame 1 has 1 boxes, expected 2');
});

test('bytes that start anywhere in a buffer are read', () => {
  const whole = new Uint8Array(1 + 16 + raw.length);
  whole.set(encode(rawMagic, raw), 1);
  expect(readRecording(whole.subarray(1)).frame(1)).toEqual(frames[1]);
});

test('a recording without frames or boxes is one', () => {
  expect(readRecording(encode(rawMagic, new Uint8Array(), [3, 0, 5])).frame(4).length).toBe(0);
  expect(readRecording(encode(rawMagic, new Uint8Array(), [3, 7, 0])).frames).toBe(0);
});

test('what is not a recording is an error that says why', () => {
  expect(() => readRecording(new Uint8Array(3))).toThrow('3 bytes');
  expect(() => readRecording(encode(0x12345678, raw))).toThrow('0x12345678');
  expect(() => readRecording(Uint8Array.from({ length: 16 }, (_, k) => [0x1f, 0x8b][k] ?? 0))).toThrow('gzip');
  expect(() => readRecording(encode(rawMagic, raw, [4, 2, 2]))).toThrow('4 dimensions');
  expect(() => readRecording(encode(rawMagic, raw, [2, -1, 2]))).toThrow('-1 boxes');
  expect(() => readRecording(encode(rawMagic, raw.subarray(1)))).toThrow('takes 80 bytes, not 79');
  const recording = readRecording(encode(rawMagic, raw));
  for (const k of [-1, 2, 0.5, Number.NaN]) expect(() => recording.frame(k)).toThrow(`Frame ${k}`);
});

test.each(traceNames)('the recording %s holds boxes that are boxes and that meet', (name) => {
  const recording = readTrace(name);
  const { dimensions: d } = recording;
  const boxes = recording.frame(recording.frames - 1);
  for (let at = 0; at < boxes.length; at += 2 * d) {
    for (let axis = at; axis < at + d; axis++) if (!(boxes[axis] <= boxes[axis + d])) expect.fail(`at ${axis}`);
  }
  expect(referencePairs(boxes, d).length).toBeGreaterThan(recording.count / 10);
});

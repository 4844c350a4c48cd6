// Recordings: both layouts give the same numbers, and what is not a recording is told apart clearly.
import { expect, test } from 'vitest';
import { packedMagic, rawMagic, readRecording } from '../../src/scenes/recorded.ts';
import { readTrace, traceNames } from '../support/recordings.ts';
import { referencePairs } from '../support/reference.ts';

const frames = [
  [0, 1, 2, 3, -4.5, 5, 6, 7.25],
  [0.1, 1, 2, 3, -4.5, 5, 6, 7.5],
].map((frame) => Float32Array.from(frame));

function encode(magic: number, body: Uint8Array, header: number[] = [2, 2, 2]): ArrayBuffer {
  const bytes = new Uint8Array(16 + body.length);
  const view = new DataView(bytes.buffer);
  [magic, ...header].forEach((value, k) => {
    view.setInt32(4 * k, value, true);
  });
  bytes.set(body, 16);
  return bytes.buffer;
}

const raw = new Uint8Array(Float32Array.from(frames.flatMap((frame) => [...frame])).buffer);

function packed(): Uint8Array {
  const bits = new Uint32Array(raw.buffer);
  const body = new Uint8Array(raw.length);
  bits.forEach((value, i) => {
    const change = i < 8 ? value : value ^ bits[i - 8];
    for (let byte = 0; byte < 4; byte++) body[byte * bits.length + i] = change >>> (8 * byte);
  });
  return body;
}

test.each([
  ['raw', rawMagic, raw],
  ['packed', packedMagic, packed()],
])('a %s recording gives its frames, minima then maxima', (_, magic, body) => {
  const recording = readRecording(encode(magic, body));
  expect(recording).toMatchObject({ dimensions: 2, count: 2, frames: 2 });
  expect(recording.frame(0)).toEqual(frames[0]);
  expect(recording.frame(1)).toEqual(frames[1]);
});

test('bytes that start anywhere in a buffer are read', () => {
  const whole = new Uint8Array(1 + 16 + raw.length);
  whole.set(new Uint8Array(encode(rawMagic, raw)), 1);
  expect(readRecording(whole.subarray(1)).frame(1)).toEqual(frames[1]);
});

test('a recording without frames or boxes is one', () => {
  expect(readRecording(encode(rawMagic, new Uint8Array(), [3, 0, 5])).frame(4).length).toBe(0);
  expect(readRecording(encode(rawMagic, new Uint8Array(), [3, 7, 0])).frames).toBe(0);
});

test('what is not a recording is an error that says why', () => {
  expect(() => readRecording(new ArrayBuffer(3))).toThrow('3 bytes');
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

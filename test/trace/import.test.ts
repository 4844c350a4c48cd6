// The recordings of physics engines become traces without loss, and smaller ones.
import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import {
  exportRecording,
  importRecording,
  openAny,
  openTrace,
  replay,
  Trace,
  TraceError,
  TraceWriter,
} from 'broadphase/trace';
import { describe, expect, test } from 'vitest';
import { concat } from '../support/random-frames.ts';
import { traceFile, traceNames } from '../support/recordings.ts';

test.each(traceNames)(
  '%s goes through a trace unchanged, which is smaller than the raw recording',
  { tags: 'long' },
  async (name) => {
    const source = await openAny(readFileSync(traceFile(name)));
    const writer = new TraceWriter(source.dimensions);
    const pieces = [writer.header()];
    for (const frame of source) pieces.push(writer.frame(frame.boxes as Float32Array));
    pieces.push(writer.end());
    const bytes = Buffer.concat(pieces);
    const trace = openTrace(bytes);
    expect(trace).toMatchObject({ dimensions: source.dimensions, frames: source.frames });
    const frames = Array.from(source, ({ boxes }) => boxes.slice());
    for (const frame of trace) {
      expect(Buffer.compare(bytesOf(frame.boxes), bytesOf(frames[frame.index]))).toBe(0);
    }
    const raw = exportRecording(trace);
    expect(gzipSync(bytes, { level: 9 }).length).toBeLessThan(gzipSync(raw, { level: 9 }).length);
    for (const { index, boxes } of importRecording(raw)) {
      expect(Buffer.compare(bytesOf(boxes), bytesOf(frames[index]))).toBe(0);
    }
    expect(Buffer.compare(exportRecording(importRecording(raw)), raw)).toBe(0);
  },
);

const bytesOf = ({ buffer, byteOffset, byteLength }: Float32Array | Float64Array) =>
  new Uint8Array(buffer, byteOffset, byteLength);

test('a replay that is verified agrees with the exact answer', async () => {
  const source = await openAny(readFileSync(traceFile('smash')));
  const frames = [...replay(source, { technique: 'spatial-grid', cellSize: 2 }, true)];
  expect(frames.length).toBe(source.frames);
  for (const frame of frames) expect(frame).toMatchObject({ difference: null, technique: 'spatial-grid' });
});

test('what the raw layout cannot hold is refused', () => {
  const traceOf = (...frames: [Float32Array | Float64Array, number[]?][]) => {
    const writer = new TraceWriter(2);
    return openTrace(concat([writer.header(), ...frames.map((frame) => writer.frame(...frame)), writer.end()]));
  };
  const box = Float32Array.of(0, 0, 1, 1);
  expect(() => exportRecording(traceOf([box], [new Float32Array()]))).toThrow('frame 1 cannot');
  expect(() => exportRecording(traceOf([box, [7]]))).toThrow('ids of their own');
  expect(() => exportRecording(traceOf([Float64Array.from(box)]))).toThrow('doubles');
  expect(importRecording(exportRecording(traceOf()))).toMatchObject({ frames: 0 });
});

test('bad recordings are refused, with the place of the error', () => {
  const raw = (dimensions: number, count: number, frames: number, ...numbers: number[]) =>
    new Uint8Array([
      ...new Uint8Array(Int32Array.of(0x424f5841, dimensions, count, frames).buffer),
      ...new Uint8Array(Float32Array.from(numbers).buffer),
    ]);
  expect(() => importRecording(raw(2, 1, 1, 0, 0, 1))).toThrow('takes 32 bytes, not 28');
  expect(() => importRecording(raw(2, 1, 2, 0, 0, 1, 1, 0, 3, 1, 1))).toThrow('trace: frame 1, byte 36: box 0');
  expect(() => importRecording(raw(2, 0, 2 ** 30))).toThrow('frames without boxes');
  expect(() => importRecording(raw(2, 2 ** 30, 0))).toThrow('1073741824 boxes');
  expect(() => importRecording(raw(5, 1, 1))).toThrow(TraceError);
});

describe('salvage', () => {
  const frames = 40;
  const numbers = (k: number) =>
    Float32Array.from({ length: 400 }, (_, at) => ((at * 37 + k * at) % 101) + (at & 2) * 99);
  const writer = new TraceWriter(2);
  const trace = concat([
    writer.header(),
    ...Array.from({ length: frames }, (_, k) => writer.frame(numbers(k)).slice()),
    writer.end(),
  ]);
  const raw = exportRecording(openTrace(trace));

  test.each([
    ['a raw recording', raw, false],
    ['a gzipped raw recording', raw, true],
    ['a gzipped trace', trace, true],
  ])('reads the intact frames of %s, wherever it was cut off', async (_, plain, zipped) => {
    const whole = zipped ? gzipSync(plain) : plain;
    let before = -1;
    for (const share of [0.1, 0.3, 0.5, 0.77, 0.999]) {
      const cut = Uint8Array.from(whole.subarray(0, Math.floor(share * whole.length)));
      await expect(openAny(cut)).rejects.toThrow(TraceError);
      const source = await openAny(cut, { salvage: true });
      expect(source.frames).toBeGreaterThan(before);
      expect(source.frames).toBeLessThan(frames + (share === 0.999 ? 1 : 0));
      before = source.frames;
      expect(source.fault).toBeInstanceOf(TraceError);
      for (const { index, boxes } of source) expect(boxes).toEqual(numbers(index));
    }
    expect(before).toBeGreaterThan(frames - 3);
    const intact = await openAny(whole, { salvage: true });
    expect([intact.frames, intact.fault]).toEqual([frames, undefined]);
  });

  test('ends before the first frame with something that is not a box, and names it', () => {
    const broken = raw.slice();
    new DataView(broken.buffer).setFloat32(16 + 4 * (400 * 7 + 8), Number.NaN, true);
    const source = importRecording(broken, { salvage: true });
    expect([source.frames, source.fault?.frame]).toEqual([7, 7]);
    expect([...source].length).toBe(7);
    expect(() => importRecording(raw.subarray(0, 9), { salvage: true })).toThrow('fewer than the 16 of the header');
    const more = importRecording(concat([raw, Uint8Array.of(1, 2, 3)]), { salvage: true });
    expect([more.frames, more.fault?.message]).toEqual([frames, expect.stringContaining('bytes, not')]);
  });
});

describe('bytes', () => {
  const writer = new TraceWriter(2);
  const trace = concat([writer.header(), writer.frame(Float32Array.of(0, 0, 1, 1)).slice(), writer.end()]);
  const raw = exportRecording(openTrace(trace));

  test('may be in an ArrayBuffer', async () => {
    for (const bytes of [raw, gzipSync(raw), trace, gzipSync(trace)]) {
      const { buffer } = Uint8Array.from(bytes);
      expect((await openAny(buffer)).frames).toBe(1);
    }
  });

  test.each([[undefined], [null], ['x'], [7], [{}]])('%j is named, if it is none', async (given) => {
    const message = /: got .*, expected a Uint8Array or an ArrayBuffer/;
    expect(() => openTrace(given as never)).toThrow(TypeError);
    expect(() => openTrace(given as never)).toThrow(message);
    expect(() => new Trace(given as never)).toThrow(message);
    expect(() => importRecording(given as never)).toThrow(message);
    await expect(openAny(given as never)).rejects.toThrow(message);
    await expect(openAny(given as never, { salvage: true })).rejects.toThrow(TypeError);
  });
});

// What a user saw: in Jest and Vitest an array that structuredClone gave was refused, "got [object Float32Array],
// expected a Float32Array". It is of the realm outside; so is what comes from an iframe or a vm context.
import { readFileSync } from 'node:fs';
import { createContext, runInContext } from 'node:vm';
import { BroadPhase, findPairs, findPairsBetween, init } from 'broadphase';
import { openTrace, record } from 'broadphase/trace';
import { expect, test } from 'vitest';
import { readRecording } from '../../src/trace/raw.ts';

const there = runInContext(
  '({ Array, Float32Array, Float64Array, Uint8Array, DataView, RegExp })',
  createContext({}),
) as typeof globalThis;
const boxes = [0, 0, 10, 10, 5, 5, 15, 15];
const kernel = readFileSync(new URL('../../build/kernel.wasm', import.meta.url));

test.each(['Array', 'Float32Array', 'Float64Array'] as const)('boxes in a %s of another realm are taken', (kind) => {
  const given = (there[kind] as ArrayConstructor).from(boxes);
  expect(given).not.toBeInstanceOf(globalThis[kind]);
  expect([...new BroadPhase().setAll(given).update().pairs]).toEqual([0, 1]);
  expect([...findPairs(given)]).toEqual([0, 1]);
  expect([...findPairsBetween(given, boxes)]).toEqual([...findPairsBetween(boxes, boxes)]);
  expect([...findPairsBetween(boxes, given)]).toEqual([...findPairsBetween(boxes, boxes)]);
});

test('a snapshot, a trace and a kernel of another realm are taken', () => {
  const space = new BroadPhase();
  const recording = record(space);
  space.setAll(boxes).update();
  const snapshot = there.Uint8Array.from(space.snapshot());
  for (const given of [snapshot, snapshot.buffer, new there.DataView(snapshot.buffer)]) {
    expect([...new BroadPhase().restore(given as Uint8Array).update().pairs]).toEqual([0, 1]);
  }
  const trace = there.Uint8Array.from(recording.bytes());
  for (const given of [trace, trace.buffer]) expect(openTrace(given).frames).toBe(1);
  expect(() => readRecording(there.Uint8Array.of(1, 2, 3))).toThrow('3 bytes');
  const bytes = there.Uint8Array.from(kernel);
  for (const given of [bytes, bytes.buffer]) init(given);
  expect([...findPairs(boxes)]).toEqual([0, 1]);
});

test('answers go into arrays of another realm', () => {
  const space = new BroadPhase().setAll(boxes).update();
  const out = new there.Array<number>();
  expect(space.queryBox(0, 0, 1, 1, { out })).toBe(out);
  expect([...(space.get(1, new there.Float64Array(4)) as Float64Array)]).toEqual([5, 5, 15, 15]);
});

test('bytes in shared and in resizable memory are taken', () => {
  const space = new BroadPhase().setAll(boxes).update();
  const snapshot = space.snapshot();
  const shared = new Uint8Array(new SharedArrayBuffer(snapshot.length));
  shared.set(snapshot);
  expect([...new BroadPhase().restore(shared).update().pairs]).toEqual([0, 1]);
  expect([...new BroadPhase().restore(shared.buffer as unknown as ArrayBuffer).update().pairs]).toEqual([0, 1]);
  const bytes = new Uint8Array(new SharedArrayBuffer(kernel.length));
  bytes.set(kernel);
  init(bytes as unknown as BufferSource);
  expect([...findPairs(boxes)]).toEqual([0, 1]);
});

test('what is none of these is refused as before', () => {
  for (const bad of [there.RegExp('x'), {}, null, undefined, 'text', new there.DataView(new ArrayBuffer(32))]) {
    expect(() => new BroadPhase().setAll(bad as never)).toThrow(TypeError);
  }
  for (const bad of [{}, null, undefined, 'text', [1, 2]]) {
    expect(() => new BroadPhase().restore(bad as never)).toThrow(TypeError);
    expect(() => init(bad as never)).toThrow(TypeError);
  }
});

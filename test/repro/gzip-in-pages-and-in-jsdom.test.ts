// Browsers refused gzipped recordings in shared or resizable memory, and with `salvage` nothing was read, without a word.
// Where jsdom stands in for a page, its Blob has no stream: "(intermediate value).stream is not a function".
import { gzipSync } from 'node:zlib';
import { BroadPhase } from 'broadphase';
import { gunzip, openAny, record } from 'broadphase/trace';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';

const { DecompressionStream: Unzip } = globalThis;

/** As in browsers: it takes no memory that may change while it reads. */
class StrictUnzip {
  readonly writable: WritableStream<Uint8Array>;
  readonly readable: ReadableStream<Uint8Array>;

  constructor(kind: CompressionFormat) {
    const { readable, writable } = new TransformStream<Uint8Array<ArrayBuffer>>({
      transform(piece, next) {
        const { buffer } = piece as { buffer: ArrayBufferLike & { resizable?: boolean } };
        if (buffer instanceof SharedArrayBuffer || buffer.resizable) throw new TypeError('it must not be shared');
        next.enqueue(piece);
      },
    });
    this.writable = writable;
    this.readable = readable.pipeThrough(new Unzip(kind));
  }
}

beforeEach(() => {
  vi.stubGlobal('DecompressionStream', StrictUnzip);
  vi.stubGlobal('Blob', class {});
});
afterEach(() => {
  vi.unstubAllGlobals();
});

const space = new BroadPhase();
const recording = record(space);
for (let x = 0; x < 5; x++) {
  for (let id = 0; id < 3000; id++) space.set(id, id + x, Math.sin(id), id + x + 3, 3);
  space.update();
}
const plain = recording.bytes();
const zipped = gzipSync(plain);

/** The bytes in memory of this kind. */
const inside = (memory: ArrayBufferLike) => {
  const bytes = new Uint8Array(memory);
  bytes.set(zipped);
  return bytes.subarray(0, zipped.length);
};

test.each([
  ['memory of its own', () => Uint8Array.from(zipped)],
  ['shared memory', () => inside(new SharedArrayBuffer(zipped.length))],
  ['resizable memory', () => inside(Reflect.construct(ArrayBuffer, [zipped.length, { maxByteLength: 1e7 }]))],
])('a gzipped trace in %s is read', async (_, make) => {
  expect(Buffer.compare(await gunzip(make()), plain)).toBe(0);
  for (const options of [undefined, { salvage: true }]) {
    const source = await openAny(make(), options);
    expect([source.frames, source.fault]).toEqual([5, undefined]);
  }
  await expect(gunzip(make(), 1000)).rejects.toThrow('unpacked, it exceeds the limit of 1000 bytes');
  await expect(openAny(make().subarray(0, 9000))).rejects.toThrow('its gzip data is broken');
  expect((await openAny(make().subarray(0, zipped.length - 40), { salvage: true })).frames).toBeGreaterThan(0);
});

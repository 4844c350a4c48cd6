// Reads traces: whole ones from bytes, or as a stream while they arrive.
import { badValue, checkBoolean, checkOptions } from '../errors.ts';
import { givenBytes, uint32At } from './bytes.ts';
import { crc32 } from './crc32.ts';
import { FrameDecoder } from './decoder.ts';
import {
  type Frame,
  type FrameSource,
  formatVersion,
  frameHeaderBytes,
  headerBytes,
  magic,
  maxBodyBytes,
  TraceError,
  worldBits,
} from './format.ts';
import { rawMagic } from './raw.ts';

/** How a trace is opened. */
export interface OpenOptions {
  /**
   * For the trace of a run that crashed: reads the intact frames up to where the file is truncated or damaged, instead
   * of throwing. {@link Trace.fault} then says what is wrong.
   */
  salvage?: boolean | undefined;
}

/** Whether to salvage what is intact; checks the options of `where`. */
export function isSalvage(where: string, options: OpenOptions | undefined): boolean {
  checkOptions(where, options, ['salvage']);
  const { salvage = false } = options ?? {};
  checkBoolean(`${where}: salvage`, salvage);
  return salvage;
}

/**
 * A trace in memory. Its lengths and checksums were verified when it was opened; iterate over it with `for … of`.
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const trace = new Trace(recording.bytes());
 * Array.from(trace, (frame) => frame.changed); // → [2, 1, 1]
 */
export class Trace implements FrameSource {
  /** How many axes its boxes have. */
  readonly dimensions: 2 | 3;
  /** How many frames there are. */
  readonly frames: number;
  /** The size of the world along each axis, if it wraps around. */
  readonly wrap: readonly number[] | undefined;
  /** Whether boxes that only touch are pairs. */
  readonly touching: boolean;
  /** With `salvage`: what is wrong with the file after its last intact frame. */
  readonly fault: TraceError | undefined;
  readonly #bytes: Uint8Array;
  readonly #version: number;
  readonly #world: number;

  /** @throws TraceError that says what is wrong, in which frame, at which byte */
  constructor(bytes: Uint8Array, options?: OpenOptions) {
    this.#bytes = givenBytes('Trace', bytes);
    const salvage = isSalvage('openTrace', options);
    const { dimensions, version, world, checksum } = readHeader(this.#bytes);
    this.dimensions = dimensions;
    this.#version = version;
    this.#world = world;
    let frames = 0;
    const decoder = new FrameDecoder(dimensions, version, world);
    try {
      const bodies = checkedBodies(this.#bytes, checksum);
      // Decoded once here, so that no later iteration meets an error.
      for (const { body, offset } of bodies) if (decoder.decode(body, offset)) frames++;
    } catch (error) {
      if (!(salvage && error instanceof TraceError)) throw error;
      this.fault = error;
    }
    this.frames = frames;
    this.wrap = decoder.wrap;
    this.touching = decoder.touching;
  }

  /** Frameworks that wrap objects in proxies, such as Vue, leave objects alone whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'Trace';
  }

  /** The frames in order, each valid until the next. */
  *[Symbol.iterator](): Generator<Frame> {
    const decoder = new FrameDecoder(this.dimensions, this.#version, this.#world);
    let at = headerBytes;
    for (let k = 0; k < this.frames; k++) {
      const start = at + frameHeaderBytes;
      at = start + uint32At(this.#bytes, at);
      yield decoder.decode(this.#bytes.subarray(start, at), start)!;
    }
  }
}

/**
 * Opens a trace: checks the file, and gives its frames any number of times.
 * @throws TraceError if it is truncated, corrupted, newer than this reader, or not a trace; TypeError for anything but bytes
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const trace = openTrace(recording.bytes());
 * trace.frames; // → 3
 * for (const { index, boxes } of trace) console.assert(boxes[0] === index);
 */
export function openTrace(bytes: Uint8Array | ArrayBuffer, options?: OpenOptions): Trace {
  return new Trace(givenBytes('openTrace', bytes), options);
}

/** A frame of a stream, with its dimensions. */
export interface StreamedFrame extends Frame {
  /** 2 or 3. */
  readonly dimensions: 2 | 3;
}

/**
 * The frames of a trace as it arrives, each as soon as its bytes are there; only one frame is kept in memory.
 * @throws TraceError as {@link openTrace}, after the intact frames
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * let frames = 0;
 * for await (const frame of readTrace(new Blob([recording.bytes()]).stream())) frames += frame.dimensions === 2 ? 1 : 0;
 * frames; // → 3
 */
export async function* readTrace(
  chunks: AsyncIterable<Uint8Array> | ReadableStream<Uint8Array>,
): AsyncGenerator<StreamedFrame> {
  // It may be anything, and a ReadableStream is not async iterable in every browser yet.
  const given = chunks as Partial<AsyncIterable<unknown> & ReadableStream> | undefined | null;
  if (!given?.getReader && !given?.[Symbol.asyncIterator]) badValue('readTrace', chunks, 'a stream of bytes', true);
  const queue = new ChunkQueue('getReader' in chunks ? chunksOf(chunks) : chunks);
  try {
    yield* framesIn(queue);
  } finally {
    await queue.close();
  }
}

async function* framesIn(queue: ChunkQueue): AsyncGenerator<StreamedFrame> {
  const head = await queue.take(headerBytes);
  if (!head) throw truncatedHeader(queue.bytesLeft);
  let { dimensions, version, world, checksum } = readHeader(head);
  const decoder = new FrameDecoder(dimensions, version, world);
  let offset = headerBytes;
  for (let index = 0; ; index++) {
    const start = await queue.take(frameHeaderBytes);
    if (!start) throw truncated(index, offset, queue.bytesLeft, frameHeaderBytes);
    const length = bodyLength(start, 0, index, offset);
    const body = await queue.take(length);
    if (!body) throw truncated(index, offset, frameHeaderBytes + queue.bytesLeft, frameHeaderBytes + length);
    checksum = checkFrame(start, body, checksum, index, offset);
    const frame = decoder.decode(body, offset + frameHeaderBytes);
    offset += frameHeaderBytes + length;
    if (!frame) break;
    yield Object.assign(frame, { dimensions });
  }
  if (await queue.take(1)) throw tooMany(decoder.frames, offset);
}

function readHeader(bytes: Uint8Array): { dimensions: 2 | 3; version: number; world: number; checksum: number } {
  for (let k = 0; k < Math.min(bytes.length, magic.length); k++) {
    if (bytes[k] === magic[k]) continue;
    throw new TraceError(`not a trace${hintOf(bytes)}`, -1, k);
  }
  if (bytes.length < headerBytes) throw truncatedHeader(bytes.length);
  const version = bytes[8] | (bytes[9] << 8);
  if (version > formatVersion) {
    throw new TraceError(`of format ${version}, but this version reads formats up to ${formatVersion}`, -1, 8);
  }
  const checksum = crc32(bytes, 0, headerBytes - 4);
  if (uint32At(bytes, headerBytes - 4) !== checksum) throw new TraceError('corrupted: wrong checksum', -1, 12);
  const dimensions = bytes[10];
  if (dimensions !== 2 && dimensions !== 3) throw new TraceError(`${dimensions} dimensions, expected 2 or 3`, -1, 10);
  const world = bytes[11];
  const known = version > 1 ? worldBits.wraps | worldBits.apart : 0;
  if (version === 0 || (world & ~known) !== 0) throw new TraceError('not a header of this format', -1, 8);
  return { dimensions, version, world, checksum };
}

/** What bytes that are not a trace look like. */
function hintOf(bytes: Uint8Array): string {
  if (bytes[0] === 0x1f && bytes[1] === 0x8b) return ': it looks like gzip, which openAny reads';
  if (bytes.length >= 4 && uint32At(bytes, 0) === rawMagic)
    return ': it looks like a raw recording, which openAny reads';
  return '';
}

/** The bodies of all frames, including the end, each after its checksum was verified. */
function* checkedBodies(bytes: Uint8Array, checksum: number): Generator<{ body: Uint8Array; offset: number }> {
  let at = headerBytes;
  for (let index = 0; ; index++) {
    const left = bytes.length - at;
    if (left < frameHeaderBytes) throw truncated(index, at, left, frameHeaderBytes);
    const length = bodyLength(bytes, at, index, at);
    if (left < frameHeaderBytes + length) throw truncated(index, at, left, frameHeaderBytes + length);
    const offset = at + frameHeaderBytes;
    const body = bytes.subarray(offset, offset + length);
    checksum = checkFrame(bytes.subarray(at, offset), body, checksum, index, at);
    at = offset + length;
    yield { body, offset };
    if (body[0] !== 0) continue;
    if (at < bytes.length) throw tooMany(index, at);
    return;
  }
}

function bodyLength(bytes: Uint8Array, at: number, frame: number, offset: number): number {
  const length = uint32At(bytes, at);
  if (length === 0 || length > maxBodyBytes) {
    throw new TraceError(`corrupted: its length is ${length}, expected 1 to ${maxBodyBytes}`, frame, offset);
  }
  return length;
}

function checkFrame(head: Uint8Array, body: Uint8Array, before: number, frame: number, offset: number): number {
  const checksum = crc32(body, 0, body.length, crc32(head, 0, 4, before));
  if (uint32At(head, 4) !== checksum) throw new TraceError('corrupted: wrong checksum', frame, offset);
  return checksum;
}

const truncatedHeader = (got: number) =>
  new TraceError(`truncated: ${got} bytes, fewer than the ${headerBytes} of a header`, -1, got);

const truncated = (frame: number, offset: number, got: number, expected: number) =>
  new TraceError(`truncated: only ${got} of ${expected} bytes`, frame, offset);

const tooMany = (frame: number, offset: number) => new TraceError('more bytes after the end', frame, offset);

/** Bytes as they arrive, handed out in pieces of the length asked for. */
class ChunkQueue {
  readonly #source: AsyncIterator<Uint8Array>;
  #chunks: Uint8Array[] = [];
  bytesLeft = 0;

  constructor(source: AsyncIterable<Uint8Array>) {
    this.#source = source[Symbol.asyncIterator]();
  }

  /** Tells the source that no more is wanted. */
  async close(): Promise<void> {
    await this.#source.return?.();
  }

  /**
   * Returns `length` bytes, or `undefined` if the stream ends before. Allocates memory only for bytes that have
   * arrived.
   */
  async take(count: number): Promise<Uint8Array | undefined> {
    while (this.bytesLeft < count) {
      const { done, value } = await this.#source.next();
      if (done) return undefined;
      this.#chunks.push(value);
      this.bytesLeft += value.length;
    }
    this.bytesLeft -= count;
    const [first] = this.#chunks;
    if (first && first.length >= count) {
      this.#chunks[0] = first.subarray(count);
      return first.subarray(0, count);
    }
    const taken = new Uint8Array(count);
    let filled = 0;
    let used = 0;
    while (filled < count) {
      const chunk = this.#chunks[used];
      const piece = chunk.subarray(0, count - filled);
      taken.set(piece, filled);
      filled += piece.length;
      if (piece.length < chunk.length) this.#chunks[used] = chunk.subarray(piece.length);
      else used++;
    }
    this.#chunks = this.#chunks.slice(used);
    return taken;
  }
}

/** ReadableStream is not async iterable in every browser yet. */
export async function* chunksOf(stream: ReadableStream<Uint8Array>): AsyncGenerator<Uint8Array> {
  const reader = stream.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      yield value;
    }
  } finally {
    await reader.cancel().catch(() => {}); // errors do not matter: the caller wants no more
    reader.releaseLock();
  }
}

// Opens whatever holds frames: traces, and recordings of physics engines in the raw layout, each gzipped or not.

import { badNumber, isSize } from '../errors.ts';
import { isFloat64Array } from '../values.ts';
import { givenBytes, joined, uint32At } from './bytes.ts';
import { checkSource, type Frame, type FrameSource, firstBad, maxBoxes, TraceError } from './format.ts';
import { type RawRecording, rawHeaderBytes, rawMagic, readRecording } from './raw.ts';
import { isSalvage, type OpenOptions, openTrace } from './reader.ts';

/** Gzipped files that are larger than this when unpacked are refused, unless more is allowed: 1 GiB. */
const maxUnpackedBytes = 2 ** 30;

/** The limit for frames: frames without boxes take no bytes, so their number could be anything. */
const maxEmptyFrames = 1e6;

/**
 * Unpacks gzip, in browsers and in Node.
 * @param most how many bytes it may become; default 1 GiB
 * @throws TraceError if the data is damaged, and as soon as it exceeds `most` bytes
 *
 * @example
 * const packed = new Blob(['boxes']).stream().pipeThrough(new CompressionStream('gzip'));
 * const bytes = await gunzip(new Uint8Array(await new Response(packed).arrayBuffer()));
 * new TextDecoder().decode(bytes); // → 'boxes'
 */
export async function gunzip(bytes: Uint8Array, most = maxUnpackedBytes): Promise<Uint8Array> {
  const given = givenBytes('gunzip', bytes);
  if (!isSize(most)) badNumber('gunzip: most', most, 'a number, at least 0');
  const { plain, fault } = await unpack(given, most);
  if (fault) throw fault;
  return plain;
}

/** What was unpacked, and what is wrong with the rest. */
interface Unpacked {
  plain: Uint8Array;
  fault: TraceError | undefined;
}

async function collect(unpacked: ReadableStream<Uint8Array>, most: number): Promise<Unpacked> {
  const reader = unpacked.getReader();
  const pieces: Uint8Array[] = [];
  let length = 0;
  let fault: TraceError | undefined;
  while (!fault) {
    const read = await reader.read().catch((error: Error) => {
      fault = new TraceError(`its gzip data is broken: ${error.message}`, -1, length);
    });
    if (!read || read.done) break;
    pieces.push(read.value);
    length += read.value.length;
    if (length > most) {
      await reader.cancel();
      throw new TraceError(`unpacked, it exceeds the limit of ${most} bytes`, -1, length);
    }
  }
  return { plain: joined(pieces), fault };
}

/** Bytes that are unpacked at once. */
const pieceBytes = 2 ** 14;

/**
 * Unpacks as far as the data goes. A stream that fails drops what nobody has read yet. With `salvage`, that is read before
 * more is given: nothing is lost of a file that was cut off, and at most a piece before a place that is damaged.
 * Not by a Blob, since those of jsdom give no stream; and pieces are copies, as shared memory is refused in browsers.
 */
function unpack(bytes: Uint8Array, most: number, salvage = false): Promise<Unpacked> {
  const { readable, writable } = new DecompressionStream('gzip');
  const writer = writable.getWriter();
  const give = async () => {
    for (let at = 0; at < bytes.length; at += pieceBytes) {
      await writer.write(bytes.slice(at, at + pieceBytes));
      if (salvage) await new Promise((resolve) => setTimeout(resolve));
    }
    await writer.close();
  };
  give().catch(() => {}); // the reader meets the same error
  return collect(readable, most);
}

/** Whether bytes are a raw recording. */
const isRecording = (bytes: Uint8Array) => bytes.length >= 4 && uint32At(bytes, 0) === rawMagic;

/**
 * The frames of a raw recording, unpacked from gzip.
 * @throws TraceError if it is not one, or holds something that is not a box
 *
 * @example
 * importRecording(new Uint8Array(2)); // throws TraceError
 */
export function importRecording(bytes: Uint8Array, options?: OpenOptions): FrameSource {
  const given = givenBytes('importRecording', bytes);
  const salvage = isSalvage('importRecording', options);
  let recording: RawRecording;
  try {
    recording = readRecording(given, salvage);
  } catch (error) {
    throw new TraceError((error as Error).message, -1, 0);
  }
  const { dimensions, count } = recording;
  if (count > maxBoxes) throw new TraceError(`${count} boxes, expected at most ${maxBoxes}`, -1, 8);
  if (count === 0 && recording.frames > maxEmptyFrames) {
    throw new TraceError(`${recording.frames} frames without boxes`, -1, 12);
  }
  const { frames, fault } = intactFrames(recording, salvage);
  return {
    dimensions,
    frames,
    fault,
    *[Symbol.iterator](): Generator<Frame> {
      for (let index = 0; index < frames; index++) {
        const boxes = recording.frame(index);
        const changed = index === 0 ? count : countChanged(recording.frame(index - 1), boxes, 2 * dimensions);
        yield { index, count, ids: undefined, boxes, changed };
      }
    },
  };
}

/** How many frames hold nothing but boxes, and what is wrong after them, which is thrown unless `salvage`. */
function intactFrames(recording: RawRecording, salvage: boolean): { frames: number; fault: TraceError | undefined } {
  const { dimensions, count, frames, wrong } = recording;
  for (let k = 0; k < frames; k++) {
    try {
      checkFrame(recording, k);
    } catch (error) {
      if (!salvage) throw error;
      return { frames: k, fault: error as TraceError };
    }
  }
  const end = rawHeaderBytes + 8 * dimensions * count * frames;
  return { frames, fault: wrong === undefined ? undefined : new TraceError(wrong, frames, end) };
}

/** Opens a trace or a recording that is not gzipped. */
export const openPlain = (bytes: Uint8Array, options?: OpenOptions): FrameSource =>
  isRecording(bytes) ? importRecording(bytes, options) : openTrace(bytes, options);

/**
 * Opens a trace or a raw recording, gzipped or not.
 * @throws TraceError if it is damaged; TypeError for anything but bytes
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const source = await openAny(recording.bytes());
 * source.frames; // → 3
 */
export async function openAny(bytes: Uint8Array | ArrayBuffer, options?: OpenOptions): Promise<FrameSource> {
  const given = givenBytes('openAny', bytes);
  if (given[0] !== 0x1f || given[1] !== 0x8b) return openPlain(given, options);
  if (!options?.salvage) return openPlain(await gunzip(given), options);
  const { plain, fault } = await unpack(given, maxUnpackedBytes, true);
  const source = openPlain(plain, options);
  // A trace has checksums of its own; a raw recording has none but that of gzip.
  return fault && !source.fault && isRecording(plain) ? { ...source, fault } : source;
}

/**
 * A raw recording of the same frames.
 * @throws RangeError if that layout cannot represent them: ids, rules, doubles, a changing number of boxes, a world that
 *   wraps around, or `touching: false`
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.setAll(Float32Array.of(x, 0, x + 4, 4)).update();
 * const raw = exportRecording(openTrace(recording.bytes()));
 * importRecording(raw).frames; // → 3
 */
export function exportRecording(source: FrameSource): Uint8Array<ArrayBuffer> {
  checkSource('exportRecording', source);
  const lost = source.wrap ? 'that the world wraps around' : 'that boxes which only touch are not pairs';
  if (source.wrap || source.touching === false) throw new RangeError(`the raw layout cannot say ${lost}`);
  let count = -1;
  let all = new Uint8Array();
  for (const frame of source) {
    if (count < 0) {
      count = frame.count;
      all = new Uint8Array(rawHeaderBytes + 8 * source.dimensions * count * source.frames);
    }
    const where = `frame ${frame.index} cannot be written in the raw layout:`;
    if (frame.count !== count) throw new RangeError(`${where} it has ${frame.count} boxes, the first had ${count}`);
    if (frame.ids) throw new RangeError(`${where} its boxes have ids of their own`);
    if (frame.rules || frame.groups || frame.reaches)
      throw new RangeError(`${where} some of its boxes are static or off, or have filters, groups or reaches`);
    if (isFloat64Array(frame.boxes)) throw new RangeError(`${where} its numbers are doubles`);
    const { buffer, byteOffset, byteLength } = frame.boxes;
    all.set(new Uint8Array(buffer, byteOffset, byteLength), rawHeaderBytes + frame.index * byteLength);
  }
  if (count < 0) all = new Uint8Array(rawHeaderBytes);
  const header = new DataView(all.buffer);
  for (const [k, value] of [rawMagic, source.dimensions, Math.max(0, count), source.frames].entries()) {
    header.setInt32(4 * k, value, true);
  }
  return all;
}

function checkFrame(recording: RawRecording, index: number): void {
  const { dimensions, count } = recording;
  const boxes = recording.frame(index);
  const bad = firstBad(boxes, dimensions);
  if (!bad) return;
  const offset = rawHeaderBytes + 4 * (2 * index * count * dimensions + bad.at);
  throw new TraceError(`${bad.what}, which is not a box`, index, offset);
}

function countChanged(was: Float32Array, now: Float32Array, width: number): number {
  let changed = 0;
  for (let at = 0; at < now.length; at += width) {
    let k = 0;
    while (k < width && Object.is(was[at + k], now[at + k])) k++;
    if (k < width) changed++;
  }
  return changed;
}

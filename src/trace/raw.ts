// The raw layout, which physics engines write easily: a header of four little-endian int32 [magic, dimensions, boxes,
// frames] and then float32, for each frame, for each box, the minima then the maxima, which is the order
// `BroadPhase.setAll` takes. Reading copies nothing (one copy when the bytes do not lie on a multiple of 4).

export interface RawRecording {
  readonly dimensions: 2 | 3;
  readonly count: number;
  readonly frames: number;
  /** With `salvage`: why there are fewer frames than it should have, or what else is wrong with its length. */
  readonly wrong: string | undefined;
  /** A view, not a copy, of the boxes of frame `k`. */
  frame(k: number): Float32Array;
}

export const rawMagic = 0x424f5841;
export const rawHeaderBytes = 16;

/** Reads a recording from its bytes, gunzipped; with `salvage` the whole frames of one of another length. */
export function readRecording(source: Uint8Array, salvage = false): RawRecording {
  if (source.byteLength < rawHeaderBytes) {
    throw new RangeError(
      `Not a recording: ${source.byteLength} bytes, fewer than the ${rawHeaderBytes} of the header.`,
    );
  }
  const header = new DataView(source.buffer, source.byteOffset, rawHeaderBytes);
  const [magic, dimensions, count, frames] = [0, 4, 8, 12].map((at) => header.getInt32(at, true));
  if (magic !== rawMagic) {
    const hint = (magic & 0xffff) === 0x8b1f ? ' It looks like gzip: decompress it first.' : '';
    throw new RangeError(`Not a recording: it starts with 0x${(magic >>> 0).toString(16)}.${hint}`);
  }
  if (dimensions !== 2 && dimensions !== 3) {
    throw new RangeError(`A recording with ${dimensions} dimensions: expected 2 or 3.`);
  }
  if (count < 0 || frames < 0) throw new RangeError(`A recording of ${count} boxes and ${frames} frames.`);
  const stride = 2 * dimensions * count;
  const expected = rawHeaderBytes + 4 * stride * frames;
  const wrong =
    source.byteLength === expected
      ? undefined
      : `A recording of ${frames} frames of ${count} boxes in ${dimensions}D takes ${expected} bytes, not ${source.byteLength}.`;
  if (wrong && !salvage) throw new RangeError(wrong);
  const whole = wrong && stride > 0 ? Math.floor((source.byteLength - rawHeaderBytes) / (4 * stride)) : frames;
  const there = Math.min(frames, whole);
  const numbers = asFloats(source.subarray(rawHeaderBytes, rawHeaderBytes + 4 * stride * there));
  return {
    dimensions,
    count,
    frames: there,
    wrong,
    frame(k) {
      if (!Number.isInteger(k) || k < 0 || k >= there) {
        throw new RangeError(`Frame ${k} of a recording of ${there}: expected 0 to ${there - 1}.`);
      }
      return numbers.subarray(k * stride, (k + 1) * stride);
    },
  };
}

function asFloats(body: Uint8Array): Float32Array {
  const aligned = body.byteOffset % 4 === 0 ? body : body.slice();
  return new Float32Array(aligned.buffer, aligned.byteOffset, aligned.byteLength / 4);
}

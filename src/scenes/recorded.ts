// Recorded scenes: frames of a trace in which the same boxes stand, read in any order. Tests, benchmark and pages play
// them back and forth.
import type { FrameSource } from '../trace/format.ts';

export interface RecordedFrames {
  readonly dimensions: 2 | 3;
  readonly count: number;
  readonly frames: number;
  /** A view, not a copy, of the boxes of frame `k`. */
  frame(k: number): Float32Array;
}

/** The frames from `from` to `to` (not included) of a trace: all of them unless told. */
export function framesOf(source: FrameSource, from = 0, to = source.frames): RecordedFrames {
  const { dimensions } = source;
  const all: Float32Array[] = [];
  for (const { index, count, boxes } of source) {
    if (index >= to) break;
    if (index < from) continue;
    const expected = all[0]?.length ?? boxes.length;
    if (boxes.length !== expected) {
      throw new RangeError(
        `Frame ${index} has ${count} boxes, expected ${expected / (2 * dimensions)} as in the first.`,
      );
    }
    all.push(Float32Array.from(boxes));
  }
  if (all.length === 0) throw new RangeError(`No frame from ${from} to ${to} among ${source.frames}.`);
  return {
    dimensions,
    count: all[0].length / (2 * dimensions),
    frames: all.length,
    frame(k) {
      if (!Number.isInteger(k) || k < 0 || k >= all.length) {
        throw new RangeError(`Frame ${k} of a recording of ${all.length}: expected 0 to ${all.length - 1}.`);
      }
      return all[k];
    },
  };
}

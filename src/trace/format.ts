// The numbers that make up a trace file (docs/trace-format.md), and the error that says where one is broken.

import { badValue } from '../errors.ts';
import type { Own, World } from '../watch.ts';

/** As in PNG: not text, and any change of line ends breaks it visibly. */
export const magic = Uint8Array.of(0x89, 0x42, 0x50, 0x54, 0x0d, 0x0a, 0x1a, 0x0a);

/** The version written, which is also the newest that can be read. */
export const formatVersion = 2;

/** Magic, version (2 bytes), dimensions, kind of world, checksum of those twelve bytes. */
export const headerBytes = 16;

/** Before the body of each frame: its length and its checksum. */
export const frameHeaderBytes = 8;

/** The kind of a frame: the low four bits of its first byte. */
export const frameKind = { end: 0, snapshot: 1, changes: 2 } as const;

/** Set in the first byte of a frame whose numbers are doubles. */
export const doublesFlag = 0x10;

/** Set in the first byte of a frame in which rules change. Since version 2. */
export const rulesFlag = 0x20;

/**
 * The kind of world, as bits: it wraps around, and the first frame has its size; boxes that only touch are not pairs.
 * Readers refuse unknown bits.
 */
export const worldBits = { wraps: 1, apart: 2 } as const;

/**
 * The bits of a rule: the box is static; a layer and a mask follow; it is off; its group follows; its reach follows.
 */
export const ruleBits = { still: 1, filter: 2, off: 4, group: 8, reach: 16 } as const;

/** The bits of the third number of a rule: the box is static; it is off. */
export const marks = { still: 1, off: 2 } as const;

/** The number of ids, and so the largest number of boxes. */
export const maxBoxes = 2 ** 24;

/** The longest possible body: every box new, in 3D, with all numbers as doubles of 8 bytes, its id and its rule. */
export const maxBodyBytes = maxBoxes * (6 * 8 + 3 + 10 + 16 + 5 + 8) + 64 + 24;

/**
 * A trace that cannot be read, with the error and its place.
 *
 * @example
 * openTrace(new Uint8Array(4)); // throws TraceError: trace: header, byte 0: not a trace
 */
export class TraceError extends Error {
  /** Always `'TraceError'`. */
  override readonly name = 'TraceError';
  /** The frame it is in, counted from 0; -1 for the header. */
  readonly frame: number;
  /** The byte of the (uncompressed) file. */
  readonly offset: number;

  /**
   * @param what is wrong
   * @param frame counted from 0; -1 for the header
   * @param offset of the byte
   */
  constructor(what: string, frame: number, offset: number) {
    super(`trace: ${frame < 0 ? 'header' : `frame ${frame}`}, byte ${offset}: ${what}`);
    this.frame = frame;
    this.offset = offset;
  }
}

/** One frame as it is read. Its arrays are views that are valid until the next frame is read. */
export interface Frame extends Own, World {
  /** From 0. */
  readonly index: number;
  /** The number of boxes in the space. */
  readonly count: number;
  /** The id of each box, all different; `undefined` if they are 0 … count - 1. */
  readonly ids: Uint32Array | undefined;
  /**
   * Layer, mask, and marks of each box: 1 if it is static, plus 2 if it is off. Absent if no box is static or off, or has
   * a filter.
   */
  readonly rules?: Uint32Array | undefined;
  /** Minima then maxima of each box: as float32 if that represents all of them exactly. */
  readonly boxes: Float32Array | Float64Array;
  /** How many boxes are new or differ from the previous frame. */
  readonly changed: number;
}

/** Frames that can be iterated any number of times: a trace or an imported recording. */
export interface FrameSource extends Iterable<Frame>, World {
  /** How many axes its boxes have. */
  readonly dimensions: 2 | 3;
  /** How many frames there are. */
  readonly frames: number;
  /** If it was salvaged: what is wrong with the file after its last intact frame. */
  readonly fault?: TraceError | undefined;
}

/** Throws unless an array, if there is one, has this length. */
export function checkLength(what: string, numbers: ArrayLike<unknown> | undefined, expected: number): void {
  if (numbers && numbers.length !== expected) badValue(`${what}.length`, numbers.length, `${expected}`);
}

/** Throws unless what is called to tell of progress, if anything, is a function. */
export function checkProgress(where: string, progress: unknown): void {
  if (progress !== undefined && typeof progress !== 'function') {
    badValue(`${where}: progress`, progress, 'a function', true);
  }
}

/** Throws unless these are names, or may be: spaces refuse those that there are not. */
export function checkTechniques(where: string, techniques: unknown): void {
  if (!Array.isArray(techniques)) badValue(`${where}: techniques`, techniques, 'an array of names', true);
}

/** Throws unless a caller gave a source of frames; bytes are none yet. */
export function checkSource(where: string, given: unknown): void {
  const source = given as Partial<FrameSource> | undefined | null;
  if (typeof source?.[Symbol.iterator] === 'function' && source.dimensions) return;
  badValue(where, given, 'a trace, as of openTrace', true);
}

/** The first minimum that is above its maximum, or NaN, if any: its place, and its box in words. */
export function firstBad(boxes: ArrayLike<number>, dimensions: number): { at: number; what: string } | undefined {
  const width = 2 * dimensions;
  for (let box = 0; box < boxes.length; box += width) {
    for (let at = box; at < box + dimensions; at++) {
      if (boxes[at] <= boxes[at + dimensions]) continue;
      return { at, what: `box ${box / width} is [${Array.prototype.slice.call(boxes, box, box + width).join(', ')}]` };
    }
  }
  return undefined;
}

/** Throws if a minimum is above its maximum, or NaN. */
export function checkBoxes(where: string, boxes: ArrayLike<number>, dimensions: number): void {
  const bad = firstBad(boxes, dimensions);
  if (bad) throw new RangeError(`${where}: ${bad.what}, expected minima not above maxima and no NaN`);
}

/** As options of a space, with those `given`, of which the ones that are not undefined replace those of the source. */
export function worldOf<Options extends World = World>(source: World, given = {} as Options): NoInfer<Options> {
  const { wrap = source.wrap, touching = source.touching } = given;
  return { ...given, ...(wrap && { wrap }), ...(touching === false && { touching }) };
}

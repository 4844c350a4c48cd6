// Bytes that a caller gave, pieces put together, a growing buffer to write to, and a cursor that reads within bounds.
import { badValue } from '../errors.ts';
import { bytesOf } from '../values.ts';
import { TraceError } from './format.ts';

/** What a caller gave as bytes. @throws TypeError if it is anything else, or detached */
export const givenBytes = (where: string, given: unknown): Uint8Array =>
  bytesOf(given, where) ?? badValue(where, given, 'a Uint8Array or an ArrayBuffer', true);

/** All pieces, one after the other. */
export function joined(pieces: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}

export class ByteWriter {
  bytes = new Uint8Array(1024);
  length = 0;

  /** Makes room for `count` more bytes. */
  reserve(count: number): void {
    if (this.length + count <= this.bytes.length) return;
    const grown = new Uint8Array(Math.max(2 * this.bytes.length, this.length + count));
    grown.set(this.bytes.subarray(0, this.length));
    this.bytes = grown;
  }

  byte(value: number): void {
    this.reserve(1);
    this.bytes[this.length++] = value;
  }

  /** Seven bits per byte, lowest first; the top bit says that more follow. */
  varint(value: number): void {
    this.reserve(5);
    while (value > 127) {
      this.bytes[this.length++] = (value & 127) | 128;
      value >>>= 7;
    }
    this.bytes[this.length++] = value;
  }

  /** Writes 32 bits at a place, lowest byte first. */
  putUint32(at: number, value: number): void {
    for (let k = 0; k < 4; k++) this.bytes[at + k] = value >>> (8 * k);
  }
}

export const uint32At = (bytes: Uint8Array, at: number): number =>
  (bytes[at] | (bytes[at + 1] << 8) | (bytes[at + 2] << 16) | (bytes[at + 3] << 24)) >>> 0;

/** Reads the body of one frame. Errors name the frame and the place in the file. */
export class Cursor {
  at = 0;
  readonly bytes: Uint8Array;
  readonly #frame: number;
  readonly #offset: number;

  constructor(bytes: Uint8Array, frame: number, offset: number) {
    this.bytes = bytes;
    this.#frame = frame;
    this.#offset = offset;
  }

  get left(): number {
    return this.bytes.length - this.at;
  }

  fail(what: string): never {
    throw new TraceError(what, this.#frame, this.#offset + this.at);
  }

  /** Checks that this many bytes are left, before anything of that size is allocated or read. */
  need(count: number, what: string): void {
    if (count > this.left) this.fail(`${what} would take ${count} bytes, and the frame has ${this.left} left`);
  }

  byte(what: string): number {
    this.need(1, what);
    return this.bytes[this.at++];
  }

  /** An integer from 0 to `most`. */
  varint(what: string, most: number): number {
    let value = 0;
    for (let shift = 0; shift < 35; shift += 7) {
      const byte = this.byte(what);
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) {
        if (value > most) this.fail(`${what} is ${value}, expected at most ${most}`);
        return value;
      }
    }
    this.fail(`${what} has more than 32 bits`);
  }
}

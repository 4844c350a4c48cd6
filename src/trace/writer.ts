// Writes traces: frames in, bytes out. It keeps only the last two frames; the caller stores the bytes.
import { badValue, checkBoolean, checkWrap } from '../errors.ts';
import type { Own } from '../watch.ts';
import { ByteWriter } from './bytes.ts';
import { checkFrame, isDoubles } from './check-frame.ts';
import { crc32 } from './crc32.ts';
import {
  doublesFlag,
  formatVersion,
  frameHeaderBytes,
  frameKind,
  headerBytes,
  magic,
  marks,
  maxBoxes,
  ruleBits,
  rulesFlag,
  worldBits,
} from './format.ts';
import { predict, putDistance } from './numbers.ts';
import { all, IdSet, isRuled, TraceState } from './state.ts';

/**
 * Turns frames into the bytes of a trace. A file is `header()`, then `frame()` for each frame, then `end()`; the caller
 * keeps the bytes of each.
 *
 * @example
 * const writer = new TraceWriter(2);
 * const pieces = [writer.header(), writer.frame(Float32Array.of(0, 0, 10, 10)), writer.end()];
 * const bytes = new Uint8Array(await new Blob(pieces).arrayBuffer());
 * openTrace(bytes).frames; // → 1
 */
export class TraceWriter {
  /** How many axes the boxes have. */
  readonly dimensions: 2 | 3;
  /** How many frames have been written. */
  frames = 0;
  readonly #state: TraceState;
  readonly #out = new ByteWriter();
  readonly #header: Uint8Array<ArrayBuffer>;
  #checksum: number;
  /** The runs of changed boxes in this frame. */
  readonly #runs: number[] = [];
  readonly #renamed: number[] = [];
  readonly #reruled: number[] = [];
  readonly #seen = new IdSet();
  readonly #wrap: readonly number[] | undefined;

  /**
   * @param wrap the size of the world along each axis, if it wraps around
   * @param touching whether boxes that only touch are pairs
   * @throws RangeError for dimensions other than 2 and 3, and for a bad size of the world; TypeError if the size is not an
   *   array, or if `touching` is neither true nor false
   */
  constructor(dimensions: 2 | 3, wrap?: readonly number[], touching = true) {
    if (dimensions !== 2 && dimensions !== 3) badValue('dimensions', dimensions, '2 or 3');
    if (wrap !== undefined) checkWrap(wrap, dimensions);
    checkBoolean('touching', touching);
    this.dimensions = dimensions;
    this.#wrap = wrap && [...wrap];
    this.#state = new TraceState(dimensions);
    const out = new ByteWriter();
    out.bytes.set(magic);
    out.bytes[8] = formatVersion;
    out.bytes[10] = dimensions;
    out.bytes[11] = (wrap ? worldBits.wraps : 0) | (touching ? 0 : worldBits.apart);
    this.#checksum = crc32(out.bytes, 0, headerBytes - 4);
    out.putUint32(headerBytes - 4, this.#checksum);
    this.#header = out.bytes.slice(0, headerBytes);
  }

  /** Frameworks that wrap objects in proxies, such as Vue, leave objects alone whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'TraceWriter';
  }

  /**
   * The start of the file: the same bytes at every call.
   *
   * @example
   * new TraceWriter(3).header().length; // → 16
   */
  header(): Uint8Array<ArrayBuffer> {
    return this.#header.slice();
  }

  /**
   * One frame.
   * @param boxes minima then maxima, box after box
   * @param ids the id of each box; left out: 0, 1, 2, …
   * @param rules layer, mask, and marks of each box (2: it is off; any other: it is static); left out: no box has a
   * rule
   * @param own the group of each box, 0 if it is in none, and how far it reaches; left out: all are 0
   * @throws RangeError for a bad box or reach, for an id that is out of range or appears twice, and if lengths do not fit;
   * TypeError for another kind of array: nothing is written then
   *
   * @example
   * const writer = new TraceWriter(2);
   * writer.frame(Float32Array.of(9, 0, 1, 1)); // throws RangeError
   */
  frame(
    boxes: Float32Array | Float64Array,
    ids?: ArrayLike<number>,
    rules?: Uint32Array,
    own: Own = {},
  ): Uint8Array<ArrayBuffer> {
    const state = this.#state;
    const { width } = state;
    const doubles = isDoubles('trace', boxes);
    const count = boxes.length / width;
    if (!Number.isInteger(count) || count > maxBoxes) {
      throw new RangeError(`trace: ${boxes.length} numbers, expected ${width} for each of at most ${maxBoxes} boxes`);
    }
    checkFrame('trace', this.dimensions, count, { boxes, ids, rules, ...own }, this.#seen);
    const had = state.count;
    state.resize(count);
    const renamed = this.#findIds(ids);
    const reruled = this.#findRules(rules, own);
    const kind = this.frames === 0 ? frameKind.snapshot : frameKind.changes;
    const out = this.#begin(kind | (doubles ? doublesFlag : 0) | (reruled.length > 0 ? rulesFlag : 0));
    const wrap = this.frames === 0 ? this.#wrap : undefined;
    for (const byte of new Uint8Array(Float64Array.from(wrap ?? []).buffer)) out.byte(byte);
    out.varint(count);
    this.#writeIds(ids, renamed);
    if (reruled.length > 0) this.#writeRules(reruled, rules, own);
    state.lookAtRules();
    const changed = this.#findRuns(boxes, had);
    out.varint(this.#runs.length / 2);
    for (let k = 0, end = 0; k < this.#runs.length; k += 2) {
      out.varint(this.#runs[k] - end);
      end = this.#runs[k + 1];
      out.varint(end - this.#runs[k]);
    }
    this.#writeNumbers(boxes, changed, doubles);
    state.before.set(boxes);
    state.turn(had);
    this.frames++;
    return this.#seal();
  }

  /**
   * The end of the file, which shows that nothing is missing. Instead of it, more frames may still be written.
   *
   * @example
   * const writer = new TraceWriter(2);
   * openTrace(Uint8Array.of(...writer.header(), ...writer.end())).frames; // → 0
   */
  end(): Uint8Array<ArrayBuffer> {
    const before = this.#checksum;
    this.#begin(frameKind.end).varint(this.frames);
    const bytes = this.#seal();
    this.#checksum = before;
    return bytes;
  }

  #begin(kind: number): ByteWriter {
    const out = this.#out;
    out.length = frameHeaderBytes;
    out.byte(kind);
    return out;
  }

  /** Adds length and checksum in front; the checksum continues that of the previous frame. */
  #seal(): Uint8Array<ArrayBuffer> {
    const out = this.#out;
    out.putUint32(0, out.length - frameHeaderBytes);
    this.#checksum = crc32(out.bytes, frameHeaderBytes, out.length, crc32(out.bytes, 0, 4, this.#checksum));
    out.putUint32(4, this.#checksum);
    return out.bytes.slice(0, out.length);
  }

  /** The places whose ids differ from the previous frame. */
  #findIds(ids: ArrayLike<number> | undefined): readonly number[] {
    const state = this.#state;
    const changed = this.#renamed;
    changed.length = 0;
    if (ids || state.named) {
      for (let k = 0; k < state.count; k++) if (state.ids[k] !== (ids ? ids[k] : k)) changed.push(k);
    }
    return changed;
  }

  #writeIds(ids: ArrayLike<number> | undefined, changed: readonly number[]): void {
    const state = this.#state;
    const out = this.#out;
    out.varint(changed.length);
    let next = 0;
    for (const place of changed) {
      const id = ids ? ids[place] : place;
      out.varint(place - next);
      out.varint(id);
      state.ids[place] = id;
      next = place + 1;
    }
    state.named = ids !== undefined;
  }

  /** The places whose rules differ from the previous frame. */
  #findRules(rules: Uint32Array | undefined, { groups, reaches }: Own): readonly number[] {
    const state = this.#state;
    const changed = this.#reruled;
    changed.length = 0;
    if (!(rules || groups || reaches || state.ruled || state.grouped || state.reaching)) return changed;
    state.startRules();
    const were = state.rules;
    for (let place = 0, k = 0; place < state.count; place++, k += 3) {
      // If there are no rules any more, all become the default.
      const same = rules
        ? were[k] === rules[k] && were[k + 1] === rules[k + 1] && were[k + 2] === marksOf(rules[k + 2])
        : !isRuled(were, place);
      const own = state.groups[place] === (groups?.[place] ?? 0) && state.reaches[place] === (reaches?.[place] ?? 0);
      if (!(same && own)) changed.push(place);
    }
    return changed;
  }

  #writeRules(changed: readonly number[], rules: Uint32Array | undefined, { groups, reaches }: Own): void {
    const state = this.#state;
    const out = this.#out;
    out.varint(changed.length);
    let next = 0;
    for (const place of changed) {
      const at = 3 * place;
      const [layer, mask, given] = rules ? [rules[at], rules[at + 1], rules[at + 2]] : [all, all, 0];
      const group = groups?.[place] ?? 0;
      const reach = reaches?.[place] ?? 0;
      const its = marksOf(given);
      const filtered = layer !== all || mask !== all;
      out.varint(place - next);
      const still = its & marks.still ? ruleBits.still : 0;
      const off = its & marks.off ? ruleBits.off : 0;
      const more = (group !== 0 ? ruleBits.group : 0) | (reach !== 0 ? ruleBits.reach : 0);
      out.byte(still | off | (filtered ? ruleBits.filter : 0) | more);
      if (filtered) {
        out.varint(layer);
        out.varint(mask);
      }
      if (group !== 0) {
        out.varint(group);
        state.grouped = true;
      }
      if (reach !== 0) {
        for (const byte of new Uint8Array(Float64Array.of(reach).buffer)) out.byte(byte);
        state.reaching = true;
      }
      state.rules.set([layer, mask, its], at);
      state.groups[place] = group;
      state.reaches[place] = reach;
      next = place + 1;
    }
  }

  /** Finds the boxes that differ from the previous frame; returns how many. All new ones count. */
  #findRuns(boxes: Float32Array | Float64Array, had: number): number {
    const { was, width, count } = this.#state;
    const runs = this.#runs;
    runs.length = 0;
    let changed = 0;
    let begun = false;
    for (let box = 0; box < count; box++) {
      let differs = box >= had;
      for (let k = box * width; !differs && k < (box + 1) * width; k++) {
        const value = boxes[k];
        differs = value !== was[k] || (value === 0 && !Object.is(value, was[k]));
      }
      if (differs) changed++;
      if (differs === begun) continue;
      runs.push(box);
      begun = differs;
    }
    if (begun) runs.push(count);
    return changed;
  }

  /** The number of bytes of each number, two in a byte; then these bytes. */
  #writeNumbers(boxes: Float32Array | Float64Array, changed: number, doubles: boolean): void {
    const { was, before, width } = this.#state;
    const out = this.#out;
    const runs = this.#runs;
    out.reserve(changed * width * (doubles ? 8.5 : 4.5) + 8);
    const { bytes } = out;
    const now = boxes as Float64Array; // only read, which is the same for both types
    let sizes = out.length;
    let at = sizes + (changed * width) / 2;
    for (let run = 0; run < runs.length; run += 2) {
      for (let box = runs[run]; box < runs[run + 1]; box++) {
        for (let k = 0; k < width; k++) {
          const expected = predict(was, before, now, box * width, k, width / 2);
          const size = putDistance(bytes, at, boxes[box * width + k], expected, doubles);
          if (k % 2 === 0) bytes[sizes] = size;
          else bytes[sizes++] |= size << 4;
          at += size;
        }
      }
    }
    out.length = at;
  }
}

/** Converts the marks of a space to those of a trace. */
const marksOf = (given: number): number => (given & ~marks.off ? marks.still : 0) | (given & marks.off);

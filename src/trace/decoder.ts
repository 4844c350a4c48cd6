// Reads the bodies of frames, one after the other. A body is validated before it is used, so memory is allocated only
// for boxes whose numbers are there, at most about 100 bytes for each byte of the file. Time is proportional to the
// bytes too: unchanged boxes are not touched.
import { Cursor } from './bytes.ts';
import { doublesFlag, type Frame, frameKind, marks, maxBoxes, ruleBits, rulesFlag, worldBits } from './format.ts';
import { predict, takeDistance } from './numbers.ts';
import { all, grown, IdSet, isRuled, TraceState } from './state.ts';

export class FrameDecoder {
  readonly #state: TraceState;
  /** The ids of all boxes, and how many of them differ from their place. */
  readonly #taken = new IdSet();
  #named = 0;
  /** How many boxes have a rule, a group, a reach. */
  #ruled = 0;
  #grouped = 0;
  #reaching = 0;
  /** The same boxes as float32. */
  #floats = new Float32Array();
  /** The runs of boxes that changed in the last frame: from, until, from, until, … */
  #runs: number[] = [];
  #index = 0;
  /** The flags that may be set in the first byte of a frame. */
  readonly #flags: number;
  readonly #wraps: boolean;
  /** Whether boxes that only touch are pairs. */
  readonly touching: boolean;
  /** The size of the world if it wraps around; known once the first frame is read. */
  wrap: readonly number[] | undefined;

  /**
   * @param version of the trace: older ones have fewer features
   * @param world what kind it is: see `worldBits`
   */
  constructor(dimensions: 2 | 3, version: number, world: number) {
    this.#state = new TraceState(dimensions);
    this.#flags = doublesFlag | (version > 1 ? rulesFlag : 0);
    this.#wraps = (world & worldBits.wraps) !== 0;
    this.touching = (world & worldBits.apart) === 0;
  }

  /** How many frames have been read. */
  get frames(): number {
    return this.#index;
  }

  /**
   * The next frame; `undefined` at the end of the trace.
   * @param body its bytes, whose checksum was verified
   * @param offset where they begin in the file, for messages
   * @throws TraceError if they do not describe a frame
   */
  decode(body: Uint8Array, offset: number): Frame | undefined {
    const cursor = new Cursor(body, this.#index, offset);
    const first = cursor.byte('the kind of frame');
    if (first === frameKind.end) {
      const frames = cursor.varint('the number of frames', 0xffffffff);
      if (frames !== this.#index) cursor.fail(`the end frame counts ${frames} frames, but ${this.#index} were read`);
      this.#finish(cursor);
      return undefined;
    }
    const kind = first & ~this.#flags;
    if (kind !== frameKind.snapshot && kind !== frameKind.changes) cursor.fail(`a frame of unknown kind ${first}`);
    if (kind === frameKind.changes && this.#index === 0) cursor.fail('the first frame is not a snapshot');
    if (this.#wraps && this.#index === 0) this.#readWrap(cursor);
    return this.#decodeBoxes(cursor, kind === frameKind.snapshot, first);
  }

  #readWrap(cursor: Cursor): void {
    const sizes = new Float64Array(this.#state.width / 2);
    const bytes = new Uint8Array(sizes.buffer);
    for (let k = 0; k < bytes.length; k++) bytes[k] = cursor.byte('the size of the world');
    for (const size of sizes) if (!(size > 0 && size <= 1e300)) cursor.fail(`a world of ${size}, expected above 0`);
    this.wrap = [...sizes];
  }

  #decodeBoxes(cursor: Cursor, snapshot: boolean, flags: number): Frame {
    const doubles = (flags & doublesFlag) !== 0;
    const state = this.#state;
    const { width } = state;
    const had = snapshot ? 0 : state.count;
    const count = cursor.varint('the number of boxes', maxBoxes);
    const idsAt = cursor.at;
    skipIds(cursor, count);
    const rulesAt = cursor.at;
    if (flags & rulesFlag) skipRules(cursor, count);
    const runsAt = cursor.at;
    const changed = skipRuns(cursor, count, had);
    const sizesAt = cursor.at;
    cursor.need((changed * width) / 2, 'the sizes of numbers');

    this.#release(snapshot ? 0 : Math.min(count, had));
    if (snapshot) state.forget();
    this.#readIds(cursor, idsAt, count);
    if (flags & rulesFlag) this.#readRules(cursor, rulesAt);
    state.ruled = this.#ruled > 0;
    state.grouped = this.#grouped > 0;
    state.reaching = this.#reaching > 0;
    cursor.at = sizesAt + (changed * width) / 2;
    this.#readNumbers(cursor, runsAt, sizesAt, doubles, had);
    this.#finish(cursor);
    const boxes = (doubles ? state.was : this.#floats).subarray(0, count * width);
    const ids = state.named ? state.ids.subarray(0, count) : undefined;
    const rules = state.ruled ? state.rules.subarray(0, 3 * count) : undefined;
    const groups = state.grouped ? state.groups.subarray(0, count) : undefined;
    const reaches = state.reaching ? state.reaches.subarray(0, count) : undefined;
    const { wrap, touching } = this;
    return { index: this.#index++, count, ids, rules, groups, reaches, wrap, touching, boxes, changed };
  }

  /** Removes the boxes from this place on. */
  #release(from: number): void {
    const { groups, count } = this.#state;
    for (let place = from; place < count; place++) {
      this.#drop(place);
      if (place < groups.length) this.#countRule(place, -1);
    }
  }

  /** Adjusts the counts of rules, groups and reaches. */
  #countRule(place: number, more: 1 | -1): void {
    const { rules, groups, reaches } = this.#state;
    if (isRuled(rules, place)) this.#ruled += more;
    if (groups[place] !== 0) this.#grouped += more;
    if (reaches[place] !== 0) this.#reaching += more;
  }

  #drop(place: number): void {
    const id = this.#state.ids[place];
    this.#taken.delete(id);
    this.#named -= Number(id !== place);
  }

  #take(place: number, cursor: Cursor): void {
    const id = this.#state.ids[place];
    if (!this.#taken.add(id)) cursor.fail(`id ${id} appears twice`);
    this.#named += Number(id !== place);
  }

  /** Makes room for `count` boxes, with their ids. */
  #readIds(cursor: Cursor, at: number, count: number): void {
    const state = this.#state;
    const kept = Math.min(state.count, count);
    const each = (what: (place: number, id: number) => void) => {
      cursor.at = at;
      const renamed = cursor.varint('', maxBoxes);
      for (let k = 0, place = 0; k < renamed; k++, place++) {
        place += cursor.varint('', maxBoxes);
        what(place, cursor.varint('', maxBoxes));
      }
    };
    each((place) => {
      if (place < kept) this.#drop(place);
    });
    state.resize(count);
    each((place, id) => {
      state.ids[place] = id;
    });
    each((place) => {
      if (place < kept) this.#take(place, cursor);
    });
    for (let place = kept; place < count; place++) this.#take(place, cursor);
    state.named = this.#named > 0;
  }

  #readRules(cursor: Cursor, at: number): void {
    cursor.at = at;
    const state = this.#state;
    state.startRules();
    const changed = cursor.varint('', maxBoxes);
    for (let k = 0, place = 0; k < changed; k++, place++) {
      place += cursor.varint('', maxBoxes);
      const bits = cursor.byte('');
      const filtered = (bits & ruleBits.filter) !== 0;
      this.#countRule(place, -1);
      state.rules[3 * place] = filtered ? cursor.varint('', all) : all;
      state.rules[3 * place + 1] = filtered ? cursor.varint('', all) : all;
      state.rules[3 * place + 2] = (bits & ruleBits.still ? marks.still : 0) | (bits & ruleBits.off ? marks.off : 0);
      state.groups[place] = bits & ruleBits.group ? cursor.varint('', all) : 0;
      state.reaches[place] = bits & ruleBits.reach ? readReach(cursor) : 0;
      this.#countRule(place, 1);
    }
  }

  /** Updates `was` to this frame and `before` to the previous one; new boxes count as at rest before. */
  #readNumbers(cursor: Cursor, runsAt: number, sizesAt: number, doubles: boolean, had: number): void {
    const { was, before, width, count } = this.#state;
    const { bytes } = cursor;
    const runs = new Cursor(bytes, this.#index, 0);
    runs.at = runsAt;
    const runCount = runs.varint('', maxBoxes);
    const largest = doubles ? 8 : 4;
    if (was.length > this.#floats.length) this.#floats = grown(this.#floats, new Float32Array(was.length));
    const floats = this.#floats;
    const changed: number[] = [];
    let sizes = sizesAt;
    let box = 0;
    for (let run = 0; run < runCount; run++) {
      box += runs.varint('', maxBoxes);
      const end = box + runs.varint('', maxBoxes);
      changed.push(box, end);
      for (; box < end; box++) {
        const at = box * width;
        // After the prediction, the number in `before` is no longer needed: the new one replaces it.
        for (let k = 0; k < width; k++) {
          const size = k % 2 === 0 ? bytes[sizes] & 15 : bytes[sizes++] >> 4;
          if (size > largest) cursor.fail(`a number of box ${box} has ${size} bytes, expected at most ${largest}`);
          cursor.need(size, `a number of box ${box}`);
          const expected = predict(was, before, before, at, k, width / 2);
          before[at + k] = takeDistance(bytes, cursor.at, size, expected, doubles);
          cursor.at += size;
        }
        for (let k = at; k < at + width / 2; k++) {
          if (before[k] <= before[k + width / 2]) continue;
          cursor.fail(`box ${box} is [${[...before.subarray(at, at + width)].join(', ')}], which is not a box`);
        }
        for (let k = at; k < at + width; k++) {
          const now = before[k];
          before[k] = box < had ? was[k] : now;
          was[k] = now;
          floats[k] = now;
        }
      }
    }
    // Boxes that changed in the previous frame, and not in this one, are now at rest.
    const last = this.#runs;
    for (let k = 0, next = 0; k < last.length; k += 2) {
      for (let place = last[k]; place < Math.min(last[k + 1], count); place++) {
        while (changed[next + 1] <= place) next += 2;
        if (changed[next] <= place) continue;
        for (let n = place * width; n < (place + 1) * width; n++) before[n] = was[n];
      }
    }
    this.#runs = changed;
  }

  #finish(cursor: Cursor): void {
    if (cursor.left > 0) cursor.fail(`${cursor.left} bytes too many in the frame`);
  }
}

const knownBits = ruleBits.still | ruleBits.filter | ruleBits.off | ruleBits.group | ruleBits.reach;

/** Reads a reach. */
function readReach(cursor: Cursor): number {
  for (let k = 0; k < 8; k++) reachBytes[k] = cursor.byte('a reach');
  const [reach] = reachNumber;
  if (!(reach >= 0 && reach < Number.POSITIVE_INFINITY))
    cursor.fail(`a reach of ${reach}, expected finite, at least 0`);
  return reach;
}
const reachNumber = new Float64Array(1);
const reachBytes = new Uint8Array(reachNumber.buffer);

/** Validates a list of new ids. */
function skipIds(cursor: Cursor, count: number): void {
  const renamed = cursor.varint('the number of new ids', count);
  cursor.need(2 * renamed, 'the new ids');
  for (let k = 0, next = 0; k < renamed; k++) {
    const place = next + cursor.varint('the place of an id', maxBoxes);
    if (place >= count) cursor.fail(`an id for place ${place} of ${count}`);
    cursor.varint('an id', maxBoxes - 1);
    next = place + 1;
  }
}

/** Validates a list of new rules. */
function skipRules(cursor: Cursor, count: number): void {
  const changed = cursor.varint('the number of new rules', count);
  cursor.need(2 * changed, 'the new rules');
  for (let k = 0, next = 0; k < changed; k++) {
    const place = next + cursor.varint('the place of a rule', maxBoxes);
    if (place >= count) cursor.fail(`a rule for place ${place} of ${count}`);
    const bits = cursor.byte('a rule');
    if (bits > knownBits) cursor.fail(`a rule of unknown kind ${bits}`);
    if (bits & ruleBits.filter) {
      cursor.varint('a layer', all);
      cursor.varint('a mask', all);
    }
    if (bits & ruleBits.group) cursor.varint('a group', all);
    if (bits & ruleBits.reach) readReach(cursor);
    next = place + 1;
  }
}

/** Validates the runs of changed boxes; returns how many boxes they hold. */
function skipRuns(cursor: Cursor, count: number, had: number): number {
  const runs = cursor.varint('the number of runs', count);
  cursor.need(2 * runs, 'the runs of changed boxes');
  let changed = 0;
  let fresh = 0;
  let end = 0;
  for (let k = 0; k < runs; k++) {
    const start = end + cursor.varint('the gap before a run', count);
    end = start + cursor.varint('the length of a run', count);
    if (end === start) cursor.fail('an empty run of changed boxes');
    if (end > count) cursor.fail(`a run of changed boxes up to ${end} of ${count}`);
    changed += end - start;
    fresh += Math.max(0, end - Math.max(start, had));
  }
  if (fresh < count - had) cursor.fail(`${count - had} boxes are new, but only ${fresh} of them are in runs`);
  return changed;
}

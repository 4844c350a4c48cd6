// The state of earlier frames that writer and reader both keep, and update in the same way.

/** The layer and the mask of a box that has no filter. */
export const all = 0xffffffff;

/** Whether the box at this place has a filter, or is static or off. */
export const isRuled = (rules: Uint32Array, place: number): boolean =>
  rules[3 * place] !== all || rules[3 * place + 1] !== all || rules[3 * place + 2] !== 0;

export class TraceState {
  readonly width: number;
  count = 0;
  /** Whether any id differs from its place. */
  named = false;
  /** Whether any box has a rule; otherwise `rules` is unused. */
  ruled = false;
  rules = new Uint32Array();
  /** Whether any box has a group. */
  grouped = false;
  /** Per box, while there are rules. */
  groups = new Uint32Array();
  /** Whether any box has a reach; and the reach per box, while there are rules. */
  reaching = false;
  reaches = new Float64Array();
  /** Whether `rules` are stored: from the first one on. */
  #keepsRules = false;
  ids = new Uint32Array();
  /** The boxes of the previous frame, and of the one before that. */
  was = new Float64Array();
  before = new Float64Array();

  constructor(dimensions: 2 | 3) {
    this.width = 2 * dimensions;
  }

  /** Resets everything, for a snapshot. */
  forget(): void {
    this.resize(0);
    this.named = this.ruled = this.grouped = this.reaching = false;
  }

  /** Changes the number of boxes: new ones have their place as id, and zeros as numbers. */
  resize(count: number): void {
    const { width, count: had } = this;
    if (count > this.ids.length) {
      const room = Math.max(count, Math.min(2 * this.ids.length, 2 ** 24));
      this.ids = grown(this.ids, new Uint32Array(room));
      this.was = grown(this.was, new Float64Array(room * width));
      this.before = grown(this.before, new Float64Array(room * width));
    }
    for (let k = had; k < count; k++) this.ids[k] = k;
    if (this.#keepsRules) this.#meetAll(had, count);
    if (count > had) {
      this.was.fill(0, had * width, count * width);
      this.before.fill(0, had * width, count * width);
    }
    this.count = count;
  }

  /**
   * Swaps the frames: `before`, which has been overwritten with the new frame, becomes `was`.
   * @param had the number of boxes before: new ones count as at rest
   */
  turn(had: number): void {
    const { was, before, width, count } = this;
    this.was = before;
    this.before = was;
    if (count > had) was.set(before.subarray(had * width, count * width), had * width);
  }

  /** Makes room for rules, if there were none. */
  startRules(): void {
    if (this.#keepsRules) return;
    this.#keepsRules = true;
    this.#meetAll(0, this.count);
  }

  /** Determines whether any box has a rule, a group, or a reach. */
  lookAtRules(): void {
    if (!this.#keepsRules) return;
    const { rules, groups, reaches, count } = this;
    this.ruled = false;
    for (let place = 0; place < count && !this.ruled; place++) this.ruled = isRuled(rules, place);
    if (this.grouped) this.grouped = groups.subarray(0, count).some((group) => group !== 0);
    if (this.reaching) this.reaching = reaches.subarray(0, count).some((reach) => reach !== 0);
  }

  /** Places from `had` on get the default rule. */
  #meetAll(had: number, count: number): void {
    if (count > this.groups.length) {
      this.rules = grown(this.rules, new Uint32Array(3 * this.ids.length));
      this.groups = grown(this.groups, new Uint32Array(this.ids.length));
      this.reaches = grown(this.reaches, new Float64Array(this.ids.length));
    }
    this.groups.fill(0, had, count);
    this.reaches.fill(0, had, count);
    for (let k = 3 * had; k < 3 * count; k += 3) {
      this.rules[k] = this.rules[k + 1] = all;
      this.rules[k + 2] = 0;
    }
  }
}

/** Copies an array into a longer one. */
export function grown<Numbers extends Uint32Array | Float32Array | Float64Array>(from: Numbers, to: Numbers): Numbers {
  to.set(from);
  return to;
}

/** A set of ids, one bit each, as large as the largest id requires. */
export class IdSet {
  #bits = new Uint32Array(64);

  /** Adds an id; returns whether it was new. */
  add(id: number): boolean {
    const at = id >>> 5;
    if (at >= this.#bits.length)
      this.#bits = grown(this.#bits, new Uint32Array(Math.max(at + 1, 2 * this.#bits.length)));
    const bit = 1 << (id & 31);
    if (this.#bits[at] & bit) return false;
    this.#bits[at] |= bit;
    return true;
  }

  delete(id: number): void {
    this.#bits[id >>> 5] &= ~(1 << (id & 31));
  }

  clear(): void {
    this.#bits.fill(0);
  }
}

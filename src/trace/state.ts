// What writer and reader both remember of the frames before, grown and carried on in the same way by both.

/** The layer and the mask of a box that has no filter. */
export const all = 0xffffffff;

export class TraceState {
  readonly width: number;
  count = 0;
  /** Whether any id differs from its place. */
  named = false;
  /** Whether any box has a rule of its own; only then there are rules. */
  ruled = false;
  rules = new Uint32Array();
  /** Whether any box has a group. */
  grouped = false;
  /** Of each box, as long as there are rules. */
  groups = new Uint32Array();
  /** Whether any box has a reach; and of each box, as long as there are rules. */
  reaching = false;
  reaches = new Float64Array();
  /** Whether `rules` are kept: from the first one on. */
  #keepsRules = false;
  ids = new Uint32Array();
  /** The boxes of the frame before, and of the one before that. */
  was = new Float64Array();
  before = new Float64Array();

  constructor(dimensions: 2 | 3) {
    this.width = 2 * dimensions;
  }

  /** A snapshot starts from nothing. */
  forget(): void {
    this.resize(0);
    this.named = this.ruled = this.grouped = this.reaching = false;
  }

  /** For as many boxes: new ones have their place as id, and zeros. */
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
   * What stands in `before` by now was the frame that is becoming the one before.
   * @param had how many boxes were there already: new ones begin at rest
   */
  turn(had: number): void {
    const { was, before, width, count } = this;
    this.was = before;
    this.before = was;
    if (count > had) was.set(before.subarray(had * width, count * width), had * width);
  }

  /** Makes room for rules, where there were none. */
  startRules(): void {
    if (this.#keepsRules) return;
    this.#keepsRules = true;
    this.#meetAll(0, this.count);
  }

  /** Looks whether any box has a rule of its own, a group, or a reach. */
  lookAtRules(): void {
    if (!this.#keepsRules) return;
    const { rules, groups, reaches, count } = this;
    let own = false;
    for (let k = 0; k < 3 * count && !own; k += 3) own = rules[k] !== all || rules[k + 1] !== all || rules[k + 2] !== 0;
    this.ruled = own;
    if (this.grouped) this.grouped = groups.subarray(0, count).some((group) => group !== 0);
    if (this.reaching) this.reaching = reaches.subarray(0, count).some((reach) => reach !== 0);
  }

  /** Places from `had` on have no rule of their own. */
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

/** All numbers of an array in a longer one. */
export function grown<Numbers extends Uint32Array | Float32Array | Float64Array>(from: Numbers, to: Numbers): Numbers {
  to.set(from);
  return to;
}

/** A set of ids, one bit each: only as large as the largest needs. */
export class IdSet {
  #bits = new Uint32Array(64);

  /** Whether it was not in yet. */
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

// The pairs of a peer that reports them one by one: a typed array that doubles when full.
export class PairList {
  count = 0;
  #pairs = new Uint32Array(1 << 16);

  clear() {
    this.count = 0;
  }

  add(a, b) {
    const at = 2 * this.count++;
    if (at === this.#pairs.length) {
      const larger = new Uint32Array(2 * at);
      larger.set(this.#pairs);
      this.#pairs = larger;
    }
    this.#pairs[at] = a;
    this.#pairs[at + 1] = b;
  }

  /** Keeps the pairs for which `wanted(a, b)` holds. */
  keep(wanted) {
    const pairs = this.#pairs;
    let kept = 0;
    for (let k = 0; k < 2 * this.count; k += 2) {
      if (!wanted(pairs[k], pairs[k + 1])) continue;
      pairs[kept++] = pairs[k];
      pairs[kept++] = pairs[k + 1];
    }
    this.count = kept / 2;
  }

  pairs() {
    return this.#pairs.subarray(0, 2 * this.count);
  }
}

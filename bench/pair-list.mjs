// Where a peer that reports pairs one by one puts them: a typed array that doubles when full.
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

  pairs() {
    return this.#pairs.subarray(0, 2 * this.count);
  }
}

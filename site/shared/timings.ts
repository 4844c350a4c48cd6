// Durations of the last second: their median, 95th percentile, and number per second.
const kept = 1024;
const span = 1000;

export class Timings {
  median = 0;
  p95 = 0;
  /** Samples per second. */
  rate = 0;
  readonly #at = new Float64Array(kept);
  readonly #durations = new Float64Array(kept);
  readonly #sorted = new Float64Array(kept);
  #count = 0;

  /** Adds one duration that ended at a time, both in milliseconds. */
  add(at: number, duration: number): void {
    const slot = this.#count++ % kept;
    this.#at[slot] = at;
    this.#durations[slot] = duration;
  }

  clear(): void {
    this.#count = 0;
  }

  /** Updates median, p95 and rate. Returns false if there are no samples. */
  summarise(): boolean {
    if (this.#count === 0) return false;
    const last = this.#at[(this.#count - 1) % kept];
    let oldest = last;
    let n = 0;
    while (n < Math.min(this.#count, kept)) {
      const slot = (this.#count - 1 - n) % kept;
      if (n > 1 && last - this.#at[slot] > span) break;
      oldest = this.#at[slot];
      this.#sorted[n++] = this.#durations[slot];
    }
    const sorted = this.#sorted.subarray(0, n).sort();
    this.median = sorted[n >> 1];
    this.p95 = sorted[Math.min(n - 1, Math.floor(0.95 * n))];
    this.rate = n > 1 ? (1000 * (n - 1)) / (last - oldest) : 0;
    return true;
  }
}

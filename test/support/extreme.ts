// Scenes of boxes whose numbers range from the smallest doubles to the largest, and exact arithmetic on these: with whole
// numbers without a limit, in units of the smallest double, so that nothing is rounded and nothing over- or underflows.
import { BroadPhase } from 'broadphase';
import { createRandom } from '../../src/scenes/random.ts';
import type { Loose } from './asker.ts';

const bits = new BigUint64Array(1);
const double = new Float64Array(bits.buffer);

/** A finite double, as a multiple of the smallest one. */
export function exactly(value: number): bigint {
  double[0] = value;
  const exponent = (bits[0]! >> 52n) & 0x7ffn;
  const fraction = bits[0]! & 0xfffffffffffffn;
  const size = exponent === 0n ? fraction : (fraction | 0x10000000000000n) << (exponent - 1n);
  return value < 0 ? -size : size;
}

export const limit = 1n << 2200n; // beyond every sum of doubles: instead of infinity
export const big = (x: number) => (Number.isFinite(x) ? exactly(x) : x > 0 ? limit : -limit);
export const abs = (x: bigint) => (x < 0n ? -x : x);
export const larger = (a: bigint, b: bigint) => (a > b ? a : b);

/** Whether a < b; undefined where they differ by less than one part in 2 ** 44. */
export function below(a: bigint, b: bigint): boolean | undefined {
  const apart = abs(a - b) << 44n;
  return apart <= larger(abs(a), abs(b)) ? undefined : a < b;
}

export class Extreme {
  readonly random: () => number;
  readonly dimensions: 2 | 3;
  readonly scales: number[];
  readonly most: number;
  readonly boxes: number[][];
  readonly space: BroadPhase<2 | 3>;
  readonly ask: Loose;

  /** `most`: no finite number is larger. */
  constructor(dimensions: 2 | 3, seed: number, most = Number.MAX_VALUE) {
    this.most = most;
    this.random = createRandom(seed);
    this.dimensions = dimensions;
    const decades = [
      -323, -320, -310, -308, -300, -170, -165, -162, -161, -155, -150, -140, -46, -45, -38, -30, -23, -19, 0,
    ];
    this.scales = Array.from(
      { length: this.pick(1, 1, 2, 3) },
      () => 10 ** (this.pick(1, -1, 0) ? this.pick(...decades) : this.pick(...decades.map((x) => -Math.max(-308, x)))),
    );
    this.boxes = Array.from({ length: this.pick(1, 5, 20, 60) }, () => this.box());
    if (this.random() < 0.3) this.boxes = this.boxes.map((box) => box.map(Math.fround));
    this.space = new BroadPhase({ dimensions }) as BroadPhase<2 | 3>;
    this.space.setAll(this.boxes.flat()).update();
    this.ask = this.space as unknown as Loose;
  }

  pick<T>(...from: readonly T[]): T {
    return from[Math.floor(this.random() * from.length)]!;
  }

  scale(): number {
    return this.random() < 0.1 ? 10 ** (this.random() * 631 - 323) : this.pick(...this.scales);
  }

  number(): number {
    const { random } = this;
    const factor = this.pick(0, Math.floor(random() * 9) - 4, Math.floor(random() * 9) - 4, 2 * random() - 1);
    const x =
      this.random() < 0.02 ? this.pick(-0, 1, -1) * this.pick(this.most, Number.MIN_VALUE) : factor * this.scale();
    return Math.max(-this.most, Math.min(this.most, x));
  }

  point(): number[] {
    if (this.random() < 0.2) {
      const box = this.pick(...this.boxes).slice(0, this.dimensions);
      if (box.every(Number.isFinite)) return box;
    }
    return Array.from({ length: this.dimensions }, () => this.number());
  }

  box(): number[] {
    const lo = Array.from({ length: this.dimensions }, () => this.number());
    const size = this.pick(0, 1);
    const hi = lo.map((x) => Math.min(this.most, Math.max(x, x + size * Math.abs(this.number()))));
    const box = [...lo, ...hi];
    if (this.random() < 0.1) box[Math.floor(this.random() * this.dimensions)] = -Infinity;
    if (this.random() < 0.1) box[this.dimensions + Math.floor(this.random() * this.dimensions)] = Infinity;
    if (this.random() < 0.03) {
      const a = Math.floor(this.random() * this.dimensions);
      box[a] = box[a + this.dimensions] = this.pick(-Infinity, Infinity);
    }
    return box;
  }

  gaps(box: readonly number[], from: readonly number[]): bigint[] {
    const d = this.dimensions;
    return Array.from({ length: d }, (_, a) =>
      larger(0n, larger(big(box[a]!) - big(from[a + d]!), big(from[a]!) - big(box[a + d]!))),
    );
  }

  squared(box: readonly number[], from: readonly number[]): bigint {
    return this.gaps(box, from).reduce((sum, gap) => sum + gap * gap, 0n);
  }

  way(): number[] {
    return Array.from({ length: this.dimensions }, () => this.pick(0, 1, 1) * this.number());
  }
}

// Thousands of boxes, some of which move: small scenes have few cells, and do not show what goes wrong among many.
// The motions that retained structure has to cope with are drawn at random: steady, turning, speeding up, jumping.
// Boxes have one size or many; some come and go, or become static; they are given one by one or written in place.
import { BroadPhase } from 'broadphase';
import { fingerprint } from '../../bench/harness/fingerprint.mjs';
import { createRandom } from '../../src/scenes/random.ts';
import { setBox } from './set-box.ts';

export class Crowd {
  readonly kept: BroadPhase<2 | 3>;
  readonly #fresh: BroadPhase<2 | 3>;
  readonly #random: () => number;
  readonly #count: number;
  readonly #world: number;
  readonly #speed: number;
  readonly #share: number;
  readonly #manners: Record<
    'mixed' | 'turning' | 'speedingUp' | 'jumping' | 'churning' | 'toggling' | 'oneByOne',
    boolean
  >;
  readonly #boxes: Float32Array;
  readonly #steps: Float32Array;
  readonly #gone = new Set<number>();
  #frame = 0;

  constructor(seed: number) {
    this.#random = createRandom(seed);
    const dimensions = this.#chance(0.5) ? 2 : 3;
    this.kept = new BroadPhase({ dimensions });
    this.#fresh = new BroadPhase({ dimensions, technique: 'strip-sweep' });
    this.#count = Math.floor(1000 * 30 ** this.#random());
    this.#world = 10 * (this.#count / (0.05 + 0.4 * this.#random())) ** (1 / dimensions);
    this.#speed = 10 ** (2.2 * this.#random() - 1.2);
    this.#share = [0.002, 0.01, 0.05, 0.3, 1][Math.floor(5 * this.#random())]!;
    this.#manners = {
      mixed: this.#chance(0.4),
      turning: this.#chance(0.3),
      speedingUp: this.#chance(0.3),
      jumping: this.#chance(0.2),
      churning: this.#chance(0.3),
      toggling: this.#chance(0.3),
      oneByOne: this.#chance(0.4),
    };
    this.#manners.oneByOne ||= this.#manners.churning;
    this.#boxes = new Float32Array(2 * dimensions * this.#count);
    this.#steps = new Float32Array(dimensions * this.#count);
    for (let id = 0; id < this.#count; id++) {
      this.#place(id);
      this.#give(id);
    }
  }

  /** Moves everything on, and updates both spaces. */
  step(): void {
    const { jumping, churning, toggling, oneByOne } = this.#manners;
    const { dimensions } = this.kept;
    for (let id = 0; id < this.#count; id++) {
      if (this.#gone.has(id)) continue;
      if (jumping && this.#chance(this.#frame % 67 === 66 ? 0.5 : 0.0001)) this.#place(id);
      else if (this.#steps[dimensions * id] !== 0) this.#move(id);
      else continue;
      if (oneByOne) this.#give(id);
    }
    for (let k = 0; churning && k < 3; k++) this.#comeOrGo(this.#anyone());
    const chosen = this.#anyone();
    for (const space of [this.kept, this.#fresh]) {
      if (!oneByOne) space.boxes(this.#count).set(this.#boxes);
      if (toggling && this.#frame % 31 === 30 && !this.#gone.has(chosen))
        space.setStatic(chosen, this.#frame % 2 === 0);
      space.update();
    }
    this.#frame++;
  }

  /** The pairs of a technique that retains nothing, and of the one under test: they should be the same. */
  get pairs(): { expected: string; found: string } {
    return { expected: fingerprint(this.#fresh.pairs), found: fingerprint(this.kept.pairs) };
  }

  dispose(): void {
    for (const space of [this.kept, this.#fresh]) space.dispose();
  }

  #chance(of: number): boolean {
    return this.#random() < of;
  }

  #anyone(): number {
    return Math.floor(this.#count * this.#random());
  }

  /** A new place, size and motion for a box. */
  #place(id: number): void {
    const { dimensions } = this.kept;
    const usual = this.#manners.mixed ? 10 * 3 ** (2 * this.#random() - 1) : 10;
    const size = this.#manners.mixed && this.#chance(0.003) ? this.#world / 4 : usual;
    const moves = this.#chance(this.#share);
    for (let axis = 0; axis < dimensions; axis++) {
      const at = 2 * dimensions * id + axis;
      this.#boxes[at] = this.#random() * this.#world;
      this.#boxes[at + dimensions] = this.#boxes[at]! + size * (0.5 + this.#random());
      this.#steps[dimensions * id + axis] = moves ? this.#anyStep() : 0;
    }
  }

  #anyStep(): number {
    return (2 * this.#random() - 1) * this.#speed;
  }

  #move(id: number): void {
    const { dimensions } = this.kept;
    const turns = this.#manners.turning && this.#chance(0.02);
    for (let axis = 0; axis < dimensions; axis++) {
      const k = dimensions * id + axis;
      const at = k + dimensions * id;
      if (turns) this.#steps[k] = this.#anyStep();
      if (this.#manners.speedingUp) this.#steps[k]! *= 1.02;
      const low = this.#boxes[at]! + this.#steps[k]!;
      if (low < 0 || low > this.#world) this.#steps[k]! *= -1;
      const size = this.#boxes[at + dimensions]! - this.#boxes[at]!;
      this.#boxes[at]! += this.#steps[k]!;
      this.#boxes[at + dimensions] = this.#boxes[at]! + size;
    }
  }

  #comeOrGo(id: number): void {
    if (this.#gone.delete(id)) {
      this.#place(id);
      this.#give(id);
      return;
    }
    this.#gone.add(id);
    for (const space of [this.kept, this.#fresh]) space.delete(id);
  }

  #give(id: number): void {
    const width = 2 * this.kept.dimensions;
    const box = [...this.#boxes.subarray(width * id, width * (id + 1))];
    for (const space of [this.kept, this.#fresh]) setBox(space, id, box);
  }
}

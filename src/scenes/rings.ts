// The article's scene: rings of resting squares, two sides of ring for each, and on every ring one square that goes round.
import { createRandom } from './random.ts';
import { BoxScene, type NumbersType } from './scene.ts';

const side = 10;
/** Between two rings: wide enough that resting squares of different rings never touch. */
const gap = 22;

export class Rings extends BoxScene {
  readonly #movers: { index: number; radius: number; angle: number }[] = [];
  readonly #speed: number;

  constructor(count: number, seed: number, speed: number, Held: NumbersType) {
    const radii = radiiOf(count);
    super('rings', 2, count, 2 * (gap * (radii.length + 1) + side), Held);
    this.#speed = speed;
    const random = createRandom(seed);
    let index = 0;
    for (const { radius, resting } of radii) {
      // Each ring is turned by its own angle, and its mover starts anywhere on it.
      const turn = random();
      this.#movers.push({ index, radius, angle: 2 * Math.PI * random() });
      this.#place(index++, radius, this.#movers.at(-1)!.angle);
      for (let k = 0; k < resting; k++) this.#place(index++, radius, 2 * Math.PI * ((k + turn) / squaresOn(radius)));
    }
  }

  step(): void {
    for (const mover of this.#movers) {
      mover.angle += this.#speed / mover.radius;
      this.#place(mover.index, mover.radius, mover.angle);
    }
  }

  #place(index: number, radius: number, angle: number): void {
    const middle = (this.world - side) / 2;
    this.put(index, 0, middle + radius * Math.cos(angle), side);
    this.put(index, 1, middle + radius * Math.sin(angle), side);
  }
}

const squaresOn = (radius: number) => Math.floor((Math.PI * radius) / side);

/** Ring after ring until the boxes are used up: the last one may be incomplete. */
function radiiOf(count: number): { radius: number; resting: number }[] {
  const radii = [];
  for (let left = count, radius = gap; left > 0; radius += gap) {
    const resting = Math.min(squaresOn(radius), left - 1);
    radii.push({ radius, resting });
    left -= resting + 1;
  }
  return radii;
}

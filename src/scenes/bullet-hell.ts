// Bullet hell: many small fast bullets against few large ships, a hundred to one. Each ship drifts and fires in a
// spiral; a bullet that leaves the world is fired again by its ship.
import { createRandom } from './random.ts';
import { BoxScene, type NumbersType } from './scene.ts';

const bulletsPerShip = 100;
const bulletSize = 4;
/** A bullet is this much faster than what the slow scenes call the speed of a box. */
const bulletHaste = 4;
/** Radians between two bullets of a ship: the golden angle, so that no two fly the same way. */
const spiral = Math.PI * (3 - Math.sqrt(5));
/** The area of the world for each ship, as a side. */
const room = 400;

export class BulletHell extends BoxScene {
  readonly #ships: number;
  readonly #sizes: Float32Array;
  readonly #velocities: Float32Array;
  /** How many bullets have been fired in all. */
  #fired = 0;
  readonly #bulletSpeed: number;

  constructor(count: number, seed: number, speed: number, Held: NumbersType) {
    const ships = Math.ceil(count / (bulletsPerShip + 1));
    super('bullet-hell', 2, count, room * Math.sqrt(ships), Held);
    this.#ships = ships;
    this.#bulletSpeed = bulletHaste * speed;
    this.#sizes = new Float32Array(count).fill(bulletSize);
    this.#velocities = new Float32Array(2 * count);
    const random = createRandom(seed);
    for (let ship = 0; ship < ships; ship++) {
      this.#sizes[ship] = 40 + 80 * random();
      for (let axis = 0; axis < 2; axis++) {
        this.#velocities[2 * ship + axis] = ((2 * random() - 1) * speed) / 2;
        this.put(ship, axis, random() * (this.world - this.#sizes[ship]), this.#sizes[ship]);
      }
    }
    for (let bullet = ships; bullet < count; bullet++) {
      this.#fire(bullet);
      // On its way already, as if the ships had been firing for long.
      const way = random() * (room / this.#bulletSpeed);
      for (let axis = 0; axis < 2; axis++) {
        const at = this.boxes[4 * bullet + axis] + way * this.#velocities[2 * bullet + axis];
        this.put(bullet, axis, Math.min(this.world - bulletSize, Math.max(0, at)), bulletSize);
      }
    }
  }

  step(): void {
    for (let index = 0; index < this.count; index++) {
      let left = false;
      for (let axis = 0; axis < 2; axis++) {
        const size = this.#sizes[index];
        const at = this.boxes[4 * index + axis] + this.#velocities[2 * index + axis];
        const within = Math.min(this.world - size, Math.max(0, at));
        if (within !== at) {
          left = true;
          if (index < this.#ships) this.#velocities[2 * index + axis] *= -1;
        }
        this.put(index, axis, within, size);
      }
      if (left && index >= this.#ships) this.#fire(index);
    }
  }

  /** Puts a bullet into the middle of its ship. */
  #fire(bullet: number): void {
    const ship = bullet % this.#ships;
    const angle = this.#fired++ * spiral;
    this.#velocities[2 * bullet] = this.#bulletSpeed * Math.cos(angle);
    this.#velocities[2 * bullet + 1] = this.#bulletSpeed * Math.sin(angle);
    for (let axis = 0; axis < 2; axis++) {
      const middle = this.boxes[4 * ship + axis] + this.#sizes[ship] / 2;
      this.put(bullet, axis, middle - bulletSize / 2, bulletSize);
    }
  }
}

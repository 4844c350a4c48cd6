// A tile map with walkers: a hundred resting tiles for each walker. The tiles stand a hair apart, so that no two
// touch: pairs of tiles are of no use to anybody.
import { createRandom } from './random.ts';
import { BoxScene, type NumbersType } from './scene.ts';

const tilesPerWalker = 100;
const tileSize = 16;
/** From tile to tile: a quarter of a unit more than a tile, exact in float32 in any world. */
const pitch = 16.25;
const walkerSize = 12;
/** Walkers turn at random once in this many frames, on average. */
const framesPerTurn = 40;

export class TileMap extends BoxScene {
  readonly fixed: number;
  readonly #random;
  readonly #speed: number;
  readonly #velocities: Float32Array;

  constructor(count: number, seed: number, speed: number, Held: NumbersType) {
    const walkers = Math.ceil(count / (tilesPerWalker + 1));
    const tiles = count - walkers;
    const columns = Math.max(1, Math.ceil(Math.sqrt(tiles)));
    super('tile-map', 2, count, columns * pitch, Held);
    this.fixed = tiles;
    this.#random = createRandom(seed);
    this.#speed = speed;
    this.#velocities = new Float32Array(2 * walkers);
    for (let tile = 0; tile < tiles; tile++) {
      this.put(tile, 0, (tile % columns) * pitch, tileSize);
      this.put(tile, 1, Math.floor(tile / columns) * pitch, tileSize);
    }
    for (let walker = 0; walker < walkers; walker++) {
      for (let axis = 0; axis < 2; axis++) {
        this.put(tiles + walker, axis, this.#random() * (this.world - walkerSize), walkerSize);
      }
      this.#turn(walker);
    }
  }

  step(): void {
    for (let walker = 0; 2 * walker < this.#velocities.length; walker++) {
      const index = this.fixed + walker;
      if (this.#random() * framesPerTurn < 1) this.#turn(walker);
      for (let axis = 0; axis < 2; axis++) {
        const at = this.boxes[4 * index + axis] + this.#velocities[2 * walker + axis];
        const within = Math.min(this.world - walkerSize, Math.max(0, at));
        if (within !== at) this.#velocities[2 * walker + axis] *= -1;
        this.put(index, axis, within, walkerSize);
      }
    }
  }

  /** As in such games: along one axis, or at rest. */
  #turn(walker: number): void {
    const way = Math.floor(5 * this.#random());
    this.#velocities[2 * walker] = way === 0 ? this.#speed : way === 1 ? -this.#speed : 0;
    this.#velocities[2 * walker + 1] = way === 2 ? this.#speed : way === 3 ? -this.#speed : 0;
  }
}

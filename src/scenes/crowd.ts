// A crowd as in real-time strategy: squads in formation, each on its way to a place of its own and then to the next,
// right through one another. Within a squad the units stand close, and jostle.
import { createRandom, type Random } from './random.ts';
import { BoxScene, type NumbersType } from './scene.ts';

const unitsPerSquad = 64;
const ranks = 8;
const unitSize = 8;
/** From unit to unit in a formation. */
const spacing = 10;
/** How far a unit strays from its place: neighbours meet now and then. */
const stray = 2;
/** The area of the world for each squad, as a side: three times that of a formation. */
const room = 240;

export class Crowd extends BoxScene {
  readonly #random: Random;
  readonly #speed: number;
  readonly #squads: { x: number; y: number; toX: number; toY: number }[];
  /** Where in its wobble each unit is, in radians. */
  readonly #phases: Float32Array;
  #frame = 0;

  constructor(count: number, seed: number, speed: number, Held: NumbersType) {
    const squads = Math.ceil(count / unitsPerSquad);
    super('crowd', 2, count, room * Math.max(1, Math.sqrt(squads)), Held);
    const random = createRandom(seed);
    this.#random = random;
    this.#speed = speed;
    this.#squads = Array.from({ length: squads }, () => ({
      x: this.#somewhere(),
      y: this.#somewhere(),
      toX: this.#somewhere(),
      toY: this.#somewhere(),
    }));
    this.#phases = Float32Array.from({ length: count }, () => 2 * Math.PI * random());
    this.#placeAll();
  }

  step(): void {
    this.#frame++;
    for (const squad of this.#squads) {
      const distance = Math.hypot(squad.toX - squad.x, squad.toY - squad.y);
      if (distance <= this.#speed) {
        squad.toX = this.#somewhere();
        squad.toY = this.#somewhere();
      } else {
        squad.x += ((squad.toX - squad.x) / distance) * this.#speed;
        squad.y += ((squad.toY - squad.y) / distance) * this.#speed;
      }
    }
    this.#placeAll();
  }

  /** Where the first unit of a squad can stand so that all of it stands in the world. */
  #somewhere(): number {
    return stray + this.#random() * (this.world - ranks * spacing - 2 * stray);
  }

  #placeAll(): void {
    for (let index = 0; index < this.count; index++) {
      const squad = this.#squads[Math.floor(index / unitsPerSquad)];
      const place = index % unitsPerSquad;
      const phase = this.#phases[index] + 0.1 * this.#frame;
      this.put(index, 0, squad.x + (place % ranks) * spacing + stray * Math.cos(phase), unitSize);
      this.put(index, 1, squad.y + Math.floor(place / ranks) * spacing + stray * Math.sin(phase), unitSize);
    }
  }
}

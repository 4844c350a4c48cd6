// One thing in the world: a box that moves by Verlet integration.
//
// There is no velocity property. The velocity is how far the entity has moved since the previous step, pos - ppos, so
// whoever moves pos (a collision response, say) changes the velocity with it, and the two cannot contradict each other.
// It is a distance per step, not per second: the world's steps should all be equally long, and its loop sees to that.
import type { AABB } from './aabb.ts';
import * as ov3 from './ov3.ts';
import type { Vector } from './vector.ts';
import type { World } from './world.ts';

/** The default colour of an entity: a blue that is visible on white and on black. */
const DEFAULT_COLOR = '#7f9cc0';

/**
 * One thing in the world: a box that moves by Verlet integration. Its velocity is how far it moved in the previous step,
 * `pos - ppos`.
 *
 * @example
 * const entity = new Entity(10, 20, 4, 4);
 * entity.ppos.x = 9; // so it moves by 1 a step
 * entity.inertia(16);
 * entity.pos; // → { x: 11, y: 20 }
 */
export class Entity {
  /** The number the world knows this entity by; -1 before it is in one. */
  _roId = -1;
  /** The world this entity is in. */
  world: World | null = null;
  /** The upper left corner, in world units. */
  pos: Vector;
  /** Where pos was one step before. Set both to put an entity somewhere without giving it a velocity. */
  ppos: Vector;
  /** Width and height. May change at any time: halfSize and the AABB follow at the next `updateAABB`. */
  size: Vector;
  /** Half of the size, as of the last `updateAABB`. */
  readonly halfSize: Vector;
  /** Acceleration in units per millisecond squared. Used up, and reset to zero, by every `accelerate`. */
  accel: Vector = { x: 0, y: 0 };
  readonly #aabb: AABB = { min: [0, 0], max: [0, 0] };

  /**
   * @param x left edge, finite
   * @param y upper edge, finite
   * @param width 0 or more, finite
   * @param height 0 or more, finite
   * @throws RangeError for a value out of range, naming it.
   *
   * @example
   * new Entity(0, 0, -1, 4); // throws RangeError: size is { x: -1, y: 4 }
   */
  constructor(x: number, y: number, width: number, height: number) {
    this.pos = { x, y };
    this.ppos = { x, y };
    this.size = { x: width, y: height };
    this.halfSize = { x: width / 2, y: height / 2 };
    this.updateAABB();
  }

  /** Frameworks that wrap what they hold in proxies, such as Vue, leave alone objects whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'Entity';
  }

  /**
   * The box in absolute coordinates, as of the last `updateAABB`. The same object every time: copy it to keep it.
   *
   * @example
   * new Entity(10, 20, 4, 4).getAABB(); // → { min: [10, 20], max: [14, 24] }
   */
  getAABB(): AABB {
    return this.#aabb;
  }

  /**
   * Turns the acceleration into a change of position over `dt` milliseconds.
   *
   * @example
   * const entity = new Entity(0, 0, 4, 4);
   * entity.accel.y = 0.5;
   * entity.accelerate(2);
   * entity.pos.y; // → 2
   */
  accelerate(dt: number): void {
    this.pos.x += this.accel.x * dt * dt;
    this.pos.y += this.accel.y * dt * dt;
    this.accel.x = 0;
    this.accel.y = 0;
  }

  /**
   * Moves on as far as in the step before: pos + (pos - ppos). A `dt` of 0 moves nothing, since no time has passed.
   *
   * @example
   * const entity = new Entity(0, 0, 4, 4);
   * entity.pos.x = 3;
   * entity.inertia(16);
   * entity.pos.x; // → 6
   */
  inertia(dt: number): void {
    if (dt === 0) return;
    const { x, y } = this.pos;
    this.pos.x += x - this.ppos.x;
    this.pos.y += y - this.ppos.y;
    this.ppos.x = x;
    this.ppos.y = y;
  }

  /**
   * Makes the AABB (and halfSize) those of the present pos and size. The world does this twice in every step.
   * @throws RangeError when pos or size is not finite or a size is negative; the AABB stays as it was.
   *
   * @example
   * const entity = new Entity(0, 0, 4, 4);
   * entity.pos.x = 3;
   * entity.updateAABB();
   * entity.getAABB().max; // → [7, 4]
   */
  updateAABB(): void {
    const { pos, size, halfSize } = this;
    if (!Number.isFinite(pos.x) || !Number.isFinite(pos.y)) {
      throw new RangeError(`${this.#name()}: pos is ${ov3.str(pos)}, expected finite numbers`);
    }
    if (!(Number.isFinite(size.x) && Number.isFinite(size.y) && size.x >= 0 && size.y >= 0)) {
      throw new RangeError(`${this.#name()}: size is ${ov3.str(size)}, expected finite numbers, 0 or more`);
    }
    const { min, max } = this.#aabb;
    min[0] = pos.x;
    min[1] = pos.y;
    max[0] = pos.x + size.x;
    max[1] = pos.y + size.y;
    halfSize.x = size.x / 2;
    halfSize.y = size.y / 2;
  }

  /**
   * Fills the box on the world's screen. Without a screen it does nothing.
   * @param color any CSS colour
   *
   * @example
   * new Entity(0, 0, 4, 4).draw('tomato'); // → undefined
   */
  draw(color: string = DEFAULT_COLOR): void {
    const ctx = this.world?.screen?.ctx;
    if (!ctx) return;
    ctx.fillStyle = color;
    ctx.fillRect(this.pos.x, this.pos.y, this.size.x, this.size.y);
  }

  #name(): string {
    return this._roId < 0 ? 'ro.Entity' : `ro.Entity ${this._roId}`;
  }
}

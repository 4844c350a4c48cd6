// The library as a collision technique: entities in, pairs of entities out, any of its techniques in between.
//
// The library knows boxes by small integers of the caller's choice. A world's _roIds only ever grow, so each entity
// gets a slot here instead, and a slot that was given up is used again: memory follows the number of entities, however
// many come and go. Everything but the search is linear in entities and pairs.
import { type BroadPhaseOptions, BroadPhase as Space } from 'broadphase';
import type { Collidable } from '../aabb.ts';
import type { Entity } from '../entity.ts';
import { EntityList, type Pair } from './technique.ts';

/**
 * The library as a collision technique: entities in, pairs of entities out, any of its techniques in between.
 *
 * @example
 * const world = new World(null, { coltech: new coltech.BroadPhase({ technique: 'strip-sweep' }) });
 * for (const x of [0, 5]) world.addEntity(new Entity(x, 0, 10, 10));
 * world.step();
 * world.broadPhase.queryForCollisionPairs().length; // → 1
 */
export class BroadPhase<E extends Collidable = Entity> extends EntityList<E> {
  /** The library's own object, for what the engine's interface does not say: queries, filters, statistics. */
  readonly space: Space;
  readonly #slots: (E | undefined)[] = [];
  readonly #slotOf = new Map<E, number>();
  readonly #free: number[] = [];

  /** @param options those of `broadphase`; the world is flat, so `dimensions` is always 2 */
  constructor(options: Omit<BroadPhaseOptions, 'dimensions'> = {}) {
    super();
    this.space = new Space({ ...options, dimensions: 2 });
  }

  /**
   * The id of an entity in `space`, its own until it is removed.
   * @throws Error for an entity that is not here
   *
   * @example
   * const technique = new coltech.BroadPhase();
   * const entity = new Entity(0, 0, 1, 1);
   * new World(null, { coltech: technique }).addEntity(entity);
   * technique.idOf(entity); // → 0
   */
  idOf(entity: E): number {
    const slot = this.#slotOf.get(entity);
    if (slot === undefined) throw new Error(`idOf: entity ${entity._roId} is not here, expected one that was added`);
    return slot;
  }

  override addEntity(entity: E): void {
    super.addEntity(entity);
    const slot = this.#free.pop() ?? this.#slots.length;
    this.#slots[slot] = entity;
    this.#slotOf.set(entity, slot);
    this.#place(slot, entity);
  }

  override removeEntity(entity: E): void {
    super.removeEntity(entity);
    const slot = this.idOf(entity);
    this.#slotOf.delete(entity);
    this.#slots[slot] = undefined;
    this.#free.push(slot);
    this.space.delete(slot);
  }

  override update(): void {
    super.update();
    this.#slots.forEach((entity, slot) => {
      if (entity) this.#place(slot, entity);
    });
    this.space.update();
    this.totalCells = this.allocatedCells = this.space.stats.cells;
  }

  queryForCollisionPairs(): Pair<E>[] {
    this.refresh();
    const ids = this.space.pairs;
    const pairs: Pair<E>[] = [];
    for (let i = 0; i < ids.length; i += 2) {
      const a = this.#slots[ids[i]] as E;
      const b = this.#slots[ids[i + 1]] as E;
      pairs.push(a._roId < b._roId ? [a, b] : [b, a]);
    }
    this.collisionTests = this.space.stats.tests;
    return pairs;
  }

  /**
   * Strokes the cells, strips or nodes that the library's technique now uses.
   *
   * @example
   * // In a world with a canvas, `debug: true` does so in each step.
   * const world = new World(null, { coltech: new coltech.BroadPhase(), debug: true });
   * world.step(); // → undefined
   */
  draw(ctx: CanvasRenderingContext2D): void {
    const boxes = this.space.structure();
    for (let i = 0; i < boxes.length; i += 4) {
      ctx.strokeRect(boxes[i], boxes[i + 1], boxes[i + 2] - boxes[i], boxes[i + 3] - boxes[i + 1]);
    }
  }

  #place(slot: number, entity: E): void {
    const { min, max } = entity.getAABB();
    this.space.set(slot, min[0], min[1], max[0], max[1]);
  }
}

// What every collision technique has in common: the interface the world talks to, the list of entities, the counters,
// and the test of two boxes.
import { type Collidable, checkAABB } from '../aabb.ts';
import type { Entity } from '../entity.ts';

/** Two entities whose boxes overlap; in a world, the one that was added first comes first. */
export type Pair<E> = [a: E, b: E];

/** What a world needs of a technique. Anything with `entities` and these four methods can be its `coltech`. */
export interface Technique<E extends Collidable = Entity> {
  /** The entities it looks after. */
  readonly entities: readonly E[];
  /** From now on, looks after this entity too. */
  addEntity(entity: E): void;
  /** No longer looks after this entity. */
  removeEntity(entity: E): void;
  /** Reads where the entities are now. Nothing may move between it and a query that follows, as in a world's step. */
  update(): void;
  /** Every pair of entities whose boxes overlap, each pair once. Those in `coltech` need no update before. */
  queryForCollisionPairs(): Pair<E>[];
  /** Strokes the structure it searches, in world units. */
  draw?(ctx: CanvasRenderingContext2D): void;
}

/**
 * The part of a technique that is the same for all of them: to write one, add `queryForCollisionPairs`, which calls
 * `refresh` first if it needs `update`.
 *
 * @example
 * class Nothing extends coltech.EntityList {
 *   queryForCollisionPairs() {
 *     return [];
 *   }
 * }
 * const world = new World(null, { coltech: new Nothing() });
 * world.step(); // → undefined
 */
export abstract class EntityList<E extends Collidable = Entity> implements Technique<E> {
  /** Tests of one box against another in the last query. */
  collisionTests = 0;
  /** Pairs looked up in the table of tested pairs in the last query. */
  hashChecks = 0;
  /** Cells the structure could have. */
  totalCells = 0;
  /** Cells that hold something, and so take memory, since the last update. */
  allocatedCells = 0;
  /** Arrays the last update made, all of them garbage at the next one. */
  arraysCreated = 0;
  readonly #byId = new Map<number, E>();
  /** The entities as an array, until one is added or removed. */
  #list: readonly E[] | undefined;
  /** Whether the next query comes right after an update. */
  #fresh = false;

  /** Frameworks that wrap what they hold in proxies, such as Vue, leave alone objects whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'EntityList';
  }

  /**
   * In the order they were added. A new array after one was added or removed, so that a loop over this one may do
   * both as it goes.
   */
  get entities(): readonly E[] {
    this.#list ??= [...this.#byId.values()];
    return this.#list;
  }

  /**
   * @throws RangeError for an id that is not an integer of 0 or more or a box that is not one, Error for an entity
   * that is here already or has another's id; the list stays as it was.
   */
  addEntity(entity: E): void {
    const id = entity._roId;
    if (!Number.isInteger(id) || id < 0) {
      throw new RangeError(
        `addEntity: the entity's _roId is ${id}, expected an integer of 0 or more; a world gives one`,
      );
    }
    const present = this.#byId.get(id);
    if (present === entity) throw new Error(`addEntity: entity ${id} is here already, expected one that is not`);
    if (present) throw new Error(`addEntity: another entity has the _roId ${id}, expected each to have its own`);
    checkAABB(entity);
    this.#byId.set(id, entity);
    this.#changed();
  }

  /** @throws Error for an entity that is not here; the list stays as it was. */
  removeEntity(entity: E): void {
    if (this.#byId.get(entity._roId) !== entity) {
      throw new Error(`removeEntity: entity ${entity._roId} is not here, expected one that was added`);
    }
    this.#byId.delete(entity._roId);
    this.#changed();
  }

  #changed(): void {
    this.#list = undefined;
    this.#fresh = false;
  }

  /** @throws RangeError for the first entity whose box is not one (NaN, or min above max), naming it. */
  update(): void {
    for (const entity of this.#byId.values()) checkAABB(entity);
    this.#fresh = true;
  }

  /**
   * Updates, unless `update` was called since the last query, and nothing was added or removed since: the first thing
   * that a query does. So a world's step updates once, and a query at any other time sees the boxes as they are.
   * @throws as `update` does.
   *
   * @example
   * const technique = new coltech.SpatialGrid(0, 0, 100, 100, 10);
   * new World(null, { coltech: technique }).addEntity(new Entity(0, 0, 4, 4));
   * technique.refresh();
   * technique.allocatedCells; // → 1
   */
  refresh(): void {
    if (!this.#fresh) this.update();
    this.#fresh = false;
  }

  abstract queryForCollisionPairs(): Pair<E>[];

  /**
   * Whether two boxes have a point in common; touching is enough.
   *
   * @example
   * new coltech.BruteForce().aabb2DIntersection(new Entity(0, 0, 1, 1), new Entity(1, 1, 1, 1)); // → true
   */
  aabb2DIntersection(entityA: Collidable, entityB: Collidable): boolean {
    const a = entityA.getAABB();
    const b = entityB.getAABB();

    // On each axis the boxes are two intervals. A gap between them on one axis, and the boxes are apart; no gap on
    // either, and they overlap. For boxes with parallel sides no other direction has to be looked at.
    return a.min[0] <= b.max[0] && a.max[0] >= b.min[0] && a.min[1] <= b.max[1] && a.max[1] >= b.min[1];
  }
}

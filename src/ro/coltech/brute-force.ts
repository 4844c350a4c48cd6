// Brute force: every entity is tested against every other.
//
// n entities make n * (n - 1) / 2 tests, 4,950 for 100 of them, and there is nothing to build, to keep or to tune.
// Nothing beats it for a handful. Twice as many entities are four times the work.
import type { Collidable } from '../aabb.ts';
import type { Entity } from '../entity.ts';
import { EntityList, type Pair } from './technique.ts';

/**
 * Brute force: every entity is tested against every other, n * (n - 1) / 2 tests for n of them.
 *
 * @example
 * const technique = new coltech.BruteForce();
 * const world = new World(null, { coltech: technique });
 * for (let k = 0; k < 100; k++) world.addEntity(new Entity(20 * k, 0, 10, 10));
 * world.step();
 * technique.collisionTests; // → 4950
 */
export class BruteForce<E extends Collidable = Entity> extends EntityList<E> {
  queryForCollisionPairs(): Pair<E>[] {
    const { entities } = this;
    const pairs: Pair<E>[] = [];
    this.collisionTests = 0;

    for (let i = 0; i < entities.length; i++) {
      // Starting behind i: the entities before it have been tested against it already.
      for (let j = i + 1; j < entities.length; j++) {
        this.collisionTests++;
        if (this.aabb2DIntersection(entities[i], entities[j])) pairs.push([entities[i], entities[j]]);
      }
    }

    return pairs;
  }
}

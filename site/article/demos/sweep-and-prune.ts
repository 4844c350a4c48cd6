// Sweep and prune: sorts the boxes by their left edges, and compares each with the following ones as far as it reaches.
//
// The order of the last step is nearly sorted in this one, so insertion sort is the right sort here: a box that was not
// overtaken costs one comparison.
import { coltech, type Entity } from 'broadphase/ro';

export class SweepAndPrune extends coltech.EntityList {
  /** By their left edges. */
  readonly sorted: Entity[] = [];
  /** Boxes that overtook another since the last update. */
  swaps = 0;

  override addEntity(entity: Entity): void {
    super.addEntity(entity);
    this.sorted.push(entity);
  }

  override removeEntity(entity: Entity): void {
    super.removeEntity(entity);
    this.sorted.splice(this.sorted.indexOf(entity), 1);
  }

  override update(): void {
    super.update();
    const { sorted } = this;
    this.swaps = 0;

    for (let i = 1; i < sorted.length; i++) {
      const entity = sorted[i];
      let at = i;
      for (; at > 0 && leftOf(sorted[at - 1]) > leftOf(entity); at--) {
        sorted[at] = sorted[at - 1];
        this.swaps++;
      }
      sorted[at] = entity;
    }
  }

  queryForCollisionPairs(): coltech.Pair<Entity>[] {
    const { sorted } = this;
    const pairs: coltech.Pair<Entity>[] = [];
    this.collisionTests = 0;

    for (let i = 0; i < sorted.length; i++) {
      const a = sorted[i];
      const reach = a.getAABB().max[0];

      for (let j = i + 1; j < sorted.length; j++) {
        const b = sorted[j];
        if (leftOf(b) > reach) break; // and so does everything after it
        this.collisionTests++;
        if (this.aabb2DIntersection(a, b)) pairs.push(a._roId < b._roId ? [a, b] : [b, a]);
      }
    }

    return pairs;
  }
}

const leftOf = (entity: Entity) => entity.getAABB().min[0];

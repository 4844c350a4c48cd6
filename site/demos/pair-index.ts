// The pairs of a step, kept so that two questions are quick to answer: do these two collide, and with whom does this one?
//
// Built once per step, from the list of all pairs. A question is then a look-up, however many pairs there are.
import type { coltech, Entity } from 'broadphase/ro';

export class PairIndex {
  readonly #partners = new Map<Entity, Set<Entity>>();

  constructor(pairs: readonly coltech.Pair<Entity>[]) {
    for (const [a, b] of pairs) {
      this.#add(a, b);
      this.#add(b, a);
    }
  }

  isColliding(a: Entity, b: Entity): boolean {
    return this.#partners.get(a)?.has(b) ?? false;
  }

  collisionsOf(entity: Entity): Iterable<Entity> {
    return this.#partners.get(entity) ?? [];
  }

  #add(entity: Entity, partner: Entity): void {
    const partners = this.#partners.get(entity);
    if (partners) partners.add(partner);
    else this.#partners.set(entity, new Set([partner]));
  }
}

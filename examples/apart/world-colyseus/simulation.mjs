// The entities of one zone, and the shard that finds who sees whom among them and the ghosts of other zones.
import { BroadPhase } from 'broadphase';
import { Shard } from 'broadphase/shard';
import { boxOf, isAvatar, move, sight, xInZone } from './world.mjs';

/**
 * Ticks for which handed-over entities are remembered, in case the other zone is lost. When it is back, they are
 * remembered for as long again, since it may be lost before its next snapshot.
 */
const remembered = 60;

/** The tick of a hand-over that took place at some time before a restart. */
const before = -1;

export class Simulation {
  /** The entities that this zone owns, by id. */
  entities = new Map();
  shard;
  #zones;
  /** Recently handed-over entities: the entity, its new zone, when, and until when it is remembered. */
  #handedOver = [];

  constructor(zones, zone) {
    this.#zones = zones;
    this.zone = zone;
    this.#begin();
  }

  #begin() {
    // Only pairs with a client's entity matter.
    const space = new BroadPhase({ events: true });
    const entered = (id) => space.setFilter(id, isAvatar(id) ? 1 : 2, isAvatar(id) ? 3 : 1);
    this.shard = new Shard(this.#zones, this.zone, space, { entered });
  }

  /**
   * Restarts with those of these entities that other zones do not own, as after an interruption. `owners` has the zone of
   * each that is owned. These are remembered too, in case their zone is lost before its next snapshot: it may not be
   * known here any more that they were handed over.
   */
  restart(entities, owners = new Map(), tick = 0) {
    this.#begin();
    this.entities = new Map(entities.filter(({ id }) => !owners.has(id)).map((entity) => [entity.id, entity]));
    const known = new Set(this.#handedOver.map(({ entity }) => entity.id));
    for (const entity of entities) {
      const to = owners.get(entity.id);
      if (to !== undefined && !known.has(entity.id))
        this.#handedOver.push({ entity, to, tick: before, until: tick + remembered });
    }
  }

  /** Moves all entities, and finds out what to send to the other zones. */
  step(tick, isOpen) {
    const shut = (x) => {
      const zone = this.#zones.ownerOf(boxOf({ x, y: 0 }));
      return zone !== this.zone && !isOpen(zone);
    };
    for (const entity of this.entities.values()) {
      // After an interruption it may own some that it had handed over. They come back, since the shard would hand them
      // over again, to nobody.
      if (shut(entity.x)) entity.x = xInZone(this.#zones, this.zone, entity.x);
      move(entity, shut);
      this.shard.set(entity.id, ...boxOf(entity));
    }
    const deltas = this.shard.exchange();
    for (const given of this.#handedOver) if (!isOpen(given.to)) given.until = tick + remembered;
    this.#handedOver = this.#handedOver.filter(({ until }) => until > tick);
    const given = this.shard.given.map((id) => {
      const entity = this.entities.get(id);
      this.entities.delete(id);
      return { entity, to: this.#zones.ownerOf(boxOf(entity)), tick, until: tick + remembered };
    });
    for (const one of given) this.#handedOver.push(one);
    return { deltas, given };
  }

  /** Takes what the other zones sent: their deltas, and the entities that they handed over. */
  finish(deltas, arrivals) {
    for (const entity of arrivals) this.entities.set(entity.id, entity);
    this.shard.update(deltas);
  }

  /** All entities that this zone may have to continue with: its own, and handed-over ones that may not have arrived. */
  everybody() {
    return [...this.#handedOver.map(({ entity }) => entity), ...this.entities.values()];
  }

  /** The entities handed to a zone after a tick. */
  handedTo(zone, since) {
    return this.#handedOver.filter(({ to, tick }) => to === zone && tick > since).map(({ entity }) => entity);
  }

  /** The entities that a zone owned when this one restarted. What that zone knows of them is newer. */
  leftTo(zone) {
    return this.#handedOver.filter(({ to, tick }) => to === zone && tick === before).map(({ entity }) => entity);
  }

  /** Recent hand-overs to zones other than this: for each the entity's id, its new zone, and when. */
  handedToOthersThan(zone) {
    return this.#handedOver.filter(({ to }) => to !== zone).map(({ entity, to, tick }) => [entity.id, to, tick]);
  }

  /** The place of an entity that this zone sees: its own, or a ghost. */
  placeOf(id, out) {
    const own = this.entities.get(id);
    if (own) {
      out.x = own.x;
      out.y = own.y;
      return true;
    }
    const box = this.shard.space.get(id, this.#box);
    if (!box) return false;
    out.x = box[0] + sight / 2;
    out.y = box[1] + sight / 2;
    return true;
  }
  #box = new Float64Array(4);

  /** What an entity of this zone sees. */
  seenBy(id) {
    return this.shard.space.has(id) ? this.shard.space.collisionsOf(id) : [];
  }
}

// One zone of a world cut into zones: the boxes it owns, ghosts of others that extend into it, and a space of both.
// Idea: a zone's space has all boxes that the zone sees. So it finds every pair the zone must report, and some more,
// which are left out (Zones.reporterOf). For events, the space must also know where every box it sees was at the
// previous update. So a box that enters comes with its previous box, and is put there first, in an update of its own. A
// box that leaves stays for one more update. The events are then those of the space itself, in wrapped worlds too.
// Cost: that of the space, one check per changed box and exchange, two lookups per pair.
import type { BroadPhase } from 'broadphase';
import { badValue, checkBoolean, checkBox, checkId, checkOptions } from '../errors.ts';
import { checkSpace, watch } from '../watch.ts';
import { type Box, type Delta, type Message, pack, type Told, unpack } from './delta.ts';
import { checkOther, checkWorld, checkZone, checkZones, insideOf, type Zones } from './zones.ts';

/** Options of {@link Shard}. */
export interface ShardOptions {
  /**
   * Called for each box that enters the space, before it counts: the place for `setFilter` and the like. It cannot
   * change the shard. If it throws, so does {@link Shard.update}, which then waits to be called again.
   */
  entered?: ((id: number) => void) | undefined;
  /**
   * The result of {@link Shard.state}: the shard continues from there, with the zones as of then. If the state is old, the
   * others have to {@link Shard.resend} to this zone, and it to them. What they send replaces what is in the state.
   */
  state?: Delta | undefined;
}

/** A box that the zone sees. */
interface Seen {
  readonly id: number;
  box: Box;
  /** Its box as of the last update; empty: there was none. */
  before: Box;
  owner: number;
  /**
   * The zone that last told of it, or this one. If it is the owner, the owner knows that it owns it: a hand-over by
   * another zone may still be on its way.
   */
  teller: number;
  /** The zones that see it; if this one owns it, as of the last exchange. */
  seers: readonly number[];
}

/**
 * One zone of a world cut into {@link Zones}: boxes in, and those pairs out that this zone has to report. All zones
 * together report exactly the pairs of one space with all boxes, each once, and so for `began` and `ended`.
 *
 * In each tick, every zone calls `set` and `delete` for the boxes it owns and `exchange`, sends the result to the other
 * zones, and calls `update` with what they sent. Between two exchanges boxes may move, and `update` may be called, as long
 * as none moves further than the margin; `set` then moves ghosts too. For contacts ahead of time, enlarge the boxes.
 *
 * @example
 * const zones = new Zones({ borders: { x: [100] } });
 * const [left, right] = [0, 1].map((zone) => new Shard(zones, zone, new BroadPhase({ events: true })));
 * left.set(7, 80, 0, 110, 10); // reaches into the right zone
 * right.set(9, 105, 0, 115, 10);
 * const deltas = [...left.exchange(), ...right.exchange()];
 * for (const shard of [left, right]) shard.update(deltas.filter(({ to }) => to === shard.zone));
 * left.pairs; // → Uint32Array []
 * right.pairs; // → Uint32Array [7, 9]
 */
export class Shard {
  /** Which zone this is. */
  readonly zone: number;
  /**
   * The space with all boxes that the zone sees, for queries and filters. Only the shard may set and delete its boxes,
   * and update it.
   */
  readonly space: BroadPhase<2 | 3>;
  /** Ids that other zones own since the last exchange. */
  readonly given: number[] = [];
  /** Ids that this zone owns since the last update. */
  readonly taken: number[] = [];
  /** The pairs that this zone reports: `[a0, b0, a1, b1, …]` with a < b. A new array, independent of later calls. */
  pairs = new Uint32Array();
  /** Of all pairs of the world that began with the last update, those that this zone reports. */
  began = new Uint32Array();
  /** Of all pairs of the world that ended with the last update, those that this zone reported or would have. */
  ended = new Uint32Array();
  readonly #entered: (id: number) => void;
  readonly #seen = new Map<number, Seen>();
  /** Boxes removed since the last update; their ids may be in use again. */
  readonly #gone = new Map<number, Seen>();
  /** Boxes changed since the last update. */
  readonly #changed = new Set<Seen>();
  /** Boxes set or deleted since the last exchange. */
  readonly #untold = new Set<Seen>();
  /** The changes to send to each zone at the next exchange. */
  readonly #told: readonly Told[][];
  /** The zones that are sent everything at the next exchange. */
  readonly #resent = new Set<number>();
  /** Boxes that come into sight, with their previous boxes, until the space has had them there. */
  readonly #entering = new Map<number, Box>();
  /** Boxes in the space for which `entered` has not yet returned; and whether it is being called. */
  readonly #fresh = new Set<number>();
  #isEntering = false;
  /** The zones that were forgotten, and have sent nothing since. */
  readonly #forgotten = new Set<number>();
  /** The zones as of the last update, and as of the last exchange. */
  #zones: Zones;
  #nextZones: Zones;

  /**
   * @param zones how the world is cut, the same in every process
   * @param zone which of them this is, from 0
   * @param space an empty one with `events: true`, and with the same `dimensions` and `wrap` as the zones
   * @throws RangeError or TypeError that names what does not fit
   *
   * @example
   * new Shard(new Zones({ borders: { x: [0] } }), 2, new BroadPhase({ events: true })); // throws RangeError: zone: got 2
   */
  constructor(zones: Zones, zone: number, space: BroadPhase<2 | 3>, options: ShardOptions = {}) {
    checkZones('zones', zones);
    checkZone('zone', zone, zones.count);
    checkSpace('space', space);
    checkOptions('new Shard', options, ['entered', 'state']);
    const { entered = () => {}, state } = options;
    if (typeof entered !== 'function') badValue('entered', entered, 'a function', true);
    checkWorld('space', space.dimensions, space[watch](null).wrap, zones, 'as in the zones');
    if (space.size > 0) badValue('space.size', space.size, 'an empty space');
    void space.began; // throws if events are off
    const kept = state === undefined ? [] : [unpack('state', state, zone, zones)];
    this.#told = Array.from({ length: zones.count }, () => []);
    this.zone = zone;
    this.space = space;
    this.#zones = this.#nextZones = zones;
    this.#entered = entered;
    for (const message of kept) this.#apply([message]).update(); // the second update, so that no pair has begun
  }

  /**
   * Adds or moves a box that this zone owns. Boxes may be added anywhere: at the exchange the zone that contains its
   * lower corner becomes the owner. An id is free again after an exchange in which it was deleted.
   *
   * @throws as `set` of a BroadPhase does. The shard is as before.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true }));
   * shard.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update().began; // → Uint32Array [7, 9]
   */
  set(id: number, ...box: number[]): this {
    this.#check('set');
    checkBox('set', id, box, this.space.dimensions);
    this.#untold.add(this.#move(id, box));
    return this;
  }

  /**
   * Deletes a box that this zone owns. Returns whether there was one.
   *
   * @throws RangeError for a box that another zone owns
   *
   * @example
   * const shard = new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true }));
   * shard.set(7, 0, 0, 10, 10).delete(7); // → true
   */
  delete(id: number): boolean {
    this.#check('delete');
    checkId('delete', id);
    const seen = this.#seen.get(id);
    if (!seen) return false;
    if (seen.owner !== this.zone) badValue('delete', id, `a box of zone ${this.zone}, not of zone ${seen.owner}`);
    for (const to of seen.seers) if (to !== this.zone) this.#told[to].push([id]);
    this.#remove(id);
    this.#untold.add(seen);
    return true;
  }

  /**
   * Whether this zone owns a box, as of the last exchange and update.
   *
   * @example
   * new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true })).owns(7); // → false
   */
  owns(id: number): boolean {
    checkId('owns', id);
    return this.#seen.get(id)?.owner === this.zone;
  }

  /**
   * Whether this zone sees a box: one that it owns, or a ghost.
   *
   * @example
   * new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true })).sees(7); // → false
   */
  sees(id: number): boolean {
    checkId('sees', id);
    return this.#seen.has(id);
  }

  /**
   * The ids of all boxes that this zone sees, or only of those that it owns.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true }));
   * [...shard.set(7, 0, 0, 1, 1).ids()]; // → [7]
   */
  ids(owned = false): Generator<number> {
    checkBoolean('ids: owned', owned);
    return this.#ids(owned);
  }

  *#ids(owned: boolean): Generator<number> {
    for (const [id, { owner }] of this.#seen) if (!owned || owner === this.zone) yield id;
  }

  /**
   * Finds out what the other zones must be told: one delta for each to which something changed. Boxes whose lower corner
   * has left this zone are handed over; {@link Shard.given} names them.
   *
   * @param zones with other borders from now on; then every zone has to give the same at the same exchange
   *
   * @example
   * const shard = new Shard(new Zones({ borders: { x: [100] } }), 0, new BroadPhase({ events: true }));
   * const [delta] = shard.set(7, 120, 0, 130, 10).exchange();
   * [delta.to, ...delta.ids]; // → [1, 7]
   * shard.given; // → [7]
   */
  exchange(zones: Zones = this.#nextZones): Delta[] {
    this.#check('exchange');
    checkZones('exchange', zones);
    if (zones.count !== this.#told.length) badValue('zones.count', zones.count, `${this.#told.length}, as before`);
    checkWorld('zones', zones.dimensions, insideOf(zones).wrap, this.#nextZones, 'as before');
    for (const zone of this.#resent) this.#unknow(zone);
    const all = zones === this.#nextZones ? this.#untold : this.#seen.values();
    this.#nextZones = zones;
    this.given.length = 0;
    for (const seen of all) if (seen.owner === this.zone) this.#tell(seen);
    this.#untold.clear();
    return this.#told.flatMap((told, to) => {
      const isAll = this.#resent.delete(to);
      return told.length > 0 || isAll ? pack(this.zone, to, told.splice(0), isAll) : [];
    });
  }

  /**
   * Updates pairs and events. Chainable.
   *
   * @param deltas those that the exchanges of other zones returned for this one; if there are several of one zone, all in
   *   the order in which they were sent
   * @throws RangeError or TypeError for what is no delta from another zone to this one. The shard is as before. Also throws
   *   what `entered` throws: then call `update` again with the same deltas, which calls `entered` again for that box.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: { x: [100] } }), 1, new BroadPhase({ events: true }));
   * const [ids, changes, boxes] = [Uint32Array.of(7), Uint8Array.of(0), Float64Array.of(120, 0, 130, 10)];
   * shard.update([{ from: 0, to: 1, ids, changes, boxes }]).taken; // → [7]
   */
  update(deltas: readonly Delta[] = []): this {
    this.#check('update');
    if (!Array.isArray(deltas)) badValue('update', deltas, 'an array of deltas', true);
    return this.#apply(deltas.map((delta: Delta) => unpack('update: delta', delta, this.zone, this.#zones)));
  }

  #apply(messages: readonly Message[]): this {
    this.taken.length = 0;
    this.#hear(messages);
    // First to where it was at the previous update, so that the space knows what overlapped then.
    for (const [id, before] of this.#entering) {
      this.#seen.get(id)!.before = before;
      this.#place(id, before);
    }
    if (this.#entering.size > 0) this.space.update();
    this.#entering.clear();
    for (const id of this.#gone.keys()) this.space.delete(id);
    for (const { id, box } of this.#changed) this.#place(id, box);
    this.space.update();
    const now = (id: number) => this.#seen.get(id)?.box;
    const before = (id: number) => (this.#gone.get(id) ?? this.#seen.get(id))?.before;
    this.pairs = this.#reported(this.space.pairs, this.#nextZones, now);
    this.began = this.#reported(this.space.began, this.#nextZones, now);
    this.ended = this.#reported(this.space.ended, this.#zones, before);
    this.#zones = this.#nextZones;
    for (const seen of this.#changed) {
      seen.before = seen.box;
      if (seen.seers.includes(this.zone)) continue;
      // It has left, and the pairs that ended with it are recorded.
      this.space.delete(seen.id);
      this.#seen.delete(seen.id);
    }
    this.#changed.clear();
    this.#gone.clear();
    return this;
  }

  /**
   * Sends a zone everything again at the next exchange: for one that was restarted, with an old state or without. It
   * drops whatever else it has of this zone.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: { x: [100] } }), 0, new BroadPhase({ events: true }));
   * shard.set(7, 90, 0, 110, 10).exchange();
   * shard.update().resend(1);
   * shard.exchange()[0].ids; // → Uint32Array [7]
   */
  resend(zone: number): void {
    this.#check('resend');
    checkOther('resend', zone, this.zone, this.#told.length);
    this.#resent.add(zone);
  }

  /**
   * Drops all boxes of another zone: for one that is unreachable. With the next update it is as if they had been
   * deleted.
   *
   * @example
   * const zones = new Zones({ borders: { x: [100] } });
   * const [left, right] = [0, 1].map((zone) => new Shard(zones, zone, new BroadPhase({ events: true })));
   * right.update(left.set(7, 90, 0, 110, 10).exchange()).space.size; // → 1
   * right.forget(0);
   * right.update().space.size; // → 0
   */
  forget(zone: number): void {
    this.#check('forget');
    checkOther('forget', zone, this.zone, this.#told.length);
    this.#forgotten.add(zone);
    for (const [id, { owner }] of this.#seen) if (owner === zone) this.#remove(id);
  }

  /**
   * The shard's state as typed arrays, for a process that continues in its place. Zones and filters are not included.
   *
   * @throws Error if boxes have changed since the last exchange or update
   *
   * @example
   * const zones = new Zones({ borders: { x: [100] } });
   * const shard = new Shard(zones, 0, new BroadPhase({ events: true })).set(7, 0, 0, 10, 10);
   * shard.exchange();
   * const state = shard.update().state();
   * new Shard(zones, 0, new BroadPhase({ events: true }), { state }).owns(7); // → true
   */
  state(): Delta {
    const [open] = [...this.#changed, ...this.#untold, ...this.#gone.values()];
    if (open) throw new Error(`state: box ${open.id} has changed, expected an exchange and an update first`);
    const [zone] = this.#resent;
    if (zone !== undefined) throw new Error(`state: zone ${zone} waits for everything, expected an exchange first`);
    const all = Array.from(this.#seen, ([id, { box }]): Told => [id, box]);
    return pack(this.zone, this.zone, all);
  }

  /** Sets where a box, which may be new here, is from the next update on. */
  #move(id: number, box: Box): Seen {
    const seen = this.#seen.get(id) ?? { id, box, before: [], owner: this.zone, teller: this.zone, seers: [this.zone] };
    seen.box = box;
    this.#seen.set(id, seen);
    this.#changed.add(seen);
    return seen;
  }

  #remove(id: number): void {
    const seen = this.#seen.get(id);
    if (!seen) return;
    seen.owner = -1; // nobody's
    this.#changed.delete(seen);
    this.#seen.delete(id);
    this.#entering.delete(id);
    // It may be in the space without a previous box, if `entered` threw.
    if (seen.before.length > 0 || (!this.#gone.has(id) && this.space.has(id))) this.#gone.set(id, seen);
  }

  /** From now on a zone counts as knowing no box. */
  #unknow(zone: number): void {
    for (const seen of this.#seen.values()) {
      if (!seen.seers.includes(zone)) continue;
      seen.seers = seen.seers.filter((other) => other !== zone);
      this.#untold.add(seen);
    }
  }

  /** Collects the changes of a box that this zone owns for the other zones. */
  #tell(seen: Seen): void {
    const { id, box, before, seers: known } = seen;
    seen.owner = this.#nextZones.ownerOf(box);
    seen.seers = this.#nextZones.seenBy(box);
    seen.teller = this.zone;
    if (seen.owner !== this.zone) this.given.push(id);
    if (!seen.seers.includes(this.zone)) this.#changed.add(seen); // so that it leaves
    for (let to = 0; to < this.#told.length; to++) {
      const knows = known.includes(to);
      const sees = seen.seers.includes(to);
      const isNews = knows !== sees || (sees && (seen.owner !== this.zone || this.#untold.has(seen)));
      if (to === this.zone || !isNews) continue;
      this.#told[to].push(knows || before.length === 0 ? [id, box] : [id, box, before]);
    }
  }

  /** Applies the changes that zones told, in the order in which they came. */
  #hear(messages: readonly Message[]): void {
    const done = this.#removeDeleted(messages);
    for (const { from, told, isAll } of messages) {
      // Pairs with boxes of a forgotten zone have ended here. So they begin now, wherever these boxes were before.
      const isBack = this.#forgotten.delete(from) && isAll;
      if (isAll) this.#dropRest(from, messages);
      for (const one of told) {
        const [id, box, before] = one;
        if (before && !isBack && !this.#seen.has(id)) this.#entering.set(id, before);
        if (box) this.#receive(id, box, from);
        // Another zone has added this id if `entered` threw after these messages were heard.
        else if (!done.has(one) && this.#seen.get(id)?.owner === from) this.#remove(id);
      }
    }
  }

  /**
   * Removes what its owner has deleted: another zone may have added a box with that id, and come first. Only as the first
   * message of each zone says, since a later one may be about boxes that these messages tell of. Returns what is done.
   */
  #removeDeleted(messages: readonly Message[]): Set<Told> {
    const done = new Set<Told>();
    const heard = new Set<number>();
    for (const { from, told } of messages) {
      for (const one of heard.has(from) ? [] : told) {
        const [id, box] = one;
        if (box || this.#seen.get(id)?.owner !== from) continue;
        this.#remove(id);
        done.add(one);
      }
      heard.add(from);
    }
    return done;
  }

  /**
   * Drops the boxes of a zone that it should have told, but did not. Not those of which it may not know yet that it
   * owns them.
   */
  #dropRest(zone: number, messages: readonly Message[]): void {
    const ids = new Set(messages.flatMap(({ told }) => told.map(([id]) => id)));
    for (const [id, { owner, teller }] of this.#seen) {
      if (owner === zone && teller === zone && !ids.has(id)) this.#remove(id);
    }
  }

  #receive(id: number, box: Box, from: number): void {
    const seen = this.#move(id, box);
    seen.owner = this.#nextZones.ownerOf(box);
    seen.seers = this.#nextZones.seenBy(box);
    seen.teller = from === this.zone ? seen.owner : from; // from a state: all had been told of long ago
    if (seen.owner === this.zone) this.taken.push(id);
  }

  #place(id: number, [a, b, c, d, e, f]: Box): void {
    if (!this.space.has(id)) this.#fresh.add(id);
    if (this.space.dimensions === 2) this.space.set(id, a, b, c, d);
    else this.space.set(id, a, b, c, d, e, f);
    if (!this.#fresh.has(id)) return;
    this.#isEntering = true;
    try {
      this.#entered(id);
    } finally {
      this.#isEntering = false;
    }
    this.#fresh.delete(id);
  }

  /** Throws if nothing may change now: during a call of `entered`, and once the space was disposed. */
  #check(where: string): void {
    if (this.#isEntering) throw new Error(`${where}: called by entered, expected only after update`);
    void this.space.size;
  }

  /** The pairs that this zone reports. A box without a previous or present box has entered since, or has left. */
  #reported(pairs: Uint32Array, zones: Zones, placeOf: (id: number) => Box | undefined) {
    const { reporterOf } = insideOf(zones);
    const own = new Uint32Array(pairs.length);
    let length = 0;
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [placeOf(pairs[k]), placeOf(pairs[k + 1])];
      if (!a?.length || !b?.length || reporterOf(a, b) !== this.zone) continue;
      own[length++] = pairs[k];
      own[length++] = pairs[k + 1];
    }
    return own.slice(0, length);
  }
}

// One zone of a world that is cut: the boxes it owns, the ghosts of others that reach into it, and a space of both.
// Idea: a zone's space holds all that the zone sees, so it finds every pair the zone must report, and some more, which
// are left out (Zones.reporterOf). For events the space must also know where at the update before everything was that
// it sees now. So a box that enters brings its earlier box along, and is put there first, in an update of its own; a box
// that leaves stays for one update more. What began and ended is then what the space itself says, wrapped worlds too.
// Cost: that of the space, a look at each box that changed per exchange, two look-ups per pair.
import type { BroadPhase } from 'broadphase';
import { badBox, badCount, badId, badValue, maxId } from '../errors.ts';
import { Change, type Delta, pack, type Told, unpack } from './delta.ts';
import type { Zones } from './zones.ts';

/** A shard between two ticks, to go on from in another process: see {@link Shard.state}. */
export interface ShardState {
  /** The boxes that the zone sees. */
  ids: Uint32Array;
  /** For each id the zone that owns it. */
  owners: Uint16Array;
  /** For each id its box: minima, then maxima. */
  boxes: Float64Array;
}

/** Options of {@link Shard}. */
export interface ShardOptions {
  /** Called for each box that comes into the space, and before it counts: the place for `setFilter` and its like. */
  entered?: (id: number) => void;
  /** What {@link Shard.state} gave: the shard goes on from there. */
  state?: ShardState;
}

/** A box that the zone sees. */
interface Seen {
  readonly id: number;
  owner: number;
  now: readonly number[];
  /** As of the last update. */
  before: readonly number[];
  /** If this zone owns it: the zones that see it as of the last exchange. */
  seers: readonly number[];
  flags: number;
}

/** The box stands in the space. */
const here = 1;
/** It is to be put where it was at the update before, first. */
const enters = 2;
/** It is another than the one in the space, if there is one. */
const added = 4;
const leaves = 8;
const gone = 16;

/**
 * One zone of a world cut into {@link Zones}: boxes in, and those pairs out that this zone has to report. All zones
 * together report exactly the pairs of one space with all boxes, each once, and so for `began` and `ended`.
 *
 * Each tick, in every zone: `set` and `delete` the boxes it owns, `exchange`, send what that gives to the other zones,
 * and `update` with what they sent. Between two exchanges boxes may move, and `update` be called, as long as none moves
 * further than the margin; `set` then moves ghosts too. For contact distances, give boxes that are grown by them.
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
  /** What the zone sees, for queries and filters. Only the shard sets and deletes its boxes, and updates it. */
  readonly space: BroadPhase<2 | 3>;
  /** Ids that other zones own since the last exchange. */
  readonly given: number[] = [];
  /** Ids that this zone owns since the last update. */
  readonly taken: number[] = [];
  readonly #entered: (id: number) => void;
  readonly #seen = new Map<number, Seen>();
  /** For these the next update has to do something. */
  readonly #touched = new Set<Seen>();
  /** Of these, which this zone owns, the others are to be told at the next exchange. */
  readonly #untold = new Set<Seen>();
  /** Zones that know nothing. */
  readonly #blank = new Set<number>();
  /** What each zone is told. */
  readonly #told: readonly Told[][];
  /** As of the last update, and as of the last exchange. */
  #zones: Zones;
  #nextZones: Zones;
  #pairs = new Uint32Array();
  #began = new Uint32Array();
  #ended = new Uint32Array();

  /**
   * @param zones how the world is cut, the same in every process
   * @param zone which of them this is, from 0
   * @param space an empty one with `events: true`, and with `dimensions` and `wrap` as the zones have them
   * @throws RangeError or TypeError that names what does not fit
   *
   * @example
   * new Shard(new Zones({ borders: { x: [0] } }), 2, new BroadPhase({ events: true })); // throws RangeError: zone: got 2
   */
  constructor(zones: Zones, zone: number, space: BroadPhase<2 | 3>, options: ShardOptions = {}) {
    if (!(Number.isInteger(zone) && zone >= 0 && zone < zones.count)) {
      badValue('zone', zone, `an integer from 0 to ${zones.count - 1}`);
    }
    if (space.dimensions !== zones.dimensions) badValue('space.dimensions', space.dimensions, `${zones.dimensions}`);
    if (space.size > 0) badValue('space.size', space.size, 'an empty space');
    void space.began; // throws where there are no events
    this.zone = zone;
    this.space = space;
    this.#zones = this.#nextZones = zones;
    this.#entered = options.entered ?? (() => {});
    this.#told = Array.from({ length: zones.count }, () => []);
    if (options.state) this.#restore(options.state);
  }

  /** How the world is cut, as of the last exchange. */
  get zones(): Zones {
    return this.#nextZones;
  }

  /**
   * The pairs that this zone reports: `[a0, b0, a1, b1, …]` with a < b. An array of its own, which stays.
   */
  get pairs(): Uint32Array {
    return this.#pairs;
  }

  /** Of all pairs of the world that began with the last update, those that this zone reports. */
  get began(): Uint32Array {
    return this.#began;
  }

  /** Of all pairs of the world that ended with the last update, those that this zone reported or would have. */
  get ended(): Uint32Array {
    return this.#ended;
  }

  /**
   * Adds a box that this zone owns, or moves one. Boxes may be added anywhere: at the exchange the zone with its lower
   * corner becomes the owner. An id is free again after an exchange in which it was deleted.
   *
   * @throws as `set` of a BroadPhase does. All is as before.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true }));
   * shard.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update().began; // → Uint32Array [7, 9]
   */
  set(id: number, ...box: number[]): this {
    const { dimensions } = this.space;
    if (!(Number.isInteger(id) && id >= 0 && id <= maxId)) badId('set', id);
    if (box.length !== 2 * dimensions) badCount('set', id, box.length + 1, dimensions);
    for (let k = 0; k < dimensions; k++) if (!(box[k] <= box[k + dimensions])) badBox('set', id, box, dimensions);
    const isNew = !this.sees(id);
    const seen = this.#touch(id, isNew ? added : 0, box);
    seen.flags &= ~gone;
    if (isNew) seen.owner = this.zone;
    if (seen.owner === this.zone) this.#untold.add(seen);
    return this;
  }

  /**
   * Deletes a box that this zone owns. Gives whether there was one.
   *
   * @throws RangeError for a box that another zone owns
   *
   * @example
   * const shard = new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true }));
   * shard.set(7, 0, 0, 10, 10).delete(7); // → true
   */
  delete(id: number): boolean {
    const seen = this.#find(id);
    if (!seen) return false;
    if (seen.owner !== this.zone) badValue('delete', id, `a box of zone ${this.zone}, not of zone ${seen.owner}`);
    this.#untold.add(this.#touch(id, gone));
    return true;
  }

  /**
   * Whether this zone owns a box, as of the last exchange and update.
   *
   * @example
   * new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true })).owns(7); // → false
   */
  owns(id: number): boolean {
    return this.#find(id)?.owner === this.zone;
  }

  /**
   * Whether this zone sees a box: one that it owns, or a ghost.
   *
   * @example
   * new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true })).sees(7); // → false
   */
  sees(id: number): boolean {
    return this.#find(id) !== undefined;
  }

  /**
   * The ids of all boxes that this zone sees, or only of those that it owns.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: {} }), 0, new BroadPhase({ events: true }));
   * [...shard.set(7, 0, 0, 1, 1).ids()]; // → [7]
   */
  *ids(owned = false): Generator<number> {
    for (const { id, owner, flags } of this.#seen.values()) {
      if (!(flags & gone) && (!owned || owner === this.zone)) yield id;
    }
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
    if (zones.count !== this.#told.length) badValue('zones.count', zones.count, `${this.#told.length}, as before`);
    const all = zones !== this.#nextZones || this.#blank.size > 0;
    this.#nextZones = zones;
    this.given.length = 0;
    for (const seen of all ? this.#seen.values() : this.#untold) if (seen.owner === this.zone) this.#tell(seen);
    this.#untold.clear();
    this.#blank.clear();
    return this.#told.flatMap((told, to) => (told.length > 0 ? pack(this.zone, to, told.splice(0)) : []));
  }

  /**
   * Brings pairs and events up to date. Chainable.
   *
   * @param deltas what other zones gave at their exchanges for this one
   * @throws RangeError for a delta that is for another zone
   *
   * @example
   * const shard = new Shard(new Zones({ borders: { x: [100] } }), 1, new BroadPhase({ events: true }));
   * const [ids, changes, boxes] = [Uint32Array.of(7), Uint8Array.of(1 + 4 + 8), Float64Array.of(120, 0, 130, 10)];
   * shard.update([{ from: 0, to: 1, ids, changes, boxes }]).taken; // → [7]
   */
  update(deltas: readonly Delta[] = []): this {
    const told = deltas.flatMap((delta) => unpack(delta, this.zone, this.space.dimensions));
    this.taken.length = 0;
    // What is gone comes first: another zone may have added a box with that id.
    for (const { id, change } of told) if (change & Change.gone && this.#seen.has(id)) this.#touch(id, gone);
    for (const each of told) if (!(each.change & Change.gone)) this.#receive(each);
    this.#enter();
    for (const seen of this.#touched) {
      const { id, flags, now } = seen;
      if (flags & here && flags & (gone | added)) this.space.delete(id);
      if (flags & gone) continue;
      this.#place(id, now);
      if (flags & added) this.#entered(id);
    }
    this.space.update();
    this.#pairs = this.#reported(this.space.pairs, this.#nextZones, 'now');
    this.#began = this.#reported(this.space.began, this.#nextZones, 'now');
    this.#ended = this.#reported(this.space.ended, this.#zones, 'before');
    this.#zones = this.#nextZones;
    this.#settle();
    return this;
  }

  /**
   * Tells a zone all anew at the next exchange: one that was started again without its state.
   *
   * @example
   * const shard = new Shard(new Zones({ borders: { x: [100] } }), 0, new BroadPhase({ events: true }));
   * shard.set(7, 90, 0, 110, 10).exchange();
   * shard.update().resend(1);
   * shard.exchange()[0].ids; // → Uint32Array [7]
   */
  resend(zone: number): void {
    this.#blank.add(zone);
  }

  /**
   * Drops all that another zone owns: one that is out of reach. With the next update it is as if it had been deleted.
   *
   * @example
   * const zones = new Zones({ borders: { x: [100] } });
   * const [left, right] = [0, 1].map((zone) => new Shard(zones, zone, new BroadPhase({ events: true })));
   * right.update(left.set(7, 90, 0, 110, 10).exchange()).space.size; // → 1
   * right.forget(0);
   * right.update().space.size; // → 0
   */
  forget(zone: number): void {
    if (zone === this.zone) badValue('forget', zone, 'another zone than this');
    for (const { id, owner } of this.#seen.values()) if (owner === zone) this.#touch(id, gone);
  }

  /**
   * The shard as it is, as typed arrays: for a process that goes on in its place. Zones and filters are not in it.
   *
   * @throws Error where boxes have changed that the other zones were not told of, or that were not updated
   *
   * @example
   * const zones = new Zones({ borders: { x: [100] } });
   * const shard = new Shard(zones, 0, new BroadPhase({ events: true })).set(7, 0, 0, 10, 10);
   * shard.exchange();
   * const state = shard.update().state();
   * new Shard(zones, 0, new BroadPhase({ events: true }), { state }).owns(7); // → true
   */
  state(): ShardState {
    const [open] = [...this.#touched, ...this.#untold];
    if (open) throw new Error(`state: box ${open.id} has changed, expected an exchange and an update since then`);
    const all = [...this.#seen.values()];
    return {
      ids: Uint32Array.from(all, ({ id }) => id),
      owners: Uint16Array.from(all, ({ owner }) => owner),
      boxes: Float64Array.from(all.flatMap(({ now }) => now)),
    };
  }

  #restore({ ids, owners, boxes }: ShardState): void {
    const width = 2 * this.space.dimensions;
    for (const [k, id] of ids.entries()) {
      const now = Array.from(boxes.subarray(k * width, (k + 1) * width));
      const seers = this.#zones.seenBy(now);
      // It enters from where it is, so nothing begins.
      Object.assign(this.#touch(id, enters, now), { owner: owners[k], before: now, seers });
    }
    this.update();
  }

  #find(id: number): Seen | undefined {
    const seen = this.#seen.get(id);
    return seen && seen.flags & gone ? undefined : seen;
  }

  /** Notes for the next update what happens to a box, which may be new here. */
  #touch(id: number, flags: number, now?: readonly number[]): Seen {
    const seen = this.#seen.get(id) ?? { id, owner: this.zone, now: [], before: [], seers: [], flags: 0 };
    this.#seen.set(id, seen);
    this.#touched.add(seen);
    seen.flags |= flags;
    if (now) seen.now = now;
    return seen;
  }

  /** Tells the other zones what is new of a box that this zone owns. */
  #tell(seen: Seen): void {
    const { id, flags, now, before } = seen;
    const isGone = (flags & gone) > 0;
    const isNew = (flags & added) > 0;
    const known = seen.seers.filter((zone) => zone !== this.zone && !this.#blank.has(zone));
    const seers = isGone ? [] : this.#nextZones.seenBy(now);
    const owner = isGone ? this.zone : this.#nextZones.ownerOf(now);
    for (const to of seers) {
      const knows = known.includes(to);
      if (to === this.zone || (knows && to !== owner && !this.#untold.has(seen))) continue;
      const change = (knows ? 0 : Change.enters) | (to === owner ? Change.owned : 0) | (isNew ? Change.added : 0);
      this.#told[to].push({ id, change, boxes: knows || isNew ? [now] : [now, before] });
    }
    for (const to of known) {
      if (seers.includes(to)) continue;
      if (isGone || isNew) this.#told[to].push({ id, change: Change.gone, boxes: [] });
      else this.#told[to].push({ id, change: Change.leaves, boxes: [now] });
    }
    seen.seers = owner === this.zone ? seers : [];
    if (!isGone && !seers.includes(this.zone)) this.#touch(id, leaves);
    if (owner === this.zone) return;
    seen.owner = owner;
    this.given.push(id);
  }

  #receive({ id, change, boxes: [now, before] }: Told): void {
    const known = this.#seen.get(id);
    // What nobody has told of before, because that got lost, is as good as new.
    const isNew = change & Change.added || (!known && !before);
    const seen = this.#touch(id, isNew ? added : 0, now);
    if (before && !(seen.flags & here)) {
      seen.flags |= enters;
      seen.before = before;
    }
    seen.flags &= ~(gone | leaves);
    if (change & Change.leaves) seen.flags |= leaves;
    const isOwned = (change & Change.owned) > 0;
    seen.owner = isOwned ? this.zone : this.#nextZones.ownerOf(now);
    if (!isOwned) return;
    this.taken.push(id);
    seen.seers = this.#nextZones.seenBy(now);
  }

  /** Puts what enters where it was at the update before, so that the space knows what overlapped then. */
  #enter(): void {
    let some = false;
    for (const seen of this.#touched) {
      if (!(seen.flags & enters)) continue;
      some = true;
      this.#place(seen.id, seen.before);
      this.#entered(seen.id);
      seen.flags |= here;
    }
    if (some) this.space.update();
  }

  #place(id: number, [a, b, c, d, e, f]: readonly number[]): void {
    if (this.space.dimensions === 2) this.space.set(id, a, b, c, d);
    else this.space.set(id, a, b, c, d, e, f);
  }

  /** Those pairs that this zone reports. A box without that place came into sight since, or has left. */
  #reported(pairs: Uint32Array, zones: Zones, when: 'now' | 'before') {
    const own = new Uint32Array(pairs.length);
    let length = 0;
    for (let k = 0; k < pairs.length; k += 2) {
      const a = this.#seen.get(pairs[k])?.[when];
      const b = this.#seen.get(pairs[k + 1])?.[when];
      if (!a?.length || !b?.length || zones.reporterOf(a, b) !== this.zone) continue;
      own[length++] = pairs[k];
      own[length++] = pairs[k + 1];
    }
    return own.slice(0, length);
  }

  /** After an update: what has left goes, and of what stays this is the update before. */
  #settle(): void {
    for (const seen of this.#touched) {
      const { id, flags } = seen;
      if (flags & gone && this.#untold.has(seen) && seen.seers.length > 0) {
        // The others are to be told first.
        seen.flags = gone;
        seen.before = [];
        continue;
      }
      this.#touched.delete(seen);
      if (flags & (gone | leaves)) {
        if (!(flags & gone)) this.space.delete(id);
        this.#seen.delete(id);
        this.#untold.delete(seen);
      } else {
        seen.before = seen.now;
        seen.flags = here;
      }
    }
  }
}

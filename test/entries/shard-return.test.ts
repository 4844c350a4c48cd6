// Zones that die and return with a state of any age, as the guide says: the others forget them and resend, and so do
// they. From the exchange on in which a zone returns, all zones together answer as one space does: who owns and sees
// what, which pairs there are, and from the tick after it which began and ended.
import { BroadPhase } from 'broadphase';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import { describe, expect, test } from 'vitest';
import { createRandom, type Random } from '../../src/scenes/random.ts';
import { keysOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const ticks = 250;
const ids = 60;

interface World {
  dimensions: 2 | 3;
  wraps?: boolean;
  cuts: Partial<Record<'x' | 'y' | 'z', number>>;
  margin?: number;
}

const size = 100;
const worlds: Record<string, World> = {
  '2D, two zones': { dimensions: 2, cuts: { x: 1 } },
  '2D, along both axes': { dimensions: 2, cuts: { x: 2, y: 1 } },
  '2D, wrapped, with a margin': { dimensions: 2, wraps: true, cuts: { x: 2 }, margin: 3 },
  '3D, along x and z': { dimensions: 3, cuts: { x: 1, z: 1 } },
};

/** What a zone has saved: its state, and how the world was cut then. */
interface Saved {
  state: Delta;
  zones: Zones;
}

/** A state without these ids: they have other owners by now. */
function without(has: ReadonlySet<number>, { state, zones }: Saved): Delta {
  const width = 2 * zones.dimensions;
  const stays = (k: number) => !has.has(state.ids[k]);
  return {
    ...state,
    ids: state.ids.filter((_, k) => stays(k)),
    changes: state.changes.filter((_, k) => stays(k)),
    boxes: state.boxes.filter((_, k) => stays(Math.floor(k / width))),
  };
}

/** All that is played: the zones, dead ones undefined, and the one space with the boxes of those that live. */
class Game {
  readonly counts = { pairs: 0, began: 0, ended: 0, died: 0, returned: 0, borders: 0 };
  readonly #random: Random;
  readonly #world: World;
  readonly #whole: BroadPhase<2 | 3>;
  readonly #boxes = new Map<number, number[]>();
  readonly #saved: Saved[][];
  readonly #shards: (Shard | undefined)[];
  /** Zones that returned in this tick: of what happened while they were away they know nothing. */
  readonly #returned = new Set<number>();
  /** Ids that were deleted in this tick: they are free again after the exchange. */
  readonly #deleted = new Set<number>();
  #before = new Map<number, number[]>();
  #zones: Zones;
  #zonesBefore: Zones;

  constructor(world: World, random: Random) {
    this.#world = world;
    this.#random = random;
    this.#whole = this.#space();
    this.#zones = this.#zonesBefore = this.#cut();
    this.#shards = Array.from({ length: this.#zones.count }, (_, zone) => new Shard(this.#zones, zone, this.#space()));
    this.#saved = this.#shards.map(() => []);
  }

  #wrap = () => (this.#world.wraps ? Array<number>(this.#world.dimensions).fill(size) : undefined);
  #space = () => new BroadPhase({ dimensions: this.#world.dimensions, events: true, wrap: this.#wrap() });
  #below = (limit: number) => Math.floor(this.#random() * limit);
  #alive = () => this.#shards.filter((shard) => shard !== undefined);

  #cut(): Zones {
    const { dimensions, cuts, margin } = this.#world;
    const borders = Object.entries(cuts).map(([axis, count]) => [
      axis,
      Array.from({ length: count }, () => this.#below(size)).sort((a, b) => a - b),
    ]);
    return new Zones({ borders: Object.fromEntries(borders), dimensions, margin, wrap: this.#wrap() });
  }

  #box(): number[] {
    const low = Array.from({ length: this.#world.dimensions }, () => this.#below(size));
    const most = this.#random() < 0.1 ? size : 12;
    return [...low, ...low.map((at) => at + this.#below(most))];
  }

  #set(shard: Shard, id: number, box: number[]): void {
    shard.set(id, ...box);
    this.#keep(id, box);
  }

  #keep(id: number, box: number[]): void {
    this.#boxes.set(id, box);
    setBox(this.#whole, id, box);
  }

  #delete(shard: Shard, id: number): void {
    shard.delete(id);
    this.#deleted.add(id);
    this.#lose(id);
  }

  #lose(id: number): void {
    this.#boxes.delete(id);
    this.#whole.delete(id);
  }

  #change(shard: Shard): void {
    for (const id of [...shard.ids(true)]) {
      const kind = this.#random();
      if (kind < 0.04) this.#delete(shard, id);
      else if (kind < 0.08) this.#set(shard, id, this.#box());
      else if (kind < 0.4) {
        const by = Array.from({ length: this.#world.dimensions }, () => this.#below(9) - 4);
        this.#set(
          shard,
          id,
          this.#boxes.get(id)!.map((at, k) => at + by[k % by.length]),
        );
      }
    }
    const id = this.#below(ids);
    const isFree = !this.#boxes.has(id) && !this.#deleted.has(id);
    if (isFree && !shard.sees(id)) this.#set(shard, id, this.#box());
  }

  #die(zone: number): void {
    for (const id of this.#shards[zone]!.ids(true)) this.#lose(id);
    this.#shards[zone] = undefined;
    for (const shard of this.#alive()) shard.forget(zone);
    this.counts.died++;
  }

  #return(zone: number): void {
    const others = this.#alive();
    const owned = new Set(others.flatMap((shard) => [...shard.ids(true)]));
    const saved = this.#saved[zone][this.#below(this.#saved[zone].length)] as Saved | undefined;
    const state = saved && without(owned, saved);
    const shard = new Shard(saved?.zones ?? this.#zones, zone, this.#space(), { state });
    for (const id of shard.ids(true)) this.#keep(id, [...shard.space.get(id)!]);
    for (const [other, there] of this.#shards.entries()) if (!there && other !== zone) shard.forget(other);
    for (const other of others) {
      other.resend(zone);
      shard.resend(other.zone);
    }
    this.#shards[zone] = shard;
    this.#returned.add(zone);
    this.counts.returned++;
  }

  tick(): void {
    this.#returned.clear();
    for (const [zone, shard] of this.#shards.entries()) {
      if (!shard && this.#random() < 0.15) this.#return(zone);
      else if (shard && this.#alive().length > 1 && this.#random() < 0.03) this.#die(zone);
    }
    for (const shard of this.#alive()) this.#change(shard);
    if (this.#random() < 0.1) {
      this.#zones = this.#cut();
      this.counts.borders++;
    }
    // No box goes to a zone that is not there.
    for (const shard of this.#alive()) {
      for (const id of [...shard.ids(true)]) {
        if (this.#shards[this.#zones.ownerOf(this.#boxes.get(id)!)]) continue;
        this.#delete(shard, id);
      }
    }
    this.#deleted.clear();
    const deltas = this.#alive().flatMap((shard) => shard.exchange(this.#zones));
    for (const shard of this.#alive()) {
      shard.update(structuredClone(deltas.filter(({ to }) => to === shard.zone)));
      if (this.#random() < 0.1)
        this.#saved[shard.zone].push({ state: structuredClone(shard.state()), zones: this.#zones });
    }
    this.#compare();
    this.#before = new Map(this.#boxes);
    this.#zonesBefore = this.#zones;
  }

  #compare(): void {
    this.#whole.update();
    for (const shard of this.#alive()) {
      const of = (zonesOf: (box: number[]) => boolean) =>
        [...this.#boxes].flatMap(([id, box]) => (zonesOf(box) ? id : [])).sort();
      const owned = of((box) => this.#zones.ownerOf(box) === shard.zone);
      expect([...shard.ids(true)].sort(), `owned by ${shard.zone}`).toEqual(owned);
      const seen = of((box) => this.#zones.seenBy(box).includes(shard.zone));
      expect([...shard.ids()].sort(), `seen by ${shard.zone}`).toEqual(seen);
    }
    this.#compareOne('pairs', this.#alive(), this.#boxes, this.#zones);
    const there = this.#alive().filter(({ zone }) => !this.#returned.has(zone));
    this.#compareOne('began', there, this.#boxes, this.#zones);
    this.#compareOne('ended', there, this.#before, this.#zonesBefore);
  }

  /** The pairs that these zones report, with those of the one space that are theirs to report. */
  #compareOne(kind: 'pairs' | 'began' | 'ended', shards: Shard[], boxes: Map<number, number[]>, zones: Zones): void {
    const numbers = new Set(shards.map(({ zone }) => zone));
    const all = this.#whole[kind];
    const expected: number[] = [];
    for (let k = 0; k < all.length; k += 2) {
      const [a, b] = [all[k], all[k + 1]];
      if (numbers.has(zones.reporterOf(boxes.get(a)!, boxes.get(b)!))) expected.push(a, b);
    }
    expect(keysOf(shards.flatMap((shard) => [...shard[kind]])).sort(), kind).toEqual(keysOf(expected).sort());
    this.counts[kind] += expected.length / 2;
  }
}

describe(`zones that die and return (SEED=${seed})`, () => {
  test.each(Object.entries(worlds))('%s: as one space has them', { tags: 'long' }, (name, world) => {
    const counts = { pairs: 0, began: 0, ended: 0, died: 0, returned: 0, borders: 0 };
    for (let run = 0; run < runs(8); run++) {
      const game = new Game(world, createRandom(seed + run + name.length * 7919));
      for (let tick = 0; tick < ticks; tick++) {
        try {
          game.tick();
        } catch (error) {
          throw new Error(`SEED=${seed}, ${name}, run ${run}, tick ${tick}: ${(error as Error).message}`, {
            cause: error,
          });
        }
      }
      for (const kind of Object.keys(counts) as (keyof typeof counts)[]) counts[kind] += game.counts[kind];
    }
    for (const [kind, count] of Object.entries(counts)) expect(count, kind).toBeGreaterThan(ticks / 100);
  });
});

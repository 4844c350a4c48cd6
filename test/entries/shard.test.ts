// A cut world against one space that has all boxes: at every tick the zones together report the same pairs, each once,
// and the same that began and ended; with borders that move, teleports, giant boxes, ids used again, and zones that are
// started again from their state. TICKS=10000 plays that many ticks a world (the whole: npm run test:shard); SEED=… runs
// a failure again.
import { BroadPhase } from 'broadphase';
import { type Borders, type Delta, Shard, Zones } from 'broadphase/shard';
import { describe, expect, test } from 'vitest';
import { createRandom, type Random } from '../../src/scenes/random.ts';
import { keysOf } from '../support/reference.ts';
import { seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const ticks = Number(process.env.TICKS ?? 300);

interface World {
  dimensions: 2 | 3;
  size: number;
  wraps: boolean;
  /** How many borders along each axis that is cut. */
  cuts: Partial<Record<'x' | 'y' | 'z', number>>;
  /** How far boxes move in the ticks between two exchanges, and how many such ticks there are at most. */
  margin: number;
  between: number;
}

const worlds: Record<string, World> = {
  '2D, along x': { dimensions: 2, size: 100, wraps: false, cuts: { x: 2 }, margin: 0, between: 0 },
  '2D, along both axes': { dimensions: 2, size: 100, wraps: false, cuts: { x: 2, y: 3 }, margin: 0, between: 0 },
  '2D, with a margin': { dimensions: 2, size: 100, wraps: false, cuts: { x: 3, y: 1 }, margin: 6, between: 3 },
  '2D, wrapped': { dimensions: 2, size: 100, wraps: true, cuts: { x: 3 }, margin: 0, between: 0 },
  '2D, wrapped, with a margin': { dimensions: 2, size: 100, wraps: true, cuts: { x: 2, y: 2 }, margin: 4, between: 2 },
  '3D, along y': { dimensions: 3, size: 60, wraps: false, cuts: { y: 2 }, margin: 0, between: 0 },
  '3D, along x and z': { dimensions: 3, size: 60, wraps: false, cuts: { x: 1, z: 2 }, margin: 3, between: 2 },
  '3D, wrapped': { dimensions: 3, size: 60, wraps: true, cuts: { x: 2, y: 1 }, margin: 0, between: 0 },
};

/** Whole steps mostly, so that boxes touch each other and the borders; else what no float holds. */
const aPlace = (random: Random, size: number): number =>
  random() < 0.6 ? Math.floor(random() * size) : random() * 1.2 * size - 0.1 * size;

function aBox(random: Random, { dimensions, size }: World): number[] {
  const low = Array.from({ length: dimensions }, () => aPlace(random, size));
  const kind = random();
  const most = kind < 0.04 ? 2 * size : kind < 0.1 ? size / 2 : 8;
  const endless = random() < 0.005;
  return [...low, ...low.map((at) => (endless ? Infinity : at + Math.floor(random() * most * 4) / 4))];
}

const shifted = (box: readonly number[], by: readonly number[]) => box.map((value, k) => value + by[k % by.length]);

function aZones(random: Random, { dimensions, size, wraps, cuts, margin }: World): Zones {
  const borders: Borders = {};
  for (const [axis, count] of Object.entries(cuts)) {
    borders[axis as 'x'] = Array.from({ length: count }, () => aPlace(random, size))
      .map((at) => Math.min(size, Math.max(0, at)))
      .sort((a, b) => a - b);
  }
  return new Zones({ borders, dimensions, margin, ...(wraps ? { wrap: Array(dimensions).fill(size) } : {}) });
}

/** All that is played: the zones, and the one space with the same boxes. */
class Game {
  readonly counts = { pairs: 0, began: 0, ended: 0, given: 0, restarts: 0, borders: 0, thrown: 0 };
  readonly boxes = new Map<number, number[]>();
  readonly #owner = new Map<number, number>();
  readonly #whole: BroadPhase<2 | 3>;
  readonly #random: Random;
  readonly #world: World;
  #zones: Zones;
  #shards: Shard[];
  #mayThrow = false;

  constructor(world: World, random: Random) {
    this.#world = world;
    this.#random = random;
    this.#whole = this.#space();
    this.#zones = aZones(random, world);
    this.#shards = Array.from({ length: this.#zones.count }, (_, zone) => this.#shard(zone));
  }

  #shard(zone: number, state?: Delta): Shard {
    const entered = () => {
      if (this.#mayThrow && this.#random() < 0.1) throw new Error('not yet');
    };
    return new Shard(this.#zones, zone, this.#space(), { entered, state });
  }

  /** Updates a shard, again and again while `entered` throws. */
  #update(shard: Shard, deltas: readonly Delta[]): void {
    this.#mayThrow = true;
    for (let done = false; !done; ) {
      try {
        shard.update(deltas);
        done = true;
      } catch (error) {
        if ((error as Error).message !== 'not yet') throw error;
        this.counts.thrown++;
      }
    }
    this.#mayThrow = false;
  }

  #space(): BroadPhase<2 | 3> {
    const { dimensions, wraps, size } = this.#world;
    return new BroadPhase({ dimensions, events: true, ...(wraps ? { wrap: Array(dimensions).fill(size) } : {}) });
  }

  #delete(id: number): void {
    this.#shards[this.#owner.get(id)!].delete(id);
    this.#owner.delete(id);
    this.boxes.delete(id);
    this.#whole.delete(id);
  }

  #set(id: number, box: number[]): void {
    const zone = this.#owner.get(id) ?? Math.floor(this.#random() * this.#shards.length);
    if (!this.#owner.has(id) && this.#shards[zone].sees(id)) return; // known there as another's, which is just gone
    this.#owner.set(id, zone);
    this.boxes.set(id, box);
    setBox(this.#whole, id, box);
    this.#shards[zone].set(id, ...box);
  }

  change(): void {
    const { dimensions, margin } = this.#world;
    const random = this.#random;
    for (const [id, box] of [...this.boxes]) {
      const kind = random();
      if (kind < 0.02) this.#delete(id);
      if (kind < 0.01)
        this.#set(id, aBox(random, this.#world)); // another, with the same id
      else if (kind < 0.02) continue;
      else if (kind < 0.05)
        this.#set(id, aBox(random, this.#world)); // it jumps
      else if (kind < 0.5) {
        const by = Array.from({ length: dimensions }, () => Math.round(8 * (random() - 0.5) * (margin + 3)) / 4);
        this.#set(id, shifted(box, by));
      }
    }
    for (let k = 0; k < 3; k++) {
      const id = Math.floor(random() * 60);
      if (!this.boxes.has(id)) this.#set(id, aBox(random, this.#world));
    }
  }

  /** Without an exchange every zone moves what it sees by itself, as motion that all know would. */
  drift(): void {
    const { dimensions, margin, between } = this.#world;
    for (const [id, box] of this.boxes) {
      if (this.#random() < 0.3) continue;
      const by = Array.from({ length: dimensions }, () => ((2 * this.#random() - 1) * margin) / between);
      const moved = shifted(box, by);
      this.boxes.set(id, moved);
      setBox(this.#whole, id, moved);
      for (const shard of this.#shards) if (shard.sees(id)) shard.set(id, ...moved);
    }
    this.#compare([]);
  }

  exchange(): void {
    if (this.#random() < 0.1) {
      this.#zones = aZones(this.#random, this.#world);
      this.counts.borders++;
    }
    const deltas = this.#shards.flatMap((shard) => shard.exchange(this.#zones)).map((delta) => structuredClone(delta));
    this.counts.given += this.#shards.reduce((sum, { given }) => sum + given.length, 0);
    this.#compare(deltas);
    this.#compareHandedOver();
    for (const id of this.boxes.keys()) {
      const owners = this.#shards.filter((shard) => shard.owns(id)).map(({ zone }) => zone);
      expect(owners).toEqual([this.#zones.ownerOf(this.boxes.get(id)!)]);
      this.#owner.set(id, owners[0]);
    }
    if (this.#random() < 0.1) this.#restart(Math.floor(this.#random() * this.#shards.length));
  }

  /** What was given and what was taken is what has another owner now. */
  #compareHandedOver(): void {
    const sorted = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);
    const ownerNow = (id: number) => this.#zones.ownerOf(this.boxes.get(id)!);
    const handedOver = [...this.boxes.keys()].filter((id) => ownerNow(id) !== this.#owner.get(id));
    for (const { zone, given, taken } of this.#shards) {
      expect(sorted(given)).toEqual(sorted(handedOver.filter((id) => this.#owner.get(id) === zone)));
      expect(sorted(taken)).toEqual(sorted(handedOver.filter((id) => ownerNow(id) === zone)));
    }
  }

  #restart(zone: number): void {
    const state = structuredClone(this.#shards[zone].state());
    const { pairs } = this.#shards[zone];
    this.#shards[zone] = this.#shard(zone, state);
    expect(keysOf(this.#shards[zone].pairs).sort()).toEqual(keysOf(pairs).sort());
    this.counts.restarts++;
  }

  #compare(deltas: readonly Delta[]): void {
    this.#whole.update();
    const ordered = this.#random() < 0.5 ? deltas : [...deltas].reverse();
    for (const shard of this.#shards) {
      this.#update(
        shard,
        ordered.filter(({ to }) => to === shard.zone),
      );
    }
    for (const kind of ['pairs', 'began', 'ended'] as const) {
      const union = keysOf(this.#shards.flatMap((shard) => [...shard[kind]])).sort();
      expect(union, kind).toEqual(keysOf(this.#whole[kind]).sort());
      this.counts[kind] += union.length;
    }
  }
}

describe(`a cut world (SEED=${seed})`, () => {
  test.each(Object.entries(worlds))(
    `%s: ${ticks} ticks as one space has them`,
    { tags: 'long', timeout: 1_000_000 },
    (name, world) => {
      const random = createRandom(seed + name.length * 7919);
      const game = new Game(world, random);
      for (let tick = 0; tick < ticks; tick++) {
        game.change();
        try {
          game.exchange();
          for (let k = Math.floor(random() * (world.between + 1)); k > 0; k--) game.drift();
        } catch (error) {
          throw new Error(`SEED=${seed}, ${name}, tick ${tick}: ${(error as Error).message}`, { cause: error });
        }
      }
      for (const [kind, count] of Object.entries(game.counts)) expect(count, kind).toBeGreaterThan(ticks / 100);
    },
  );
});

describe('two zones', () => {
  const zones = new Zones({ borders: { x: [100] } });
  const make = (entered?: (id: number) => void) =>
    [0, 1].map((zone) => new Shard(zones, zone, new BroadPhase({ events: true }), entered ? { entered } : {}));
  const tick = (shards: readonly Shard[]) => {
    const deltas = shards.flatMap((shard) => shard.exchange());
    for (const shard of shards) shard.update(deltas.filter(({ to }) => to === shard.zone));
  };

  test('hand a box over without an event', () => {
    const [left, right] = make() as [Shard, Shard];
    left.set(1, 80, 0, 95, 10).set(2, 90, 0, 99, 10);
    tick([left, right]);
    expect([...left.began]).toEqual([1, 2]);
    left.set(1, 110, 0, 125, 10).set(2, 120, 0, 129, 10);
    tick([left, right]);
    expect([left.given, right.taken]).toEqual([
      [1, 2],
      [1, 2],
    ]);
    expect([...right.pairs]).toEqual([1, 2]);
    for (const shard of [left, right]) expect([...shard.began, ...shard.ended]).toEqual([]);
    right.set(1, 0, 0, 15, 10);
    tick([left, right]);
    expect([[...left.ended], [...right.ended]]).toEqual([[], [1, 2]]);
    expect([...left.ids()]).toEqual([1]);
    expect([...right.ids(true)]).toEqual([2]);
  });

  test('send nothing of what rests, nor of what no other zone sees', () => {
    const [left, right] = make() as [Shard, Shard];
    left.set(1, 90, 0, 110, 10).set(2, 10, 0, 20, 10);
    tick([left, right]);
    left.set(2, 11, 0, 21, 10);
    expect(left.exchange()).toEqual([]);
  });

  test('go on when one is lost and comes back empty', () => {
    let [left, right] = make() as [Shard, Shard];
    left.set(1, 90, 0, 110, 10).set(3, 10, 0, 20, 10);
    right.set(2, 105, 0, 120, 10).set(4, 100, 0, 107, 10);
    tick([left, right]);
    expect([...right.pairs].length).toBe(6);
    // The left one dies: what it owned ends its pairs.
    right.forget(0);
    right.update();
    expect(keysOf([...right.ended])).toEqual(keysOf([1, 2, 1, 4]));
    // It comes back with its boxes, as new ones, and is told what it must see.
    left = new Shard(zones, 0, new BroadPhase({ events: true }));
    right.set(2, 90, 0, 130, 10); // it now reaches over, and is handed over
    right.resend(0);
    left.set(1, 90, 0, 110, 10).set(3, 10, 0, 20, 10);
    tick([left, right]);
    expect([[...left.began], keysOf([...right.began])]).toEqual([[1, 2], keysOf([1, 4])]);
    expect(left.taken).toEqual([2]);
    expect(right.space.size).toBe(3);
    // Should the right one die without a word, its restarted self knows of what is sent again that nothing began.
    right = new Shard(zones, 1, new BroadPhase({ events: true }), { state: right.state() });
    left.resend(1);
    tick([left, right]);
    expect([...left.began, ...right.began, ...left.ended, ...right.ended]).toEqual([]);
    expect(keysOf([...right.pairs]).length).toBe(2);
  });

  test('tell of a box that was deleted between two exchanges', () => {
    const [left, right] = make() as [Shard, Shard];
    left.set(1, 90, 0, 110, 10);
    tick([left, right]);
    left.delete(1);
    left.update();
    expect(() => left.state()).toThrow(/box 1 has changed/);
    expect(left.exchange().map(({ ids, changes }) => [...ids, ...changes])).toEqual([[1, 16]]);
  });

  test('know whose a ghost is when the border alone has moved', () => {
    const cut = (x: number[]) => new Zones({ borders: { x } });
    const before = cut([100, 200]);
    const after = cut([85, 200]);
    const shards = [0, 1, 2].map((zone) => new Shard(before, zone, new BroadPhase({ events: true })));
    const exchange = (to: Zones) => {
      const deltas = shards.flatMap((shard) => shard.exchange(to));
      for (const shard of shards) shard.update(deltas.filter((delta) => delta.to === shard.zone));
      return deltas.map((delta) => `${delta.from} to ${delta.to}: ${delta.ids}`);
    };
    shards[0]!.set(1, 90, 0, 210, 10).set(2, 80, 0, 120, 10);
    exchange(before);
    // One is handed over, which the last zone is told; of the other nothing is new.
    expect(exchange(after)).toEqual(['0 to 1: 1', '0 to 2: 1']);
    shards[2]!.forget(0);
    expect(shards[2]!.sees(1)).toBe(true);
    shards[2]!.forget(1);
    expect(shards[2]!.sees(1)).toBe(false);
  });

  test('keep no state in which a ghost has moved by itself', () => {
    const [left, right] = make() as [Shard, Shard];
    left.set(1, 90, 0, 110, 10);
    tick([left, right]);
    right.set(1, 91, 0, 111, 10).update();
    expect(() => right.state()).toThrow(/box 1 has changed, expected an exchange/);
    left.set(1, 91, 0, 111, 10);
    tick([left, right]);
    expect([...right.state().ids]).toEqual([1]);
    expect(() => new Shard(zones, 0, new BroadPhase({ events: true }), { state: right.state() })).toThrow(
      'state.to: got 1, expected 0, this zone',
    );
  });

  test('filters hold for ghosts, also where they come in', () => {
    const spaces: BroadPhase[] = [];
    const shards = [0, 1].map((zone) => {
      const space = new BroadPhase({ events: true });
      spaces.push(space);
      const entered = (id: number) => void space.setFilter(id, id < 10 ? 1 : 2, id < 10 ? 2 : 1);
      return new Shard(zones, zone, space, { entered });
    });
    shards[0].set(1, 90, 0, 110, 10).set(2, 95, 0, 115, 10).set(10, 80, 0, 120, 10);
    tick(shards);
    expect(keysOf(shards.flatMap(({ pairs }) => [...pairs]))).toEqual(keysOf([1, 10, 2, 10]));
    shards[0].set(1, 101, 0, 111, 10).set(10, 102, 0, 120, 10);
    tick(shards);
    expect(keysOf(shards.flatMap(({ pairs }) => [...pairs]))).toEqual(keysOf([1, 10, 2, 10]));
    expect(shards.flatMap(({ began, ended }) => [...began, ...ended])).toEqual([]);
  });

  test('call `entered` once for each box that comes', () => {
    const calls: string[] = [];
    const shards = [0, 1].map((zone) => {
      const entered = (id: number) => void calls.push(`${id} in ${zone}`);
      return new Shard(zones, zone, new BroadPhase({ events: true }), { entered });
    });
    const move = (x: number) => {
      shards[0]!.set(1, x, 0, x + 10, 10);
      tick(shards);
      return calls.splice(0);
    };
    expect(move(80)).toEqual(['1 in 0']);
    expect(move(81)).toEqual([]);
    expect(move(95)).toEqual(['1 in 1']); // where it was, and where it is
    expect(move(96)).toEqual([]);
    expect(move(80)).toEqual([]);
    expect(move(97)).toEqual(['1 in 1']);
  });

  test('keep no box for which `entered` threw, and which is deleted then', () => {
    const [left, right] = make((id) => {
      if (id === 1) throw new Error('not this one');
    }) as [Shard, Shard];
    expect(() => left.set(1, 90, 0, 99, 10).update()).toThrow('not this one');
    left.set(2, 91, 0, 99, 10).delete(1);
    tick([left, right]);
    expect([[...left.space.keys()], [...left.pairs]]).toEqual([[2], []]);
  });

  test('keep a box whose id another zone has deleted in the same tick, when `entered` throws', () => {
    let mayThrow = false;
    const entered = () => {
      if (mayThrow) throw new Error('not yet');
    };
    const cut = new Zones({ borders: { x: [100, 200] } });
    const shards = [0, 1, 2].map((zone) => new Shard(cut, zone, new BroadPhase({ events: true }), { entered }));
    shards[0]!.set(1, 90, 0, 110, 10);
    tick(shards);
    shards[0]!.delete(1);
    shards[2]!.set(1, 150, 0, 250, 10).set(2, 160, 0, 250, 10);
    const deltas = [2, 0].flatMap((zone) => shards[zone]!.exchange()).filter(({ to }) => to === 1);
    mayThrow = true;
    expect(() => shards[1]!.update(deltas)).toThrow('not yet');
    mayThrow = false;
    expect([...shards[1]!.update(deltas).ids()].sort()).toEqual([1, 2]);
  });

  test('refuse calls by `entered`, and a space with boxes', () => {
    const [left] = make(() => void left!.delete(1));
    expect(() => left!.set(1, 0, 0, 9, 9).update()).toThrow('delete: called by entered, expected only after update');
    expect([left!.delete(1), left!.delete(1)]).toEqual([true, false]);
    const space = new BroadPhase({ events: true }).set(1, 0, 0, 9, 9);
    expect(() => new Shard(zones, 0, space)).toThrow('space.size: got 1, expected an empty space');
  });

  test('tell where a box was only if it comes into sight', () => {
    const [left, right] = make() as [Shard, Shard];
    left.set(1, 80, 0, 90, 10);
    tick([left, right]);
    const told = (x: number) => {
      const deltas = left.set(1, x, 0, x + 10, 10).exchange();
      for (const shard of [left, right]) shard.update(deltas.filter(({ to }) => to === shard.zone));
      return deltas.map(({ changes, boxes }) => [[...changes], [...boxes]]);
    };
    expect(told(95)).toEqual([[[1], [95, 0, 105, 10, 80, 0, 90, 10]]]);
    expect(told(96)).toEqual([[[0], [96, 0, 106, 10]]]);
    expect(told(81)).toEqual([[[0], [81, 0, 91, 10]]]); // the last time
  });

  test('say what is wrong, and are as before', () => {
    const [left, right] = make() as [Shard, Shard];
    left.set(1, 90, 0, 110, 10);
    const [delta] = left.exchange();
    const wrong = (part: object, message: RegExp) => {
      expect(() => right.update([{ ...delta, ...part } as Delta])).toThrow(message);
      expect([right.space.size, [...right.ids()]]).toEqual([0, []]);
    };
    wrong({ to: 0 }, /^update: delta.to: got 0, expected 1/);
    wrong({ changes: new Uint8Array(2) }, /^update: delta.changes.length: got 2, expected 1/);
    wrong({ boxes: new Float64Array(3) }, /maxX|delta.boxes/);
    wrong({ boxes: new Float64Array(5) }, /^update: delta.boxes.length: got 5, expected 4/);
    wrong({ boxes: Float64Array.of(0, Number.NaN, 1, 1) }, /minY of box 1 is NaN/);
    wrong({ ids: Uint32Array.of(2 ** 24) }, /^update: delta.boxes: the id is 16777216/);
    wrong({ changes: Uint8Array.of(7) }, /^update: delta.changes\[0\]: got 7, expected 0, 1 or 16/);
    right.update([delta]);
    expect(right.space.size).toBe(1);
    expect(() => right.delete(1)).toThrow('delete: got 1, expected a box of zone 1, not of zone 0');
    expect(() => right.set(2, 0, 0, -1, 0)).toThrow('box 2 has minX 0 above maxX -1');
    expect(() => right.set(-1, 0, 0, 1, 1)).toThrow('the id is -1');
    expect(() => right.set(2, 0, 0, 1)).toThrow('got 4 arguments');
    expect(() => right.exchange(new Zones({ borders: { x: [1, 2] } }))).toThrow('zones.count: got 3, expected 2');
    expect(() => right.forget(1)).toThrow('forget: got 1, expected another zone');
    expect(() => right.resend(1)).toThrow('resend: got 1, expected another zone');
    expect(() => right.set(2, 0, 0, '1' as never, 1)).toThrow('maxX of box 2 is "1", expected a number');
    expect(() => new Shard(zones, 0, new BroadPhase())).toThrow(/events/);
    expect(() => new Shard(zones, 0, new BroadPhase({ dimensions: 3, events: true }))).toThrow(
      'space.dimensions: got 3',
    );
  });
});

describe('zones', () => {
  test.each([
    [{ borders: { x: [1, 0] } }, 'borders.x: got [1, 0], expected ascending numbers'],
    [{ borders: { x: [Number.NaN] } }, 'borders.x: got [NaN]'],
    [{ borders: { x: [11] }, wrap: [10, 10] }, 'borders.x: got [11], expected ascending numbers from 0 to 10'],
    [{ borders: { z: [1] } }, 'borders: got "z", expected borders along x, y in 2D'],
    [{ borders: {}, margin: -1 }, 'margin: got -1'],
    [{ borders: {}, wrap: [1] }, 'wrap: got [1], expected 2 numbers'],
    [{ borders: {}, dimensions: 4 }, 'dimensions: got 4'],
    [{}, 'borders: got undefined'],
  ])('refuses %j', (options, message) => {
    expect(() => new Zones(options as never)).toThrow(message);
  });

  test('a box at a border belongs to the zone above, one that ends there is seen by both', () => {
    const zones = new Zones({ borders: { x: [100] } });
    expect([zones.ownerOf([100, 0, 110, 1]), zones.ownerOf([99, 0, 100, 1])]).toEqual([1, 0]);
    expect(zones.seenBy([90, 0, 100, 1])).toEqual([0, 1]);
  });

  test('a box that crosses the end of a wrapped world is seen on the other side', () => {
    const zones = new Zones({ borders: { x: [40, 70] }, wrap: [100, 100] });
    expect(zones.seenBy([95, 0, 105, 1])).toEqual([2, 0]);
    expect(zones.seenBy([-10, 0, 150, 1]).sort()).toEqual([0, 1, 2]);
    expect(zones.ownerOf([-10, 0, 0, 1])).toBe(2);
  });
});

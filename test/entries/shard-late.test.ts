// Zones that do not wait for each other: each is sent what the others say in the order in which they say it, but hears
// it late, and then several messages of one zone at once. When all is quiet, all zones together have what one space has.
import { BroadPhase } from 'broadphase';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import { expect, test } from 'vitest';
import { createRandom, type Random } from '../../src/scenes/random.ts';
import { keysOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';

const size = 400;
const make = (zones: Zones, wrap?: number[]) =>
  Array.from({ length: zones.count }, (_, zone) => new Shard(zones, zone, new BroadPhase({ events: true, wrap })));

test('a box that is new and gone again in what one zone says is gone', () => {
  const [left, right] = make(new Zones({ borders: { x: [100] } })) as [Shard, Shard];
  const added = left.set(1, 90, 0, 110, 10).exchange();
  left.update().delete(1);
  const deleted = left.exchange();
  left.update();
  right.update([...added, ...deleted]);
  expect([...right.ids(), right.space.size]).toEqual([0]);
  expect([...right.began, ...right.ended]).toEqual([]);
});

test('a box that its new owner deletes is gone, though the hand-over is heard of in the same update', () => {
  const shards = make(new Zones({ borders: { x: [100, 200] } }));
  const [left, middle, right] = shards as [Shard, Shard, Shard];
  const to = ({ zone }: Shard, deltas: Delta[]) => deltas.filter((delta) => delta.to === zone);
  const handedOver = left.set(1, 120, 0, 250, 10).exchange();
  left.update();
  middle.update(to(middle, handedOver)).delete(1);
  right.update([...to(right, handedOver), ...to(right, middle.exchange())]);
  expect([...right.ids(), right.space.size]).toEqual([0]);
});

/** Zones, what they said in that order, and how much of it each has heard. */
class Game {
  readonly boxes = new Map<number, number[]>();
  readonly #random: Random;
  readonly #wrap: number[] | undefined;
  readonly #zones: Zones;
  readonly #shards: Shard[];
  readonly #said: Delta[] = [];
  readonly #heard: number[];
  #next = 0;

  constructor(random: Random) {
    this.#random = random;
    this.#wrap = random() < 0.3 ? [size, size] : undefined;
    this.#zones = new Zones({ borders: { x: [100, 200, 300] }, wrap: this.#wrap });
    this.#shards = make(this.#zones, this.#wrap);
    this.#heard = this.#shards.map(() => 0);
  }

  #set(shard: Shard, id: number, from: number, width: number): void {
    this.boxes.set(id, [from, 0, from + width, 10]);
    shard.set(id, from, 0, from + width, 10);
  }

  #change(shard: Shard): void {
    const width = this.#random() * (this.#random() < 0.2 ? 250 : 20);
    for (const id of [...shard.ids(true)]) {
      const kind = this.#random();
      const [from, , to] = this.boxes.get(id) as [number, number, number];
      if (kind < 0.05) {
        this.boxes.delete(id);
        shard.delete(id);
      } else if (kind < 0.15) this.#set(shard, id, this.#random() * size, width);
      else if (kind < 0.5) this.#set(shard, id, from + 60 * (this.#random() - 0.5), to - from);
    }
    if (this.#random() < 0.5) this.#set(shard, this.#next++, this.#random() * size, width);
  }

  /** One zone takes its turn. It hears some of what it has not heard yet. */
  turn(): void {
    const zone = Math.floor(this.#random() * this.#shards.length);
    this.#change(this.#shards[zone]!);
    this.#exchange(zone, this.#random());
  }

  #exchange(zone: number, share: number): void {
    const shard = this.#shards[zone]!;
    this.#said.push(...structuredClone(shard.exchange()));
    const from = this.#heard[zone]!;
    this.#heard[zone] = from + Math.round(share * (this.#said.length - from));
    shard.update(this.#said.slice(from, this.#heard[zone]).filter(({ to }) => to === zone));
  }

  end(): void {
    for (let round = 0; round < 2; round++) for (const { zone } of this.#shards) this.#exchange(zone, 1);
    const whole = new BroadPhase({ wrap: this.#wrap });
    for (const [id, [a, b, c, d]] of this.boxes) whole.set(id, a!, b!, c!, d!);
    const all = keysOf(whole.update().pairs);
    expect(keysOf(this.#shards.flatMap(({ pairs }) => [...pairs])).sort()).toEqual(all.sort());
    for (const shard of this.#shards) {
      const of = (has: (box: number[]) => boolean) => [...this.boxes].flatMap(([id, box]) => (has(box) ? id : []));
      expect([...shard.ids(true)].sort()).toEqual(of((box) => this.#zones.ownerOf(box) === shard.zone).sort());
      expect([...shard.ids()].sort()).toEqual(of((box) => this.#zones.seenBy(box).includes(shard.zone)).sort());
      for (const id of shard.ids()) expect([...shard.space.get(id)!]).toEqual(this.boxes.get(id));
    }
  }
}

test(`zones that do not wait have all that one space has, when it is quiet (SEED=${seed})`, () => {
  for (let run = 0; run < runs(80); run++) {
    const game = new Game(createRandom(seed + run));
    for (let turn = 0; turn < 200; turn++) game.turn();
    game.end();
  }
});

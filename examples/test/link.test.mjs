// Three zones in one process, over a wire that loses and delays messages: at every tick that all of them reach, no
// entity is missing or there twice. It needs neither Colyseus nor Redis.
import { createServer } from 'node:http';
import { afterEach, expect, test, vi } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { seed } from '../../test/support/runs.ts';
import { Link } from '../apart/world-colyseus/link.mjs';
import { Simulation } from '../apart/world-colyseus/simulation.mjs';
import { beginnings, cutInto, zoneOf } from '../apart/world-colyseus/world.mjs';

const count = 3;
const entities = 6000;
const zones = cutInto(count);
/** Milliseconds. The tests run in real time: a zone is silent for five seconds before it is left out. */
const limit = 120_000;
const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
let world;

class World {
  log = [];
  links = [];
  servers = [];
  /** Zones that had to be recreated. */
  lost = [];
  /**
   * The newest tick that all zones reached, and the ticks in which an entity was missing or there twice, or to which a
   * zone went back.
   */
  whole = -1;
  wrong = [];
  /** For each message: `lost`, `held`, the milliseconds of its delay, or nothing. */
  fate = () => undefined;
  #held = [];
  #listeners = new Map();
  #ticks = new Map();
  #newest = [-1, -1, -1];
  #watchers = [];
  /** A zone that begins with all entities, as if it had had them once. */
  stale;
  /** By zone, what it begins with if it is created again. */
  snapshots = [];
  /** By zone, takes its snapshot. */
  keepers = [];

  presence = {
    subscribe: (topic, hear) => this.#listeners.set(topic, [...(this.#listeners.get(topic) ?? []), hear]),
    unsubscribe: (topic) => this.#listeners.delete(topic),
    publish: (topic, message) => {
      const fate = this.fate(topic, message);
      if (fate === 'lost') return;
      const deliver = () => {
        for (const hear of this.#listeners.get(topic) ?? []) hear(structuredClone(message));
      };
      if (fate === 'held') this.#held.push(deliver);
      else if (fate > 0) setTimeout(deliver, fate);
      else setImmediate(deliver);
    },
    hincrbyex: () => 1,
  };

  deliver() {
    this.fate = () => undefined;
    for (const deliver of this.#held.splice(0)) deliver();
  }

  /** Creates all zones, and starts some of them. */
  async start(first = [0, 1, 2]) {
    for (let zone = 0; zone < count; zone++) await this.create(zone);
    for (const zone of first) this.links[zone].start();
    if (first.length === count) await this.until(() => this.whole > 0);
    else await this.until(() => first.every((zone) => this.links[zone].tick > 2 * first.length));
  }

  /** Creates a zone in a process of its own, also in place of one that died. */
  async create(zone) {
    const server = createServer((_, response) => response.end(server.processId));
    server.processId = `process ${zone}`;
    await new Promise((resolve) => server.listen(0, resolve));
    this.servers.push(server);
    this.links[zone] = this.#link(zone, `localhost:${server.address().port}`);
  }

  /** A zone's process dies, and another one answers at its address. */
  async kill(zone) {
    this.fate = (topic, { from }) => (topic === `zone:${zone}` || from === zone ? 'lost' : undefined);
    await this.links[zone].stop();
    this.servers[zone].processId = 'one in its place';
  }

  /** Creates a zone that has died again. */
  async revive(zone) {
    await this.until(() => this.lost.includes(zone));
    await this.create(zone);
    this.fate = () => undefined;
    this.links[zone].start();
  }

  #link(zone, address) {
    const simulation = new Simulation(zones, zone);
    const mine = () =>
      [...beginnings(entities)].filter((entity) => zone === this.stale || zoneOf(zones, entity) === zone);
    const link = new Link({
      presence: this.presence,
      isConnected: () => true,
      simulation,
      info: { roomId: `room ${zone}`, processId: `process ${zone}`, address },
      calls: {
        begin: () =>
          link.tick > 0
            ? { tick: link.tick - 1, entities: simulation.everybody(), isLive: true }
            : (this.snapshots[zone]?.() ?? { tick: -1, entities: mine() }),
        ticked: () => this.#ticked(zone, link.tick, [...simulation.entities.keys()]),
        restarted: () => {},
        lost: (other) => this.lost.push(other),
        replaced: () => {},
        log: (text) => {
          this.log.push(`zone ${zone}: ${text}`);
          this.#look();
        },
      },
    });
    this.keepers[zone] = () => {
      const kept = structuredClone({ tick: link.tick, entities: simulation.everybody() });
      this.snapshots[zone] = () => structuredClone(kept);
    };
    return link;
  }

  #ticked(zone, tick, ids) {
    if (tick <= this.#newest[zone]) this.wrong.push(`zone ${zone} went from tick ${this.#newest[zone]} to ${tick}`);
    this.#newest[zone] = tick;
    const all = [...(this.#ticks.get(tick) ?? []), ids];
    this.#ticks.set(tick, all);
    // Zones that do not know each other run on their own, at ticks with the same numbers.
    const together = this.links.every((link, zone) =>
      this.links.every((_, other) => other === zone || link.isOpen(other)),
    );
    if (all.length === count && together) {
      this.whole = tick;
      const once = new Set(all.flat());
      if (once.size !== entities || all.flat().length !== entities)
        this.wrong.push([tick, all.flat().length, once.size]);
    }
    this.#look();
  }

  #look() {
    this.#watchers = this.#watchers.filter(({ holds, resolve }) => !holds() || resolve());
  }

  until(holds) {
    return new Promise((resolve) => {
      this.#watchers.push({ holds, resolve });
      this.#look();
    });
  }

  said = (text) => this.log.some((line) => line.includes(text));

  async end() {
    for (const link of this.links) await link.stop();
    for (const server of this.servers) server.close();
  }
}

afterEach(() => world.end());

test(
  `messages that get lost are asked for (SEED=${seed})`,
  async () => {
    world = new World();
    await world.start();
    const random = createRandom(seed);
    let lost = 0;
    world.fate = (_, { type }) => (type === 'tick' && random() < 0.1 && lost++ >= 0 ? 'lost' : undefined);
    const { whole } = world;
    await world.until(() => lost >= 10 && world.whole > whole + 20);
    expect([world.wrong, world.said('without it')]).toEqual([[], false]);
  },
  limit,
);

test(
  'a zone has died whose address another process answers at: it is made anew',
  async () => {
    world = new World();
    await world.start();
    await world.kill(1);
    await world.until(() => world.lost.length > 0);
    expect(world.lost).toEqual([1]);
    expect(world.said('zone 0: zone 1 cannot be reached (localhost:')).toBe(true);
  },
  limit,
);

test(
  'a zone that joins again does not recreate one that has died before and is back',
  async () => {
    world = new World();
    await world.start();
    await world.kill(1);
    await world.until(() => world.said('zone 2: zone 1 cannot be reached') && world.lost.length > 0);
    await world.create(1);
    world.fate = () => undefined;
    world.links[1].start();
    await world.until(() => world.said('zone 2: zone 1 is here'));
    // Zone 2 learns that it is left out, and knows no other zone until it is welcome. All stand still for longer than it
    // waits between two attempts to bring a zone back.
    world.fate = (topic, { type }) => (topic === 'zone:2' && type === 'welcome' ? 'lost' : undefined);
    world.presence.publish('zone:2', { type: 'late', from: 0 });
    await sleep(100);
    for (const until = performance.now() + 4200; performance.now() < until; );
    await sleep(100);
    world.fate = () => undefined;
    await world.until(() => world.log.filter((line) => line.startsWith('zone 2: begins')).length > 1);
    expect(world.lost).toEqual([1]);
  },
  limit,
);

test(
  'a zone that is silent is left out, and loses nobody when it is back',
  async () => {
    world = new World();
    await world.start();
    const before = world.whole;
    await world.until(() => world.whole > before + 20);
    world.fate = (topic, { from }) => (topic === 'zone:1' || topic === 'zones' || from === 1 ? 'held' : undefined);
    await world.until(
      () => world.said('zone 0: zone 1 has said nothing for') && world.said('zone 2: zone 1 has said nothing'),
    );
    const { whole } = world;
    world.deliver();
    await world.until(() => world.whole > whole + 20);
    expect(world.wrong).toEqual([]);
  },
  limit,
);

test(
  'a zone that has gone on alone, and further than the others, goes back to no tick that it was at',
  async () => {
    world = new World();
    await world.start();
    // The others take four times as long per tick, and all messages to and from zone 1 are held back.
    world.fate = (topic, { from, type }) => {
      if (type === 'hello') return 'lost';
      return topic === 'zone:1' || from === 1 ? 'held' : type === 'tick' ? 200 : undefined;
    };
    const [first, silent, last] = world.links;
    const isAlone = () => ![first, last].some((link) => link.isOpen(1)) && !silent.isOpen(0) && !silent.isOpen(2);
    await world.until(() => isAlone() && silent.tick > first.tick + 20);
    const { whole } = world;
    const { tick } = silent;
    world.deliver();
    world.fate = (_, { from, type }) => (type === 'hello' && from > 0 ? 'lost' : undefined);
    await world.until(() => world.whole > Math.max(whole, tick) + 20);
    expect(world.wrong).toEqual([]);
  },
  limit,
);

test(
  'zones that are slow to get where another begins are not left out by it',
  async () => {
    world = new World();
    await world.start([0, 1]);
    // Each of their ticks takes a second, and it takes more than five until they reach the third zone's first tick.
    world.fate = (_, { type }) => (type === 'tick' ? 1000 : undefined);
    world.links[2].start();
    await world.until(() => world.links[2].tick > 0);
    const begun = world.links[2].tick;
    await world.until(() => world.links[2].tick > begun);
    world.fate = () => undefined;
    await world.until(() => world.whole > begun + 20);
    expect([world.wrong, world.log.filter((line) => line.includes('without it'))]).toEqual([[], []]);
  },
  limit,
);

test(
  'a zone begins when all that run have said whom they own, however long that takes one',
  async () => {
    world = new World();
    await world.start([0, 1]);
    world.fate = (topic, { from, type }) =>
      type === 'hello' ? 'lost' : from === 1 && topic === 'zone:2' ? 1500 : undefined;
    world.links[2].start();
    await world.until(() => world.said('zone 2: begins'));
    world.fate = () => undefined;
    await world.until(() => world.whole > 0);
    expect(world.log.filter((line) => line.includes('zone 2: begins'))).toEqual([
      expect.stringMatching(/beside 2 zones$/),
    ]);
    expect(world.wrong).toEqual([]);
  },
  limit,
);

test(
  'of two zones that die together, the one that is back first brings back the other',
  async () => {
    world = new World();
    await world.start();
    await Promise.all([world.kill(0), world.kill(1)]);
    await world.until(() => world.lost.length > 0);
    const [back] = world.lost;
    await world.create(back);
    world.fate = () => undefined;
    world.links[back].start();
    await world.until(() => world.lost.includes(1 - back));
    expect(world.said(`zone 2: zone ${back} is made anew`)).toBe(true);
  },
  limit,
);

test(
  'two zones that die one soon after the other lose nobody who went from one to the other',
  async () => {
    world = new World();
    await world.start();
    await world.until(() => world.whole > 5);
    for (const keep of world.keepers) keep();
    const { whole } = world;
    await world.until(() => world.whole > whole + 15);
    await world.kill(0);
    await world.revive(0);
    await world.until(() => world.log.filter((line) => line.startsWith('zone 0: begins')).length > 1);
    // What came from zone 0 is in no snapshot of zone 1, and zone 0 has left it to zone 1.
    await world.kill(1);
    await world.revive(1);
    const { whole: then } = world;
    await world.until(() => world.whole > then + 20);
    expect(world.wrong).toEqual([]);
  },
  limit,
);

test(
  'a zone that has been away takes no entity that is on its way from one zone to another',
  async () => {
    world = new World();
    world.stale = 2;
    await world.start([0, 1]);
    let isOnItsWay = false;
    world.fate = (topic, { type, from, entities }) => {
      if (type !== 'tick' || topic !== 'zone:1' || from !== 0) return undefined;
      isOnItsWay ||= entities !== '';
      return isOnItsWay ? 'held' : undefined;
    };
    await world.until(() => isOnItsWay);
    world.links[2].start();
    await world.until(() => world.said('zone 2: begins'));
    world.deliver();
    await world.until(() => world.whole > 0);
    expect(world.wrong).toEqual([]);
  },
  limit,
);

test('a zone that has yielded to another asks again, also if it wakes at the very time', async () => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout', 'performance'] });
  const said = [];
  let hear;
  const link = new Link({
    presence: {
      subscribe: async (_, listener) => {
        hear = listener;
      },
      unsubscribe: async () => {},
      publish: async (_, { type }) => said.push(type),
    },
    isConnected: () => true,
    simulation: new Simulation(zones, 1),
    info: { roomId: 'room 1', processId: 'process 1', address: 'localhost:1' },
    calls: {
      begin: () => ({ tick: -1, entities: [], peers: [] }),
      ticked: () => {},
      restarted: () => said.push('begins'),
      log: () => {},
    },
  });
  world = { end: () => link.stop() };
  try {
    link.start();
    await vi.advanceTimersByTimeAsync(100);
    hear({ type: 'join', from: 0, epoch: 7, since: -1, info: {} });
    await vi.advanceTimersByTimeAsync(1000);
    expect(said.slice(0, 5)).toEqual(['join', 'absent', 'join', 'hello', 'begins']);
    await link.stop();
  } finally {
    vi.useRealTimers();
  }
});

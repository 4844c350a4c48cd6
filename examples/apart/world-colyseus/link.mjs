// How zones stay in lockstep: in each tick a zone sends every other zone what has changed for it, and waits for the
// same from them. So at any tick, all zones together are in the state of a single process. Messages go over the
// presence of Colyseus.
//
// A zone that starts or restarts joins the others. It asks all of them; each answers with its tick and the entities it
// owns. Then it names the tick from which on it takes part. If a zone is silent, the others check whether its process
// is alive. If it is not, they continue, and another process recreates its room. If it is, they wait, but not for
// ever. A slow zone answers that it has not reached the tick yet; one that has left out the zone that asks says so.
// Entities turn back at the border of a zone that is missing.
import { pack, packDelta, packEntities, unpack, unpackDelta, unpackEntities } from './wire.mjs';
import { tickTime } from './world.mjs';

const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Milliseconds of silence after which a zone checks whether another one's process is alive; then again. */
const suspicious = 200;
/** Milliseconds of silence after which a zone is left out, though its process is alive. */
const patience = 5000;
/** Milliseconds that the answer to this check may take. After that, a process that accepted it counts as alive. */
const answerTime = 500;
/** Milliseconds between two attempts to bring a zone back. */
const retryTime = 4000;
/** How long a joining zone that knows no other waits for answers, and how many ticks ahead it begins. */
const gathering = 300;
const ahead = 6;
/** Ticks between two heartbeats. */
const helloEvery = 10;

export class Link {
  tick = 0;
  running = false;
  /** What it sent to the others: messages, their bytes, and the records of boxes in them. */
  sent = { messages: 0, bytes: 0, records: 0 };
  /** Milliseconds of work in the last tick, without waiting. */
  work = 0;
  #presence;
  #isConnected;
  #simulation;
  #info;
  #calls;
  #epoch = 0;
  /** Zones that take part, with what they sent for each tick; and zones that will from a later tick on. */
  #peers = new Map();
  #coming = new Map();
  /** Zones that are left out until they join again, each with its info from then. */
  #lost = new Map();
  /** When each zone last said that it runs, with its info; and when it last asked to join. */
  #ran = new Map();
  #asked = new Map();
  /** While it joins: the answers of running zones, and the zones that it does not wait for. */
  #welcomes = new Map();
  #absent = new Set();
  #yieldUntil = 0;
  #wake = () => {};
  /** The messages sent to each zone in this tick and the last one. */
  #last = [];
  #stopped = false;

  /**
   * @param info what other zones have to know about this one: its room and its process
   * @param calls `begin()` returns { tick, entities, isLive, peers } to begin with; `ticked(given)` after each tick;
   *   `restarted()`; `lost(zone, info)` if a zone has to be recreated; `replaced()` if this one was; `log(text,
   *   event)`, where `event` has the same for programs, if there is anything to wait for
   */
  constructor({ presence, isConnected, simulation, info, calls }) {
    this.#presence = presence;
    this.#isConnected = isConnected;
    this.#simulation = simulation;
    this.#info = info;
    this.#calls = calls;
  }

  get #zone() {
    return this.#simulation.zone;
  }

  isOpen = (zone) => this.#peers.has(zone);

  /** What is known about the room of another zone. */
  infoOf(zone) {
    return this.#peers.get(zone)?.info;
  }

  /** The zones that take part, this one included, each with its room. */
  together() {
    return [[this.#zone, this.#info], ...[...this.#peers].map(([zone, { info }]) => [zone, info])];
  }

  /** Joins the others, and runs until it is stopped. */
  async start() {
    try {
      await this.#presence.subscribe(`zone:${this.#zone}`, (message) => this.#hear(message));
      await this.#presence.subscribe('zones', (message) => this.#hear(message));
      await this.#run();
    } catch (error) {
      this.#calls.log(`stopped: ${error.stack}`);
      process.exit(1);
    }
  }

  async stop() {
    this.#stopped = true;
    await this.#presence.unsubscribe(`zone:${this.#zone}`);
  }

  #send(zone, message) {
    const full = { ...message, from: this.#zone, epoch: message.epoch ?? this.#epoch };
    this.sent.messages++;
    Promise.resolve(this.#presence.publish(zone === undefined ? 'zones' : `zone:${zone}`, full)).catch((error) =>
      this.#calls.log(`cannot tell ${zone === undefined ? 'the zones' : `zone ${zone}`}: ${error.message}`),
    );
    return full;
  }

  async #run() {
    let next = performance.now();
    while (!this.#stopped) {
      if (!this.running) {
        await this.#join();
        next = performance.now();
        if (this.#stopped) return;
      }
      await sleep(Math.max(0, next - performance.now()));
      next = Math.max(next + tickTime, performance.now() - tickTime);
      const begun = performance.now();
      const given = this.#tell();
      const told = performance.now();
      await this.#everyone();
      if (!this.running || this.#stopped) continue;
      const resumed = performance.now();
      const messages = [...this.#peers.values()].map(({ inbox }) => inbox.get(this.tick));
      const deltas = messages.flatMap(({ delta }) => (delta ? unpackDelta(delta) : []));
      this.#simulation.finish(
        deltas,
        messages.flatMap(({ entities }) => unpackEntities(entities)),
      );
      for (const { inbox } of this.#peers.values()) inbox.delete(this.tick);
      this.#calls.ticked(given);
      this.work = told - begun + performance.now() - resumed;
      this.tick++;
      if (this.tick % helloEvery === 0) this.#sayHello();
    }
  }

  /** Moves all entities, and sends the changes to the other zones. */
  #tell() {
    for (const [zone, peer] of this.#coming) {
      if (peer.start > this.tick) continue;
      this.#coming.delete(zone);
      this.#peers.set(zone, Object.assign(peer, { heard: performance.now() }));
      this.#simulation.shard.resend(zone);
      this.#calls.log(`zone ${zone} is here from tick ${this.tick} on`);
    }
    const { deltas, given } = this.#simulation.step(this.tick, this.isOpen);
    const told = [...this.#peers.keys()].map((zone) => {
      const delta = deltas.find(({ to }) => to === zone);
      const entities = given.filter(({ to }) => to === zone).map(({ entity }) => entity);
      const message = {
        type: 'tick',
        tick: this.tick,
        delta: delta ? packDelta(delta) : null,
        entities: packEntities(entities),
      };
      this.sent.bytes += JSON.stringify(message).length;
      this.sent.records += delta?.ids.length ?? 0;
      return [zone, this.#send(zone, message)];
    });
    // No zone can be more than a tick behind.
    this.#last = [...this.#last.filter(([, { tick }]) => tick === this.tick - 1), ...told];
    return given;
  }

  /** Waits until all other zones have sent this tick; leaves out those that do not. */
  async #everyone() {
    let since = performance.now();
    let asked = since;
    while (this.running && !this.#stopped) {
      const missing = [...this.#peers].filter(([, { inbox }]) => !inbox.has(this.tick)).map(([zone]) => zone);
      if (missing.length === 0) return;
      await new Promise((resolve) => {
        const timer = setTimeout(resolve, 20);
        this.#wake = () => {
          clearTimeout(timer);
          resolve();
        };
      });
      if (!this.#isConnected()) {
        // The connection is down, not a zone: the world waits.
        since = asked = performance.now();
      } else if (performance.now() - asked > suspicious) {
        for (const zone of missing) {
          this.#send(zone, { type: 'again', tick: this.tick }); // it may have got lost when Redis stopped
          const heard = Math.max(since, this.#peers.get(zone)?.heard ?? 0);
          await this.#suspect(zone, performance.now() - heard);
        }
        asked = performance.now();
      }
    }
  }

  /** Leaves out a zone that has died, or has been silent for too long. */
  async #suspect(zone, silent) {
    const { info, epoch } = this.#peers.get(zone) ?? {};
    if (!info) return;
    const there = await isThere(info);
    if (this.#peers.get(zone)?.info !== info || (there && silent < patience)) return;
    const why = there ? `has said nothing for ${patience} ms` : 'cannot be reached';
    this.#calls.log(`zone ${zone} ${why} (${info.address}): going on without it`);
    this.#drop(zone);
    this.#asked.delete(zone);
    this.#lost.set(zone, info);
    if (there) this.#send(zone, { type: 'dropped', to: epoch });
    this.#bringBack(zone, info, !there);
  }

  /**
   * Repeats until a zone is back: once its process has died, one of the remaining zones recreates its room. A dead
   * process stays dead and is not checked again: on a busy machine that may take too long, and cost four seconds. A
   * zone that is joining knows no others, and so cannot tell whose turn it is.
   */
  async #bringBack(zone, info, wasDead) {
    if (this.#stopped || this.#lost.get(zone) !== info) return;
    const isMine = this.running && [...this.#peers.keys()].every((peer) => peer > this.#zone);
    const comes = performance.now() - (this.#asked.get(zone) ?? -Infinity) < retryTime;
    const isDead = wasDead || !(await isThere(info));
    if (isMine && !comes && isDead) {
      // Only one zone does so, even if two think that it is their turn.
      const turn = await this.#presence.hincrbyex('zones:replaced', String(zone), 1, retryTime / 1000 - 1);
      if (turn === 1) {
        this.#calls.log(`zone ${zone} is made anew`);
        await this.#calls.lost(zone, info);
      }
    }
    setTimeout(() => this.#bringBack(zone, info, isDead), retryTime);
  }

  #drop(zone) {
    this.#coming.delete(zone);
    if (this.#peers.delete(zone)) this.#simulation.shard.forget(zone);
  }

  #sayHello() {
    this.#send(undefined, { type: 'hello', info: this.#info });
  }

  /** Joins the running zones; waits as long as that takes. */
  async #join() {
    const known = [...this.#peers].map(([zone, { info }]) => [zone, info]);
    for (const [zone] of known) this.#drop(zone);
    this.#coming.clear();
    const begin = await this.#calls.begin();
    const expected = new Map(begin.peers ?? known);
    expected.delete(this.#zone);
    for (;;) {
      await sleep(Math.max(0, this.#yieldUntil - performance.now()));
      if (this.#stopped) return;
      this.#epoch = Math.floor(Math.random() * 2 ** 48);
      this.#welcomes.clear();
      this.#absent.clear();
      const asked = performance.now();
      const answered = await this.#ask(begin, expected);
      if (this.#stopped) return;
      if (!answered) continue;
      this.#begin(begin, asked);
      return;
    }
  }

  /**
   * Asks all running zones which entities they own. Their answers also name the other running zones. It does not wait
   * for a zone whose process has ended, that says it is not running, or that has been silent for too long. Returns
   * false if it has to yield to another zone that joins.
   */
  async #ask({ isLive, tick }, expected) {
    const join = { type: 'join', since: isLive ? -1 : tick, info: this.#info };
    let begun = performance.now();
    for (let asked = -Infinity; !this.#stopped && this.#yieldUntil <= performance.now(); await sleep(20)) {
      if (!this.#isConnected()) begun = performance.now();
      for (const [zone, { at, info }] of this.#ran) if (at > begun - 1000) expected.set(zone, info);
      for (const { peers } of this.#welcomes.values()) for (const [zone, info] of peers) expected.set(zone, info);
      const missing = [...expected].filter(([zone]) => !this.#welcomes.has(zone) && !this.#absent.has(zone));
      const waited = performance.now() - begun;
      if (missing.length === 0 ? expected.size > 0 || waited > gathering : waited > patience) return true;
      if (performance.now() - asked < 2 * gathering) continue;
      if (asked > 0) for (const [zone, info] of missing) if (!(await isThere(info))) this.#absent.add(zone);
      asked = performance.now();
      this.#send(undefined, join);
    }
    return false;
  }

  #begin({ tick, entities, isLive }, asked) {
    const welcomes = [...this.#welcomes.values()];
    // Ticks that the others passed while their answers arrived. `ahead` covers those until they learn when this zone
    // begins.
    const passed = Math.ceil((performance.now() - asked) / tickTime);
    const ticks = welcomes.map(({ tick }) => tick + passed);
    // Never back to a tick that this zone has passed: it may have run alone, further than the others. A snapshot from
    // then would count as newer than what they hand to it from now on.
    const start = Math.max(tick + 1, ...ticks.map((tick) => tick + ahead));
    const owners = new Map(
      welcomes.flatMap(({ from, owned }) => [...unpack(owned, Uint32Array)].map((id) => [id, from])),
    );
    // Nobody's, as its new zone answered before it arrived there, and its old one after it had left.
    for (const [id, to, given] of welcomes.flatMap(({ given }) => given)) {
      if (this.#welcomes.get(to)?.tick <= given) owners.set(id, to);
    }
    // What others handed over since the snapshot is newer than it; live entities are newer than what was handed over.
    const offers = welcomes.flatMap((welcome) => unpackEntities(welcome.offers));
    const left = welcomes.flatMap((welcome) => unpackEntities(welcome.left));
    const all = isLive ? [...left, ...offers, ...entities] : [...left, ...entities, ...offers];
    const mine = new Map(all.map((entity) => [entity.id, entity]));
    this.#simulation.restart([...mine.values()], owners, start);
    this.tick = start;
    this.running = true;
    for (const { from, epoch, info } of welcomes) {
      this.#lost.delete(from);
      this.#peers.set(from, { inbox: new Map(), epoch, info, heard: performance.now() });
      this.#send(from, { type: 'start', start, info: this.#info });
    }
    // It may be the one whose turn it is to bring these back.
    for (const [zone, info] of welcomes.flatMap(({ lost }) => lost)) {
      if (this.#peers.has(zone) || this.#lost.has(zone) || zone === this.#zone) continue;
      this.#lost.set(zone, info);
      this.#bringBack(zone, info, false);
    }
    this.#sayHello();
    this.#calls.restarted();
    this.#calls.log(
      `begins at tick ${start} with ${this.#simulation.entities.size} entities, beside ${welcomes.length} zones`,
      { begins: { zone: this.#zone, tick: start } },
    );
  }

  #hear(message) {
    const { type, from } = message;
    if (this.#stopped) return;
    if (from === this.#zone) {
      // This room was thought to be dead, so another one was created for its zone.
      if (type === 'join' && message.info.roomId !== this.#info.roomId) this.#calls.replaced();
      return;
    }
    const peer = this.#peers.get(from);
    if (peer?.epoch === message.epoch) peer.heard = performance.now();
    if (type === 'hello') this.#ran.set(from, { at: performance.now(), info: message.info });
    if (type === 'join') this.#asked.set(from, performance.now());
    if (type === 'tick') this.#hearTick(message);
    else if (type === 'again') this.#tellAgain(message);
    else if (type === 'join') this.#welcome(message);
    else if (type === 'welcome' && message.to === this.#epoch) this.#welcomes.set(from, message);
    else if (type === 'absent' && message.to === this.#epoch) this.#absent.add(from);
    else if (type === 'start') this.#admit(message);
    else if (type === 'late' && this.#peers.has(from)) this.running = false;
    else if (type === 'dropped' && message.to === this.#epoch) this.#leave(from);
    else if (type === 'hello' && this.running && !this.#peers.has(from) && !this.#coming.has(from)) {
      // Two zones run without each other: the one with the larger number joins again.
      if (from < this.#zone) this.running = false;
    }
    this.#wake();
  }

  /** Another zone has left this one out, so this one has to join again. */
  #leave(from) {
    if (this.#peers.has(from)) this.running = false;
    this.#coming.delete(from);
  }

  /** Answers a zone that waits for a tick, which may be lost, still to come, or never to come. */
  #tellAgain({ from, epoch, tick }) {
    const told = this.#last.find(([zone, message]) => zone === from && message.tick === tick);
    const peer = this.#peers.get(from) ?? this.#coming.get(from);
    if (told) this.#send(from, told[1]);
    else if (this.running && peer?.epoch !== epoch) this.#send(from, { type: 'dropped', to: epoch });
    else this.#send(from, { type: 'yet' });
  }

  #hearTick(message) {
    const peer = this.#peers.get(message.from) ?? this.#coming.get(message.from);
    if (peer?.epoch === message.epoch && message.tick >= this.tick) peer.inbox.set(message.tick, message);
  }

  #welcome({ from, epoch, since }) {
    if (!this.running) {
      if (from < this.#zone) this.#yieldUntil = performance.now() + gathering + 100;
      this.#send(from, { type: 'absent', to: epoch });
      return;
    }
    this.#drop(from);
    this.#send(from, {
      type: 'welcome',
      to: epoch,
      tick: this.tick,
      info: this.#info,
      peers: [...this.#peers, ...this.#coming].map(([zone, { info }]) => [zone, info]),
      lost: [...this.#lost],
      owned: pack(Uint32Array.from(this.#simulation.entities.keys())),
      given: this.#simulation.handedToOthersThan(from),
      offers: packEntities(this.#simulation.handedTo(from, since)),
      left: packEntities(this.#simulation.leftTo(from)),
    });
  }

  #admit({ from, epoch, start, info }) {
    if (!this.running) return;
    if (start <= this.tick) {
      this.#send(from, { type: 'late' });
      return;
    }
    this.#lost.delete(from);
    this.#coming.set(from, { inbox: new Map(), epoch, start, info, heard: 0 });
  }
}

/** Whether a process is alive: the same one, not another that now has its port. */
async function isThere({ address, processId }) {
  try {
    const response = await fetch(`http://${address}/process`, { signal: AbortSignal.timeout(answerTime) });
    return (await response.text()) === processId;
  } catch ({ name }) {
    return name === 'TimeoutError'; // it is busy
  }
}

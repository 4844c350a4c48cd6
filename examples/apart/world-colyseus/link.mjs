// How zones keep in step: each tick a zone tells every other zone what changed for it, and waits for the same from them.
// So all zones together are at any tick what one process would be. Messages go over the presence of Colyseus.
//
// A zone that starts, or starts again, joins: it asks all, is told by each at which tick that is and whom it owns, and
// names a tick from which on they count with each other. If a zone is silent, the others ask whether its process is still
// there. If it is not, they go on, and another process makes its room anew. Else they wait, but not for ever: a zone that
// is slow still answers that it has not got so far, one that is asked by a zone it does not count with says that. Entities
// turn round at the border of a zone that is not there.
import { pack, packDelta, packEntities, unpack, unpackDelta, unpackEntities } from './wire.mjs';
import { tickTime } from './world.mjs';

const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** After so many milliseconds without a word it is asked whether the other process is still there, and again. */
const suspicious = 200;
/** Who is there and says nothing for so long is left out. */
const patience = 5000;
/** So long an answer may take; a process that gives none, but takes the question, is there. */
const answerTime = 500;
/** Milliseconds from one attempt to bring a zone back to the next. */
const retryTime = 4000;
/** How long one that joins waits for answers where it knows of nobody, and how many ticks ahead it begins. */
const gathering = 300;
const ahead = 6;
/** Ticks between two signs of life. */
const helloEvery = 10;

export class Link {
  tick = 0;
  running = false;
  /** What it told the others: messages, and in how many bytes how much was new of boxes. */
  sent = { messages: 0, bytes: 0, records: 0 };
  /** Milliseconds of work of the last tick, without the waiting. */
  work = 0;
  #presence;
  #isConnected;
  #simulation;
  #info;
  #calls;
  #epoch = 0;
  /** Zones that count: what they sent by tick. And those that will from some tick on. */
  #peers = new Map();
  #coming = new Map();
  /** When each zone last said that it runs, and as what; and when that it would like to. */
  #ran = new Map();
  #asked = new Map();
  /** While it joins: what those that run answered, and who is not waited for. */
  #welcomes = new Map();
  #absent = new Set();
  #yieldUntil = 0;
  #wake = () => {};
  /** What it told whom in this tick and the last one. */
  #last = [];
  #stopped = false;

  /**
   * @param info what other zones are to know of this one: its room and its process
   * @param calls `begin()` gives { tick, entities, isLive, peers } to begin with; `ticked(given)` after each tick; `restarted()`;
   *   `lost(zone, info)` where a zone has to be made anew; `replaced()` where this one was; `log(text)`
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

  /** What is known of the room of another zone. */
  infoOf(zone) {
    return this.#peers.get(zone)?.info;
  }

  /** Those that count with each other: each zone with its room, this one too. */
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

  /** Moves everybody on, and tells the others. */
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

  /** Waits until all others have told the same; leaves out those that do not. */
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
        // Nobody is to blame: the world waits.
        since = asked = performance.now();
      } else if (performance.now() - asked > suspicious) {
        for (const zone of missing) {
          this.#send(zone, { type: 'again', tick: this.tick }); // it may have got lost, with Redis
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
    if (there) this.#send(zone, { type: 'dropped', to: epoch });
    this.#bringBack(zone, info, !there);
  }

  /**
   * Until a zone is there again: once its process has died, one of those that are left makes its room anew. Who is dead
   * stays so and is not asked again: on a machine with much to do an answer may come too late, and four seconds are lost.
   */
  async #bringBack(zone, info, wasDead) {
    if (this.#stopped || this.#peers.has(zone) || this.#coming.has(zone)) return;
    const isMine = [...this.#peers.keys()].every((peer) => peer > this.#zone);
    const comes = performance.now() - (this.#asked.get(zone) ?? -Infinity) < retryTime;
    const isDead = wasDead || !(await isThere(info));
    if (isMine && !comes && isDead) {
      // Only one does, should another zone think that it is its turn.
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

  /** Becomes one of those that are running; waits as long as that takes. */
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
      await this.#ask(begin, expected);
      if (this.#stopped) return;
      if (this.#yieldUntil > performance.now()) continue;
      this.#begin(begin, asked);
      return;
    }
  }

  /**
   * Asks all that run whom they own. Who runs is told by those that answer, too. Not waited for is one whose process has
   * ended, one that says it does not run, and one that has said nothing for too long.
   */
  async #ask({ isLive, tick }, expected) {
    const join = { type: 'join', since: isLive ? -1 : tick, info: this.#info };
    let begun = performance.now();
    for (let asked = -Infinity; !this.#stopped && this.#yieldUntil < performance.now(); await sleep(20)) {
      if (!this.#isConnected()) begun = performance.now();
      for (const [zone, { at, info }] of this.#ran) if (at > begun - 1000) expected.set(zone, info);
      for (const { peers } of this.#welcomes.values()) for (const [zone, info] of peers) expected.set(zone, info);
      const missing = [...expected].filter(([zone]) => !this.#welcomes.has(zone) && !this.#absent.has(zone));
      const waited = performance.now() - begun;
      if (missing.length === 0 ? expected.size > 0 || waited > gathering : waited > patience) return;
      if (performance.now() - asked < 2 * gathering) continue;
      if (asked > 0) for (const [zone, info] of missing) if (!(await isThere(info))) this.#absent.add(zone);
      asked = performance.now();
      this.#send(undefined, join);
    }
  }

  #begin({ tick, entities, isLive }, asked) {
    const welcomes = [...this.#welcomes.values()];
    // Ticks go on while the answer is on its way, and while these are told from when on this one is there.
    const passed = Math.ceil((performance.now() - asked) / tickTime);
    const ticks = welcomes.map(({ tick }) => tick + passed);
    // Never back to a tick that this zone was at: it may have gone on alone, and further than the others. A snapshot of
    // that time would be taken for newer than what they hand to it from now on.
    const start = Math.max(tick + 1, ...ticks.map((tick) => tick + ahead));
    const others = new Set(welcomes.flatMap(({ owned }) => [...unpack(owned, Uint32Array)]));
    // What others handed to this zone since a snapshot is newer than that; what it has itself is newer than what they handed.
    const offers = welcomes.flatMap((welcome) => unpackEntities(welcome.offers));
    const all = isLive ? [...offers, ...entities] : [...entities, ...offers];
    const mine = new Map(all.map((entity) => [entity.id, entity]));
    this.#simulation.restart([...mine.values()].filter(({ id }) => !others.has(id)));
    this.tick = start;
    this.running = true;
    for (const { from, epoch, info } of welcomes) {
      this.#peers.set(from, { inbox: new Map(), epoch, info, heard: performance.now() });
      this.#send(from, { type: 'start', start, info: this.#info });
    }
    this.#sayHello();
    this.#calls.restarted();
    this.#calls.log(
      `begins at tick ${start} with ${this.#simulation.entities.size} entities, beside ${welcomes.length} zones`,
    );
  }

  #hear(message) {
    const { type, from } = message;
    if (this.#stopped) return;
    if (from === this.#zone) {
      // Another room has been made for this zone: this one was thought to be dead.
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
      // Two that run and do not know of each other: the later one joins again.
      if (from < this.#zone) this.running = false;
    }
    this.#wake();
  }

  /** Another zone has left this one out: they go on together only after this one has joined again. */
  #leave(from) {
    if (this.#peers.has(from)) this.running = false;
    this.#coming.delete(from);
  }

  /** What another zone waits for: it may have got lost, or is still to come, or will never come. */
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
      owned: pack(Uint32Array.from(this.#simulation.entities.keys())),
      offers: packEntities(this.#simulation.handedTo(from, since)),
    });
  }

  #admit({ from, epoch, start, info }) {
    if (!this.running) return;
    if (start <= this.tick) this.#send(from, { type: 'late' });
    else this.#coming.set(from, { inbox: new Map(), epoch, start, info, heard: 0 });
  }
}

/** Whether a process is there: it, and no other that has its port by now. */
async function isThere({ address, processId }) {
  try {
    const response = await fetch(`http://${address}/process`, { signal: AbortSignal.timeout(answerTime) });
    return (await response.text()) === processId;
  } catch ({ name }) {
    return name === 'TimeoutError'; // it is busy
  }
}

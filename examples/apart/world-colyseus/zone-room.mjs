// A zone is a room. It simulates the entities of its zone, shows each client those that its own entity sees, and hands
// clients over, with their entities, to the rooms of other zones.
import { matchMaker, Room } from '@colyseus/core';
import { StateView, schema, t } from '@colyseus/schema';
import { Link } from './link.mjs';
import { Simulation } from './simulation.mjs';
import { pack, packEntities, unpackEntities } from './wire.mjs';
import { beginnings, cutInto, isAvatar, zoneOf } from './world.mjs';

const Entity = schema({ x: t.float32(), y: t.float32() }, 'Entity');
/** The state has only entities that some client in this room sees. */
const ZoneState = schema({ entities: t.map(Entity).view() }, 'ZoneState');

/** Ticks between two snapshots, and between two reports. */
const snapshotEvery = 20;
const reportEvery = 5;

export class ZoneRoom extends Room {
  #simulation;
  #link;
  #setup;
  /** Clients by the id of their entity. */
  #clients = new Map();
  /** By id, the entities in the state, with the number of clients that see them. */
  #shown = new Map();
  #counts = { given: 0, taken: 0, began: 0, ended: 0, ticks: 0, work: 0, worst: 0, late: 0 };
  #lastTick = performance.now();

  onCreate({ zone, peers, setup }) {
    this.#setup = setup ?? ZoneRoom.setup;
    const { zones, presence, isConnected, log } = this.#setup;
    this.zone = zone;
    this.autoDispose = false;
    this.patchRate = null; // a patch per tick
    this.state = new ZoneState();
    this.onMessage('steer', (client, { vx, vy }) => {
      const entity = this.#simulation.entities.get(client.userData.avatar);
      if (entity && Number.isFinite(vx) && Number.isFinite(vy)) Object.assign(entity, { vx, vy });
    });
    this.#simulation = new Simulation(cutInto(zones), zone);
    this.#link = new Link({
      presence,
      isConnected,
      simulation: this.#simulation,
      info: { roomId: this.roomId, processId: matchMaker.processId, address: `localhost:${this.#setup.port}` },
      calls: {
        begin: () => this.#begin(peers),
        ticked: (given) => this.#ticked(given),
        restarted: () => {
          for (const client of this.#clients.values()) client.userData.fresh = true;
        },
        lost: (lost, info) => this.#makeAnew(lost, info),
        replaced: () => this.disconnect(),
        log: (text, event) => log(`zone ${zone}: ${text}`, event),
      },
    });
    // Not awaited: the caller has to learn that the room is being created; until it runs, no client finds its entity.
    this.#link.start();
  }

  onDispose() {
    return this.#link.stop();
  }

  /** What to begin with: what this room has, the last snapshot, or the beginning of the world. */
  async #begin(peers) {
    const { tick: next } = this.#link;
    if (next > 0) return { tick: next - 1, entities: this.#simulation.everybody(), isLive: true };
    const snapshot = await this.presence.get(`zone:${this.zone}:snapshot`);
    if (snapshot) {
      const { tick, entities } = JSON.parse(snapshot);
      return { tick, entities: unpackEntities(entities), peers };
    }
    const zones = cutInto(this.#setup.zones);
    const all = [...beginnings(this.#setup.entities)];
    return { tick: -1, entities: all.filter((entity) => zoneOf(zones, entity) === this.zone) };
  }

  /** Recreates the room of a zone whose process has died, in the process with the fewest rooms: this one on a tie. */
  async #makeAnew(zone, { processId }) {
    try {
      await matchMaker.driver.cleanup(processId);
      await this.#createOn(zone, processId);
    } catch (error) {
      this.#setup.log(`zone ${this.zone}: zone ${zone} cannot be made anew: ${error.message}`);
    }
  }

  async #createOn(zone, processId) {
    const all = (await matchMaker.stats.fetchAll()).filter((process) => process.processId !== processId);
    // This process comes first on a tie: another one may be slow to answer.
    const isOther = (process) => Number(process.processId !== matchMaker.processId);
    all.sort((a, b) => a.roomCount - b.roomCount || isOther(a) - isOther(b));
    await matchMaker.createRoom('zone', { zone, peers: this.#link.together(), process: all[0]?.processId });
  }

  onJoin(client, { avatar }) {
    const entity = avatar === undefined ? this.#freeAvatar() : this.#simulation.entities.get(avatar);
    if (!entity)
      throw new Error(
        `zone ${this.zone}: ${avatar === undefined ? 'no entity is free' : `entity ${avatar} is not here`}`,
      );
    client.view = new StateView();
    client.userData = { avatar: entity.id, sees: new Set(), fresh: true };
    this.#clients.set(entity.id, client);
    client.send('you', { avatar: entity.id });
  }

  onLeave(client) {
    const { avatar, sees } = client.userData;
    for (const id of [...sees]) this.#hide(client, id);
    if (this.#clients.get(avatar) === client) this.#clients.delete(avatar);
    client.view.dispose();
  }

  #freeAvatar() {
    for (const entity of this.#simulation.entities.values()) {
      if (isAvatar(entity.id) && !this.#clients.has(entity.id)) return entity;
    }
    return undefined;
  }

  #ticked(given) {
    const { shard } = this.#simulation;
    if (this.#setup.everything) this.#showAll();
    else this.#show(shard.space);
    for (const [id, { entity }] of this.#shown) this.#simulation.placeOf(id, entity);
    this.broadcastPatch();
    for (const { entity, to } of given) this.#handOn(this.#clients.get(entity.id), to);
    this.#count(given);
    const { tick } = this.#link;
    if (tick % snapshotEvery === this.zone % snapshotEvery) this.#keep(tick);
    if (tick % reportEvery === 0) this.#report(tick);
  }

  /** Tells each client what came into sight and what left it, from the pairs that began and ended. */
  #show(space) {
    for (const client of this.#clients.values()) {
      const { avatar, sees, fresh } = client.userData;
      if (!fresh) continue;
      const now = new Set([avatar, ...this.#simulation.seenBy(avatar)]);
      for (const id of [...sees]) if (!now.has(id)) this.#hide(client, id);
      for (const id of now) this.#reveal(client, id);
      client.userData.fresh = false;
    }
    const both = (pairs, change) => {
      for (let k = 0; k < pairs.length; k += 2) {
        const [a, b] = [pairs[k], pairs[k + 1]];
        if (this.#clients.has(a)) change(this.#clients.get(a), b);
        if (this.#clients.has(b)) change(this.#clients.get(b), a);
      }
    };
    both(space.ended, (client, id) => this.#hide(client, id));
    both(space.began, (client, id) => this.#reveal(client, id));
  }

  /** For comparison: shows every client everything in the room. */
  #showAll() {
    const { entities } = this.#simulation;
    for (const client of this.#clients.values()) {
      for (const id of client.userData.sees) if (!entities.has(id)) this.#hide(client, id);
      for (const id of entities.keys()) this.#reveal(client, id);
    }
  }

  #reveal(client, id) {
    if (client.userData.sees.has(id)) return;
    let shown = this.#shown.get(id);
    if (!shown) {
      shown = { entity: new Entity(), seers: 0 };
      if (!this.#simulation.placeOf(id, shown.entity)) return;
      this.#shown.set(id, shown);
      this.state.entities.set(String(id), shown.entity);
    }
    shown.seers++;
    client.userData.sees.add(id);
    client.view.add(shown.entity);
  }

  #hide(client, id) {
    if (!client.userData.sees.delete(id)) return;
    const shown = this.#shown.get(id);
    client.view.remove(shown.entity);
    if (--shown.seers > 0) return;
    this.#shown.delete(id);
    this.state.entities.delete(String(id));
  }

  /** Sends a client to the room that has its entity now. It stays here too until it has joined there. */
  async #handOn(client, to) {
    const info = this.#link.infoOf(to);
    if (!client || !info) return;
    const { avatar } = client.userData;
    try {
      client.send('go', await matchMaker.joinById(info.roomId, { avatar }));
    } catch (error) {
      this.#setup.log(`zone ${this.zone}: entity ${avatar} cannot be handed to zone ${to}: ${error.message}`);
      client.leave(4001);
    }
  }

  #count(given) {
    const { shard } = this.#simulation;
    const counts = this.#counts;
    counts.given += given.length;
    counts.taken += shard.taken.length;
    counts.began += shard.began.length / 2;
    counts.ended += shard.ended.length / 2;
    counts.ticks++;
    counts.work += this.#link.work;
    counts.worst = Math.max(counts.worst, this.#link.work);
    const now = performance.now();
    if (now - this.#lastTick > 75) counts.late++;
    this.#lastTick = now;
  }

  #keep(tick) {
    const entities = packEntities(this.#simulation.everybody());
    Promise.resolve(this.presence.set(`zone:${this.zone}:snapshot`, JSON.stringify({ tick, entities }))).catch(
      () => {},
    );
  }

  #report(tick) {
    const { entities, shard } = this.#simulation;
    const owned = [...entities.values()];
    const places = Uint16Array.from(owned.flatMap(({ id, x, y }) => [id, x * 8, y * 8]));
    const ghosts = [...shard.ids()].filter((id) => !shard.owns(id));
    const [followed] = this.#clients.values();
    const report = {
      zone: this.zone,
      process: process.pid,
      port: this.#setup.port,
      tick,
      beside: this.#link.together().length - 1,
      entities: owned.length,
      ids: owned.reduce((sum, { id }) => sum + id, 0),
      ghosts: ghosts.length,
      clients: this.#clients.size,
      pairs: shard.pairs.length / 2,
      ...this.#counts,
      ...this.#link.sent,
      cpu: process.cpuUsage().user + process.cpuUsage().system,
      places: pack(places),
      ghostPlaces: pack(Uint16Array.from(ghosts.flatMap((id) => this.#placed(id)))),
      followed: followed
        ? [followed.userData.avatar, ...followed.userData.sees].map((id) => [id, ...this.#placed(id)])
        : [],
    };
    Object.assign(this.#counts, { ticks: 0, work: 0, worst: 0 });
    Promise.resolve(this.presence.publish('reports', report)).catch(() => {});
  }

  #placed(id) {
    const place = { x: 0, y: 0 };
    this.#simulation.placeOf(id, place);
    return [place.x * 8, place.y * 8];
  }
}

// Simulated clients. Each steers its entity around the world, follows it to other rooms, and reconnects by itself if
// its room has died. Every second they report their counts, as a line of JSON.
import { Client } from '@colyseus/sdk';
import { cutInto, tickTime, world, zoneOf } from './world.mjs';

const { ports, zones: count, clients } = JSON.parse(process.argv[2]);
const zones = cutInto(count);
const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Counts of all clients. `blind`: ticks in which a client did not see its own entity, though it had before. */
const counts = { handedOver: 0, lost: 0, found: 0, refused: 0, patches: 0, blind: 0, blindest: 0, slowest: 0 };

class Player {
  avatar;
  /** The rooms it is in: two while it is handed over. */
  rooms = new Set();
  place = { x: Math.random() * world.width, y: Math.random() * world.height };
  #blindSince;

  async join() {
    for (let k = 0; ; k++) {
      // Where it was seen last. Since then it may have gone to another zone.
      const zone =
        this.avatar === undefined ? Math.floor(Math.random() * count) : (zoneOf(zones, this.place) + k) % count;
      const client = new Client(`ws://localhost:${ports[k % ports.length]}`);
      try {
        const options = this.avatar === undefined ? { zone } : { zone, avatar: this.avatar };
        this.#enter(await client.join('zone', options), client);
        return;
      } catch {
        counts.refused++;
        await sleep(100 + 200 * Math.random());
      }
    }
  }

  #enter(room, client) {
    if (room.reconnection) room.reconnection.enabled = false; // it reconnects itself
    this.rooms.add(room);
    room.onMessage('you', ({ avatar }) => {
      this.avatar = avatar;
    });
    room.onMessage('go', (seat) => this.#go(room, seat, client));
    let last = performance.now();
    room.onStateChange(() => {
      const now = performance.now();
      counts.patches++;
      counts.slowest = Math.max(counts.slowest, now - last);
      last = now;
    });
    room.onLeave(() => this.#left(room));
    room.onError(() => {});
  }

  async #go(from, seat, client) {
    try {
      const room = await client.consumeSeatReservation(seat);
      this.#enter(room, client);
      await new Promise((resolve) => room.onStateChange.once(resolve));
      counts.handedOver++;
    } catch {
      counts.refused++;
    }
    this.rooms.delete(from);
    from.leave();
    if (this.rooms.size === 0) this.join();
  }

  #left(room) {
    if (!this.rooms.delete(room) || this.rooms.size > 0) return;
    counts.lost++;
    this.join().then(() => counts.found++);
  }

  /** Looks for its own entity in what it was sent, and steers now and then. */
  look() {
    let seen = false;
    for (const { state } of this.rooms) {
      const own = state?.entities?.get(String(this.avatar));
      if (own) {
        seen = true;
        this.place = { x: own.x, y: own.y };
      }
    }
    if (seen) this.#blindSince = undefined;
    else if (this.avatar !== undefined) {
      const now = performance.now();
      this.#blindSince ??= now;
      counts.blind++;
      counts.blindest = Math.max(counts.blindest, now - this.#blindSince);
    }
    if (Math.random() > 0.02) return;
    const angle = 2 * Math.PI * Math.random();
    for (const room of this.rooms) room.send('steer', { vx: 6 * Math.cos(angle), vy: 3 * Math.sin(angle) });
  }
}

const players = Array.from({ length: clients }, () => new Player());
(async () => {
  for (const player of players) {
    player.join();
    await sleep(5);
  }
})();
setInterval(() => {
  for (const player of players) player.look();
}, tickTime);
setInterval(() => {
  const connected = players.filter(({ rooms }) => rooms.size > 0).length;
  console.log(JSON.stringify({ at: Date.now(), clients: { connected, ...counts } }));
  Object.assign(counts, { blindest: 0, slowest: 0 });
}, 1000);

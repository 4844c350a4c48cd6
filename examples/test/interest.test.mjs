// Players are told exactly what comes into sight and what leaves it, also when players join, leave and come back.
import { describe, expect, test } from 'vitest';
import { seeded } from '../force-d3/words.mjs';
import { installed } from './check.mjs';

const sorted = (set) => [...set].sort();

/** Who sees whom, by a test of every pair. */
function pairsInSight(places, reachX, reachY) {
  const pairs = new Set();
  for (const [viewer, [x, y]] of places) {
    for (const [seen, [otherX, otherY]] of places) {
      if (viewer === seen || Math.abs(x - otherX) > reachX || Math.abs(y - otherY) > reachY) continue;
      pairs.add(`${viewer} ${seen}`);
    }
  }
  return pairs;
}

describe.skipIf(!installed)('interest management', () => {
  test('tells of every change, once, and of nothing else', async () => {
    const { Interest } = await import('../server-interest/interest.mjs');
    const random = seeded(5);
    const interest = new Interest(12, 8);
    const places = new Map();
    const known = new Set();
    for (let tick = 0; tick < 300; tick++) {
      for (let call = 0; call < 15; call++) {
        const player = Math.floor(random() * 60);
        const [x, y] = [Math.floor(random() * 100), Math.floor(random() * 100)];
        if (!places.has(player)) interest.add(player, x, y);
        else if (random() < 0.2) {
          interest.remove(player);
          places.delete(player);
          continue;
        } else interest.move(player, x, y);
        places.set(player, [x, y]);
      }
      interest.update(
        (viewer, seen) => {
          expect(known.has(`${viewer} ${seen}`)).toBe(false);
          known.add(`${viewer} ${seen}`);
        },
        (viewer, seen) => expect(known.delete(`${viewer} ${seen}`)).toBe(true),
      );
      const exact = pairsInSight(places, 12, 8);
      expect(sorted(known)).toEqual(sorted(exact));
      const [someone] = places.keys();
      const theirs = sorted(exact).filter((pair) => pair.startsWith(`${someone} `));
      expect(
        interest
          .seenBy(someone)
          .map((seen) => `${someone} ${seen}`)
          .sort(),
      ).toEqual(theirs);
    }
  });
});

const connect = async ({ server }) => {
  const { WebSocket } = await import('ws');
  return new WebSocket(`ws://localhost:${server.address().port}`);
};

/** A player who has been told their id, and hears all that is said. */
async function join(server) {
  const socket = await connect(server);
  const heard = [];
  return new Promise((resolve) => {
    socket.on('message', (data) => {
      heard.push(JSON.parse(data));
      if (heard.length === 1) resolve({ socket, heard, id: heard[0].you });
    });
  });
}

/** The code with which the server closes the socket of someone who joins and does something. */
async function closedBy(server, does) {
  const socket = await connect(server);
  return new Promise((resolve) => {
    socket.on('error', () => {});
    socket.on('open', () => does(socket));
    socket.on('close', resolve);
  });
}

async function until(done) {
  for (let turn = 0; turn < 500 && !done(); turn++) await new Promise((resolve) => setTimeout(resolve, 5));
  expect(done()).toBe(true);
}

describe.skipIf(!installed)('the server of interest management', () => {
  test('works over WebSockets', async () => {
    const { startServer } = await import('../server-interest/server.mjs');
    const server = startServer({ reach: 10 });
    const [ann, bob] = [await join(server), await join(server)];
    const go = async (player, x, y) => {
      player.socket.send(JSON.stringify({ x, y }));
      await until(() => server.players.get(player.id).x === x);
    };
    const last = (player) => player.heard.at(-1);
    await go(ann, 100, 0);
    await go(bob, 130, 0);
    expect(server.tick()).toBe(0);
    await go(bob, 105, 2);
    expect(server.tick()).toBe(2);
    await until(() => 'enter' in last(ann) && 'enter' in last(bob));
    expect(last(ann)).toEqual({ enter: bob.id, x: 105, y: 2 });
    server.tick();
    await until(() => 'at' in last(ann));
    bob.socket.close();
    await until(() => server.players.size === 1);
    server.tick();
    await until(() => last(ann).leave === bob.id);
    ann.socket.close();
    await server.close();
  });

  test('takes nobody for the one who has just left', async () => {
    const { startServer } = await import('../server-interest/server.mjs');
    const server = startServer({ reach: 10 });
    const [ann, bob] = [await join(server), await join(server)];
    server.tick();
    await until(() => ann.heard.length === 2 && bob.heard.length === 2);
    bob.socket.close();
    await until(() => server.players.size === 1);
    const cay = await join(server);
    server.tick();
    await until(() => cay.heard.length === 2);
    expect(cay.heard).toEqual([{ you: cay.id }, { enter: ann.id, x: 0, y: 0 }]);
    await until(() => ann.heard.length === 4);
    expect(ann.heard.slice(2)).toEqual([{ leave: bob.id }, { enter: cay.id, x: 0, y: 0 }]);
    const dan = await join(server);
    expect(dan.id).toBe(bob.id); // free again
    for (const { socket } of [ann, cay, dan]) socket.close();
    await server.close();
  });

  test('closes the socket of a player that sends something else, and goes on', async () => {
    const { startServer } = await import('../server-interest/server.mjs');
    const server = startServer();
    for (const text of ['hello', 'null', '[]', '{"x":1}', '{"x":"1","y":2}', '{"x":1e999,"y":0}']) {
      expect(await closedBy(server, (socket) => socket.send(text)), text).toBe(1007);
    }
    expect(await closedBy(server, (socket) => socket.send(' '.repeat(2000)))).toBe(1009);
    expect(await closedBy(server, (socket) => socket._socket.write(Buffer.from([0xff, 0xff, 0xff, 0xff])))).toBe(1002);
    await until(() => server.players.size === 0);
    expect(server.tick()).toBe(0);
    await server.close();
  });
});

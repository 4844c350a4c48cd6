// A game server over WebSockets: players send their place, and are told only about those in sight.
// From a player: { x, y }. To a player: { enter: id, x, y }, { at: id, x, y } and { leave: id }.
import { WebSocketServer } from 'ws';
import { Interest } from './interest.mjs';

/**
 * Starts a server; `port` 0 takes any free one. `tick()` updates everyone and returns how many messages were sent.
 * Call it about 20 times per second.
 */
export function startServer({ port = 0, reach = 50 } = {}) {
  const interest = new Interest(reach);
  const players = new Map();
  const free = [];
  let sent = 0;
  const send = (player, message) => {
    sent++;
    players.get(player)?.socket.send(JSON.stringify(message));
  };
  const server = new WebSocketServer({ port });
  server.on('connection', (socket) => {
    const id = free.pop() ?? players.size;
    const player = { socket, x: 0, y: 0 };
    players.set(id, player);
    interest.add(id, 0, 0);
    socket.on('message', (data) => {
      const { x, y } = JSON.parse(data);
      if (!Number.isFinite(x) || !Number.isFinite(y)) return;
      Object.assign(player, { x, y });
      interest.move(id, x, y);
    });
    socket.on('close', () => {
      players.delete(id);
      interest.remove(id);
      free.push(id);
    });
    socket.send(JSON.stringify({ you: id }));
  });
  return {
    server,
    players,
    interest,
    tick() {
      sent = 0;
      const fresh = new Set();
      interest.update(
        (viewer, seen) => {
          const { x, y } = players.get(seen);
          fresh.add(`${viewer} ${seen}`);
          send(viewer, { enter: seen, x, y });
        },
        (viewer, seen) => send(viewer, { leave: seen }),
      );
      for (const viewer of players.keys()) {
        for (const seen of interest.seenBy(viewer)) {
          if (fresh.has(`${viewer} ${seen}`)) continue;
          const { x, y } = players.get(seen);
          send(viewer, { at: seen, x, y });
        }
      }
      return sent;
    },
    close: () => new Promise((resolve) => server.close(resolve)),
  };
}

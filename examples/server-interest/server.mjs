// A game server over WebSockets: players send their place, and are told only about those in sight.
// From a player: { x, y }. To a player: { enter: id, x, y }, { at: id, x, y } and { leave: id }.
import { WebSocketServer } from 'ws';
import { Interest } from './interest.mjs';

/** The code with which a socket is closed whose message is not understood. */
const notUnderstood = 1007;
/** The most bytes in a message. */
const maxPayload = 1024;

/** The place in a message; undefined for anything else, since players may send whatever they like. */
function placeIn(data) {
  try {
    const { x, y } = JSON.parse(data);
    return Number.isFinite(x) && Number.isFinite(y) ? { x, y } : undefined;
  } catch {
    return undefined;
  }
}

/**
 * Starts a server; `port` 0 takes any free one. `tick()` updates everyone and returns how many messages were sent.
 * Call it about 20 times per second.
 */
export function startServer({ port = 0, reach = 50 } = {}) {
  const interest = new Interest(reach);
  const players = new Map();
  const free = [];
  /** Ids of players who left since the last tick. The others have not been told yet, so nobody gets these. */
  const left = [];
  let unused = 0;
  let sent = 0;
  const send = (player, message) => {
    sent++;
    players.get(player)?.socket.send(JSON.stringify(message));
  };
  const server = new WebSocketServer({ port, maxPayload });
  server.on('connection', (socket) => {
    const id = free.pop() ?? unused++;
    const player = { socket, x: 0, y: 0 };
    players.set(id, player);
    interest.add(id, 0, 0);
    socket.on('message', (data) => {
      const place = placeIn(data);
      if (!place) return socket.close(notUnderstood, 'expected { x, y }');
      Object.assign(player, place);
      interest.move(id, place.x, place.y);
    });
    // Such as a frame that is no WebSocket frame. The socket closes; without a listener the server would end.
    socket.on('error', () => {});
    socket.on('close', () => {
      players.delete(id);
      interest.remove(id);
      left.push(id);
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
      free.push(...left.splice(0));
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

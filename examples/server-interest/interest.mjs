// Interest management: which player sees which, reported only when it changes. With it, a server sends each player the
// few others in sight instead of everybody.
// Every player has two boxes: a body, and the window that it sees. Windows meet only bodies, so a pair means that a
// body is in a window. Players are sent the pairs that began and ended since the last tick.
import { BroadPhase } from 'broadphase';

const bodies = 1;
const windows = 2;
const body = (player) => 2 * player;
const window = (player) => 2 * player + 1;

export class Interest {
  #space = new BroadPhase({ events: true });
  #reach;

  /** How far a player sees to each side, and up and down. */
  constructor(reachX, reachY = reachX) {
    this.#reach = [reachX, reachY];
  }

  /** Players are whole numbers from 0 on; those of players who left may be reused after an update. */
  add(player, x, y) {
    this.move(player, x, y);
    this.#space.setFilter(body(player), bodies, windows).setFilter(window(player), windows, bodies);
  }

  move(player, x, y) {
    const [reachX, reachY] = this.#reach;
    this.#space.set(body(player), x, y, x, y);
    this.#space.set(window(player), x - reachX, y - reachY, x + reachX, y + reachY);
  }

  remove(player) {
    this.#space.delete(body(player));
    this.#space.delete(window(player));
  }

  /** Once per tick: calls `enter(viewer, seen)` and `leave(viewer, seen)` for what has changed since the last. */
  update(enter, leave) {
    const { began, ended } = this.#space.update();
    Interest.#tell(ended, leave);
    Interest.#tell(began, enter);
  }

  /** The players that a player sees, as of the last update. */
  seenBy(player) {
    return this.#space
      .collisionsOf(window(player))
      .map((id) => id >> 1)
      .filter((seen) => seen !== player);
  }

  static #tell(pairs, tell) {
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [pairs[k], pairs[k + 1]];
      // One of the two is a window, whose id is odd. Every player also sees itself.
      const [viewer, seen] = a & 1 ? [a >> 1, b >> 1] : [b >> 1, a >> 1];
      if (viewer !== seen) tell(viewer, seen);
    }
  }
}

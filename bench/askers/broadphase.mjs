// This library: the frame is copied into the kernel's memory, an update finds the pairs too, and the first query
// builds the index. Answers go into arrays that are reused. If boxes move, each update is a full rebuild: they move so
// little here that retained pairs would be cheaper than in a game.
import { BroadPhase } from '../../build/bench/library.mjs';
import { most, reach } from '../harness/queries.mjs';

export const npm = null;
export const dimensions = [2, 3];
export const answers = ['queryBox', 'nearest', 'rayCast'];

export function create({ dimensions, count, still }) {
  const space = new BroadPhase({ dimensions, technique: still ? 'auto' : 'strip-sweep' });
  const ids = { out: [] };
  const ray = { maxDistance: reach, out: { id: 0, distance: 0, normal: [] } };
  const first = [0];
  const none = [];
  const update = (boxes) => {
    space.boxes(count).set(boxes);
    space.update();
  };
  const firstOf = (hit) => {
    if (hit === undefined) return none;
    first[0] = hit.id;
    return first;
  };
  if (dimensions === 3) {
    return {
      update,
      queryBox: (q, at) => space.queryBox(q[at], q[at + 1], q[at + 2], q[at + 3], q[at + 4], q[at + 5], ids),
      nearest: (q, at) => space.nearest(q[at], q[at + 1], q[at + 2], most, ids),
      rayCast: (q, at) => firstOf(space.rayCast(q[at], q[at + 1], q[at + 2], q[at + 3], q[at + 4], q[at + 5], ray)),
    };
  }
  return {
    update,
    queryBox: (q, at) => space.queryBox(q[at], q[at + 1], q[at + 2], q[at + 3], ids),
    nearest: (q, at) => space.nearest(q[at], q[at + 1], most, ids),
    rayCast: (q, at) => firstOf(space.rayCast(q[at], q[at + 1], q[at + 2], q[at + 3], ray)),
  };
}

// What a user saw: a space or a world of broadphase/ro in Vue's `ref` or `reactive` threw "Cannot read private member".
// Vue asks Object.prototype.toString what a value is and leaves alone what it does not know. The frameworks themselves
// are tried in consumers/places.
import { BroadPhase } from 'broadphase';
import { coltech, Entity, World } from 'broadphase/ro';
import { openTrace, record, TraceWriter } from 'broadphase/trace';
import { expect, test } from 'vitest';

const space = new BroadPhase();
const recording = record(space);
space.set(0, 0, 0, 1, 1).update();

test.each([
  ['BroadPhase', space],
  ['Recording', recording],
  ['Trace', openTrace(recording.bytes())],
  ['TraceWriter', new TraceWriter(2)],
  ['World', new World(null)],
  ['Entity', new Entity(0, 0, 1, 1)],
  ['EntityList', new coltech.BruteForce()],
  ['EntityList', new coltech.SpatialGrid(0, 0, 1, 1, 1)],
  ['EntityList', new coltech.BroadPhase()],
])('a %s says that it is no plain object', (name, value) => {
  expect(Object.prototype.toString.call(value)).toBe(`[object ${name}]`);
});

// On a page with a script that adds a function to Object.prototype, nothing worked: even `new BroadPhase()` without any
// options threw 'there is no option "clone"'.
import { BroadPhase, findPairs, findPairsBetween } from 'broadphase';
import { drawSpace, Lines } from 'broadphase/draw';
import { coltech, World } from 'broadphase/ro';
import { Shard, Zones } from 'broadphase/shard';
import { compare, openTrace, record, replay, tune } from 'broadphase/trace';
import { afterEach, beforeEach, expect, test } from 'vitest';

const all = Object.prototype as { clone?: unknown };
beforeEach(() => {
  all.clone = () => {};
});
afterEach(() => {
  delete all.clone;
});

const boxes = [0, 0, 10, 10, 5, 5, 15, 15];

test('spaces, their options, and options of queries', () => {
  const space = new BroadPhase();
  expect([...space.setAll(boxes).update().pairs]).toEqual([0, 1]);
  expect(new BroadPhase({ dimensions: 3, events: true }).dimensions).toBe(3);
  expect(space.queryBox(0, 0, 1, 1, { mask: 1 })).toEqual([0]);
  expect([...space.queryBoxes(boxes, { within: true }).offsets]).toEqual([0, 1, 2]);
  expect([...findPairs(boxes)]).toEqual([0, 1]);
  expect([...findPairs([0, 0, 0, 9, 9, 9, 5, 5, 5, 8, 8, 8], { dimensions: 3 })]).toEqual([0, 1]);
  expect([...findPairsBetween(boxes, boxes)].length).toBe(8);
});

test('what is beside the library', () => {
  const space = new BroadPhase();
  const recording = record(space, {});
  space.setAll(boxes).update();
  const trace = openTrace(recording.bytes(), { salvage: true });
  expect([...replay(trace, { technique: 'auto' }, true)].map(({ pairs }) => pairs)).toEqual([1]);
  expect(compare(trace, { techniques: ['auto'], passes: 1 }).length).toBe(1);
  expect(tune(trace, { techniques: ['auto'], seconds: 0 }).best.technique).toBe('auto');
  expect(new Lines().addPairs(space).points().length).toBe(4);
  expect(() => drawSpace({ getTransform() {} } as never, space, { lineWidth: 0 })).toThrow(
    'drawSpace: lineWidth: got 0',
  );
  expect(new Shard(new Zones({ borders: { x: [5] } }), 0, new BroadPhase({ events: true })).zone).toBe(0);
  expect(new World(null, { coltech: new coltech.BruteForce() }).entities).toEqual([]);
});

test('a mistyped option is still refused, one that has no value is not', () => {
  expect(() => new BroadPhase({ event: true } as never)).toThrow('there is no option "event", did you mean "events"?');
  expect(() => new World(null, { debugs: true } as never)).toThrow('there is no option "debugs"');
  expect(() => new BroadPhase({ clone: 1 } as never)).toThrow('there is no option "clone"');
  expect(() => new World(null, { clone: true } as never)).toThrow('there is no option "clone"');
  expect(new BroadPhase({ event: undefined } as never).size).toBe(0);
});

// What a tester found: a space or zones of another world, mistyped options and numbers in quotes were silent, and the
// answers wrong; other wrong arguments gave the engine's own texts, "Cannot read properties of undefined".
import { BroadPhase } from 'broadphase';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import { record } from 'broadphase/trace';
import { describe, expect, test } from 'vitest';

type Loose = Record<string, (...given: unknown[]) => unknown>;
type Case = [call: () => unknown, kind: ErrorConstructor, message: string];

const zones = new Zones({ borders: { x: [100] } });
const wrapped = new Zones({ borders: { x: [50] }, wrap: [100, 100] });
const space = (wrap?: number[]) => new BroadPhase({ events: true, wrap });
const zonesOf = (options?: unknown) => new Zones(options as never);
const shardOf = (...given: unknown[]) => new (Shard as never as new (...given: unknown[]) => Shard)(...given);
const refuses = (cases: Case[]) =>
  test.each(cases)('%s', (call, kind, message) => {
    expect(call).toThrow(kind);
    expect(call).toThrow(message);
  });

describe('zones refuse', () => {
  refuses([
    [() => zonesOf(), TypeError, 'borders: got undefined, expected an object of arrays'],
    [() => zonesOf(null), TypeError, 'new Zones: got null, expected an object of options'],
    [
      () => zonesOf({ borders: {}, margn: 5 }),
      TypeError,
      'new Zones: there is no option "margn", did you mean "margin"?',
    ],
    [() => zonesOf({ borders: {}, margin: '5' }), TypeError, 'margin: got "5", expected a finite number, 0 or more'],
    [() => zonesOf({ borders: {}, margin: true }), TypeError, 'margin: got true'],
    [() => zonesOf({ borders: {}, margin: Infinity }), RangeError, 'margin: got Infinity'],
    [() => zonesOf({ borders: {}, wrap: 0 }), TypeError, 'wrap: got 0, expected 2 numbers above 0'],
    [() => zonesOf({ borders: {}, wrap: null }), TypeError, 'wrap: got null'],
    [() => zonesOf({ borders: [] }), TypeError, 'borders: got [], expected an object of arrays'],
    [() => zonesOf({ borders: { X: [1] } }), RangeError, 'borders: got "X", expected borders along x, y in 2D'],
    [() => zonesOf({ borders: { x: 5 } }), TypeError, 'borders.x: got 5, expected an array of ascending numbers'],
    [() => zonesOf({ borders: { x: '1' } }), TypeError, 'borders.x: got "1", expected an array'],
    [() => zonesOf({ borders: { x: null } }), TypeError, 'borders.x: got null, expected an array'],
    [() => zonesOf({ borders: { x: ['1'] } }), TypeError, 'borders.x: got ["1"], expected an array'],
    [
      () => zones.ownerOf(undefined as never),
      TypeError,
      'ownerOf: got undefined, expected a box: minX, minY, maxX, maxY',
    ],
    [() => zones.ownerOf([1, 0, 2] as never), RangeError, 'ownerOf: got [1, 0, 2], expected a box'],
    [() => zones.seenBy(['1', 0, 2, 3] as never), TypeError, 'seenBy: got ["1", 0, 2, 3], expected a box'],
    [() => zones.seenBy([9, 0, 2, 3]), RangeError, 'seenBy: got [9, 0, 2, 3], expected a box'],
    [() => zones.reporterOf([0, 0, 1, 1], [0, 0, 0, 1, 1, 1]), RangeError, 'reporterOf: got [0, 0, 0, 1, 1, 1]'],
    [() => (zones as never as Loose).reporterOf([0, 0, 1, 1]), TypeError, 'reporterOf: got undefined'],
    [() => zones.ownerOf(Float64Array.of(0, Number.NaN, 1, 1)), RangeError, 'ownerOf: got [0, NaN, 1, 1]'],
  ]);

  test('nothing that is left undefined, and borders in a typed array are taken', () => {
    expect(zonesOf({ borders: { x: Float64Array.of(1), y: undefined, z: undefined }, wrap: undefined }).count).toBe(2);
    expect(zones.ownerOf(Float32Array.of(100, 0, 120, 1))).toBe(1);
  });
});

describe('a new shard refuses', () => {
  refuses([
    [
      () => new Shard(wrapped, 0, space()),
      RangeError,
      'space.wrap: got undefined, expected [100, 100], as in the zones',
    ],
    [
      () => new Shard(zones, 0, space([100, 100])),
      RangeError,
      'space.wrap: got [100, 100], expected undefined, as in the',
    ],
    [
      () => new Shard(wrapped, 0, space([100, 90])),
      RangeError,
      'space.wrap: got [100, 90], expected [100, 100], as in the',
    ],
    [() => shardOf(zones, '1', space()), TypeError, 'zone: got "1", expected an integer from 0 to 1'],
    [() => shardOf(zones, [1], space()), TypeError, 'zone: got [1], expected'],
    [() => shardOf(zones, 1n, space()), TypeError, 'zone: got 1n, expected'],
    [() => shardOf(zones, 0.5, space()), RangeError, 'zone: got 0.5, expected'],
    [() => shardOf(), TypeError, 'zones: got undefined, expected a Zones'],
    [
      () => shardOf({ count: 2, dimensions: 2 }, 0, space()),
      TypeError,
      'zones: got [object Object], expected a Zones of the same import',
    ],
    [() => shardOf(zones, 0, null), TypeError, 'space: got null, expected a BroadPhase'],
    [() => shardOf(zones, 0, {}), TypeError, 'space: got [object Object], expected a BroadPhase'],
    [() => shardOf(zones, 0, space(), { entred: () => {} }), TypeError, '"entred", did you mean "entered"?'],
    [() => shardOf(zones, 0, space(), { entered: 7 }), TypeError, 'entered: got 7, expected a function'],
    [() => shardOf(zones, 0, space(), null), TypeError, 'new Shard: got null, expected an object of options'],
    [() => shardOf(zones, 0, space(), { state: 0 }), TypeError, 'state: got 0, expected an object { from, to, ids'],
    [
      () => shardOf(zones, 0, space(), { state: delta({ from: 0 }) }),
      RangeError,
      'state.to: got 1, expected 0, this zone',
    ],
    [() => shardOf(zones, 1, space(), { state: delta({}) }), RangeError, 'state.from: got 0, expected 1'],
  ]);

  test('nothing that is left undefined, and fits a space of the same world', () => {
    expect(shardOf(zones, 0, space(), { entered: undefined, state: undefined, entred: undefined }).zone).toBe(0);
    expect(new Shard(wrapped, 1, space([100, 100])).zone).toBe(1);
  });

  test('and a recording of its space goes on', () => {
    const mine = space();
    const recording = record(mine);
    new Shard(zones, 0, mine).set(7, 0, 0, 1, 1).update();
    expect(recording.frames).toBe(1);
  });
});

const delta = (part: object): Delta => ({
  from: 0,
  to: 1,
  ids: Uint32Array.of(7),
  changes: Uint8Array.of(0),
  boxes: Float64Array.of(90, 0, 110, 10),
  ...part,
});
const told = 'expected an object { from, to, ids, changes, boxes }';
const shard = new Shard(zones, 1, space()).set(9, 120, 0, 130, 10).update();
const loose = shard as never as Loose;
const update = (part: object) => () => shard.update([delta(part)]);

describe('a shard refuses', () => {
  refuses([
    [
      () => shard.exchange(new Zones({ borders: { x: [100] }, dimensions: 3 })),
      RangeError,
      'zones.dimensions: got 3, expected 2, as before',
    ],
    [
      () => shard.exchange(new Zones({ borders: { x: [50] }, wrap: [100, 100] })),
      RangeError,
      'zones.wrap: got [100, 100], expected undefined, as before',
    ],
    [() => loose.exchange(null), TypeError, 'exchange: got null, expected a Zones'],
    [() => loose.exchange({ count: 2 }), TypeError, 'exchange: got [object Object], expected a Zones'],
    [() => loose.set(), TypeError, 'set: the id is undefined'],
    [() => loose.set('7', 0, 0, 1, 1), TypeError, 'set: the id is "7"'],
    [() => loose.delete('9'), TypeError, 'delete: the id is "9", expected an integer'],
    [() => loose.delete(), TypeError, 'delete: the id is undefined'],
    [() => loose.owns('9'), TypeError, 'owns: the id is "9"'],
    [() => loose.owns(-1), RangeError, 'owns: the id is -1'],
    [() => loose.sees(9n), TypeError, 'sees: the id is 9n'],
    [() => loose.ids('owned'), TypeError, 'ids: owned: got "owned", expected true or false'],
    [() => loose.resend('0'), TypeError, 'resend: got "0", expected an integer from 0 to 1'],
    [() => loose.resend(2), RangeError, 'resend: got 2, expected an integer from 0 to 1'],
    [() => loose.forget(), TypeError, 'forget: got undefined, expected an integer from 0 to 1'],
    [() => loose.forget(-1), RangeError, 'forget: got -1, expected an integer from 0 to 1'],
    [() => loose.update(5), TypeError, 'update: got 5, expected an array of deltas'],
    [() => loose.update(delta({})), TypeError, 'update: got [object Object], expected an array of deltas'],
    [() => loose.update([5]), TypeError, `update: delta: got 5, ${told}`],
    [() => loose.update([undefined]), TypeError, `update: delta: got undefined, ${told}`],
    [update({ from: 2 }), RangeError, 'update: delta.from: got 2, expected an integer from 0 to 1'],
    [update({ from: '0' }), TypeError, 'update: delta.from: got "0", expected an integer from 0 to 1'],
    [update({ from: 1 }), RangeError, 'update: delta.from: got 1, expected another zone than this one'],
    [update({ to: '1' }), RangeError, 'update: delta.to: got "1", expected 1, this zone'],
    [update({ ids: [7] }), TypeError, 'update: delta.ids: got [7], expected a Uint32Array'],
    [update({ ids: undefined }), TypeError, 'update: delta.ids: got undefined, expected a Uint32Array'],
    [update({ changes: [0] }), TypeError, 'update: delta.changes: got [0], expected a Uint8Array'],
    [
      update({ boxes: [90, 0, 110, 10] }),
      TypeError,
      'update: delta.boxes: got [90, 0, 110, 10], expected a Float64Array',
    ],
  ]);

  test('and is as before', () => {
    expect([shard.space.size, [...shard.ids()], shard.given, shard.taken, shard.owns(9)]).toEqual([
      1,
      [9],
      [],
      [],
      true,
    ]);
    expect(shard.exchange()).toEqual([]);
    expect([...shard.update().pairs]).toEqual([]);
  });

  test('no state while something is still to be told or recorded', () => {
    const left = new Shard(zones, 0, space()).set(1, 90, 0, 110, 10);
    left.exchange();
    left.update().delete(1);
    left.exchange();
    expect(() => left.state()).toThrow('state: box 1 has changed, expected an exchange and an update first');
    left.update().resend(1);
    expect(() => left.state()).toThrow('state: zone 1 waits for everything, expected an exchange first');
    left.exchange();
    expect(left.state().ids.length).toBe(0);
  });
});

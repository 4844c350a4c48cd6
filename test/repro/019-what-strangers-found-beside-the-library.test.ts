// Faults that strangers found in the entry points beside the library: shards, traces, drawing, and the command.
import { BroadPhase } from 'broadphase';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import { record } from 'broadphase/trace';
import { describe, expect, test } from 'vitest';

const events = () => new BroadPhase({ events: true });

describe('a shard', () => {
  const zones = new Zones({ borders: { x: [100] } });
  const alone = new Zones({ borders: {} });

  test('whose entered threw calls it again for the same box, and has missed no event', () => {
    const left = new Shard(zones, 0, events());
    const entered: number[] = [];
    let broken = true;
    const right = new Shard(zones, 1, events(), {
      entered(id) {
        if (id === 2 && broken) throw new Error('not now');
        entered.push(id);
      },
    });
    left.set(1, 80, 0, 90, 10).set(2, 80, 0, 91, 10).set(3, 80, 0, 92, 10).exchange();
    left.update();
    for (const id of [1, 2, 3]) left.set(id, 80, 0, 110, 10);
    right.set(9, 120, 0, 130, 10);
    const deltas = left.exchange();
    expect(() => right.update(deltas)).toThrow('not now');
    expect(() => right.update(deltas)).toThrow('not now');
    broken = false;
    right.update(deltas);
    expect(entered).toEqual([1, 2, 3, 9]);
    expect([...right.began]).toEqual([]);
    left.set(1, 70, 20, 120, 30).set(2, 0, 50, 130, 60);
    right.update(left.exchange());
    expect(entered).toEqual([1, 2, 3, 9]);
    expect([...right.ids()].sort()).toEqual([1, 2, 3, 9]);
  });

  test('whose entered threw can delete the box', () => {
    const shard = new Shard(alone, 0, events(), {
      entered(id) {
        if (id === 1) throw new Error('not this one');
      },
    });
    expect(() => shard.set(1, 0, 0, 1, 1).update()).toThrow('not this one');
    expect(shard.delete(1)).toBe(true);
    shard.set(2, 0, 0, 1, 1).update();
    expect([[...shard.ids()], shard.space.size, [...shard.pairs]]).toEqual([[2], 1, []]);
  });

  test.each<[string, (shard: Shard) => unknown]>([
    ['set', (shard) => shard.set(1, 5, 5, 6, 6)],
    ['delete', (shard) => shard.delete(1)],
    ['exchange', (shard) => shard.exchange()],
    ['update', (shard) => shard.update()],
    ['forget', (shard) => shard.forget(1)],
  ])('cannot be changed by entered: %s', (name, change) => {
    let calls = 0;
    const shard: Shard = new Shard(zones, 0, events(), { entered: () => (calls++ === 0 ? change(shard) : undefined) });
    const message = `${name}: called by entered, expected only after update`;
    expect(() => shard.set(1, 0, 0, 1, 1).update()).toThrow(message);
    shard.set(2, 0, 0, 1, 1).update();
    expect([shard.space.size, [...shard.pairs]]).toEqual([2, [1, 2]]);
  });

  test.each<[string, (shard: Shard) => unknown]>([
    ['set', (shard) => shard.set(1, 5, 5, 6, 6)],
    ['delete', (shard) => shard.delete(1)],
    ['exchange', (shard) => shard.exchange()],
    ['update', (shard) => shard.update()],
    ['forget', (shard) => shard.forget(1)],
  ])('whose space was disposed refuses %s', (_, change) => {
    const shard = new Shard(zones, 0, events());
    shard.space.dispose();
    expect(() => change(shard)).toThrow('this BroadPhase was disposed');
    expect([...shard.ids()]).toEqual([]);
  });

  test.each(['ids', 'changes', 'boxes'] as const)('names the detached %s of a delta', (name) => {
    const [delta] = new Shard(zones, 0, events()).set(1, 120, 0, 130, 10).exchange() as [Delta];
    structuredClone(delta[name].buffer, { transfer: [delta[name].buffer as ArrayBuffer] });
    expect(() => new Shard(zones, 1, events()).update([delta])).toThrow(
      /^update: delta\.\w+: got .*, expected a \w+, not detached$/,
    );
  });
});

test('a disposed space is not recorded, and is in no shard', () => {
  const space = events();
  space.dispose();
  expect(() => record(space)).toThrow('this BroadPhase was disposed');
  expect(() => new Shard(new Zones({ borders: {} }), 0, space)).toThrow('this BroadPhase was disposed');
});

// Snapshots: what comes back is what there was, what follows is what would have followed, and what is no snapshot is
// refused without a trace. SEED=… runs the same sequences again, RUNS=… runs more.
import { BroadPhase, type BroadPhaseOptions } from 'broadphase';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { testEach } from '../support/each-technique.ts';
import { expectSameWords } from '../support/expect-pairs.ts';
import { anyPlace, Modelled } from '../support/model.ts';
import { readTrace } from '../support/recordings.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const numRuns = runs(25);

/** Returns the space where it was updated. */
type Call = (space: BroadPhase<2 | 3>) => unknown;

/** Calls that are the same on whatever space they are made. Every few of them it is updated. */
function randomCalls(count: number, dimensions: 2 | 3, seed: number): Call[] {
  const random = createRandom(seed);
  const integer = (below: number) => Math.floor(random() * below);
  const apart = [0, 0, 1e6, 1e12][integer(4)]!; // of three clusters: wide gaps are taken out of the boxes searched
  const box = () => {
    const cluster = integer(3) * apart;
    const min = Array.from({ length: dimensions }, () => cluster + integer(40) + anyPlace(random));
    return [...min, ...min.map((value) => value + integer(6))];
  };
  const boxes = () => Array.from({ length: integer(120) }, box).flat();
  const id = () => (random() < 0.05 ? 2 ** 24 - 1 - integer(3) : integer(140));
  const bits = () => [0xffffffff, 1, 2, 3, 0, 0x80000000][integer(6)]!;
  return Array.from({ length: count }, (): Call => {
    const chance = random();
    if (chance < 0.45) {
      const [at, given] = [id(), box()];
      return (space) => void setBox(space, at, given);
    }
    if (chance < 0.55) {
      const at = id();
      return (space) => void space.delete(at);
    }
    if (chance < 0.65) {
      const [at, layer, mask] = [id(), bits(), bits()];
      return (space) => void (space.has(at) && space.setFilter(at, layer, mask));
    }
    if (chance < 0.72) {
      const [at, on] = [id(), random() < 0.7];
      return (space) => void (space.has(at) && space.setStatic(at, on));
    }
    if (chance < 0.74) {
      const given = boxes();
      return (space) => void space.setAll(given);
    }
    if (chance < 0.76) {
      const given = Float32Array.from(boxes(), Math.fround);
      return (space) => {
        const to = space.boxes(given.length / 2 / dimensions);
        for (let k = 0; k < given.length; k += 2 * dimensions) {
          for (let a = k; a < k + dimensions; a++) {
            to[a] = Math.min(given[a]!, given[a + dimensions]!);
            to[a + dimensions] = Math.max(given[a]!, given[a + dimensions]!);
          }
        }
      };
    }
    if (chance < 0.78) {
      const name = BroadPhase.techniques[integer(BroadPhase.techniques.length)]!;
      return (space) => {
        space.technique = name;
      };
    }
    if (chance < 0.785) return (space) => void space.clear();
    if (chance < 0.8) {
      return (space) => {
        for (const [at, given] of [...space]) setBox(space, at, Array.from(given, Math.fround));
      };
    }
    if (chance < 0.82) {
      const [at, group, reach, on] = [id(), integer(3), random(), random() < 0.5];
      return (space) => void (space.has(at) && space.setGroup(at, group).setReach(at, reach).setEnabled(at, on));
    }
    return (space) => space.update();
  });
}

/** Makes calls and notes what there is after each update: how many numbers, then these. */
function play(space: BroadPhase<2 | 3>, calls: readonly Call[]): Uint32Array {
  const seen: number[] = [];
  for (const call of calls) {
    if (call(space) !== space) continue;
    for (const list of [space.pairs, space.began, space.ended]) {
      seen.push(list.length);
      for (const word of list) seen.push(word);
    }
  }
  return Uint32Array.from(seen);
}

/**
 * A space that has memory for events of any id. Later, a high id would make memory grow, which detaches the array of
 * `boxes()`: an error if that was not seen by an update yet.
 */
function opened(options: BroadPhaseOptions<2 | 3>): BroadPhase<2 | 3> {
  const space = new BroadPhase<2 | 3>(options);
  setBox(
    space,
    2 ** 24 - 1,
    Array.from({ length: 2 * space.dimensions }, () => 0),
  );
  space.clear();
  return space;
}

describe(`a restored space (SEED=${seed})`, () => {
  testEach('continues like the original: %s in %d dimensions', (technique, dimensions) => {
    const numbers = fc.record({ seed: fc.nat(), before: fc.nat(60), after: fc.nat(40), lost: fc.nat(40) });
    const property = fc.property(numbers, ({ seed, before, after, lost }) => {
      const wrap = seed % 3 ? undefined : Array<number>(dimensions).fill(50);
      const options = { technique, dimensions, events: true, touching: seed % 2 > 0, wrap };
      const [history, future, taken] = [before, after + 1, lost].map((count, k) =>
        randomCalls(count, dimensions, seed + k),
      );
      const [untouched, rolled] = [opened(options), opened(options)];
      play(untouched, history);
      play(rolled, history);
      const saved = rolled.snapshot();
      const boxesAtSave = [...rolled];
      untouched.snapshot(); // from the first one on, pairs come in an order that no update before shows in
      const expected = play(untouched, future);
      expectSameWords(play(rolled, future), expected, 'after a snapshot');

      play(rolled, taken);
      expectSameWords(play(rolled.restore(saved), future), expected, 'rolled back');
      const other = opened(options);
      play(other, taken);
      expectSameWords(play(other.restore(saved).validate(), future), expected, 'from elsewhere');
      expectSameWords(play(opened(options).restore(saved), future), expected, 'a fresh space');
      const [one, same] = [rolled.restore(saved), opened(options).restore(saved)];
      expect([...same]).toEqual([...one]);
      expect(boxesAtSave).toEqual([...same]);
      expect(Buffer.compare(rolled.restore(saved).snapshot(), saved)).toBe(0);
      expect(rolled.size).toBe(opened(options).restore(saved).size);
    });
    fc.assert(property, { seed, numRuns });
  });

  testEach(
    'replays a recorded scene: %s in %d dimensions',
    (technique, dimensions) => {
      const trace = readTrace(dimensions === 2 ? 'smash' : 'rapier3d-freefall10k');
      const options = { technique, dimensions };
      const [space, other] = [new BroadPhase(options), new BroadPhase(options)];
      const frames = Math.min(trace.frames, 6);
      for (let k = 0; k < frames / 2; k++) space.setAll(trace.frame(k)).update();
      other.restore(space.snapshot());
      for (let k = frames / 2; k < frames; k++) {
        const { pairs } = space.setAll(trace.frame(k)).update();
        expect(Buffer.compare(bytesOf(other.setAll(trace.frame(k)).update().pairs), bytesOf(pairs))).toBe(0);
      }
    },
    ['long'],
  );

  test.each([2, 3] as const)('has the boxes, filters and flags of the model, in %d dimensions', (dimensions) => {
    const modelled = new Modelled({ dimensions }, 7);
    const other = new BroadPhase({ dimensions });
    for (let round = 0; round < 40; round++) {
      for (let k = 0; k < 20; k++) modelled.step();
      other.restore(modelled.space.snapshot());
      expect(other.size).toBe(modelled.entries.size);
      for (const [id, { box }] of modelled.entries) expect(Array.from(other.get(id)!)).toEqual(box);
      expect(other.technique).toBe(modelled.space.technique);
      expect(other.update().validate().pairs).toEqual(modelled.space.update().pairs);
    }
  });
});

const bytesOf = (array: Uint32Array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

test('a snapshot has only the parts that differ from the default', () => {
  const space = new BroadPhase({ capacity: 5000 });
  expect(space.snapshot().length).toBe(24);
  space.setAll(new Float32Array(4000)).update();
  expect(space.snapshot().length).toBe(24 + 16_000);
  space.set(3, 0, 0, 0.1, 0.1);
  expect(space.snapshot().length).toBe(24 + 32_000);
  space.set(3, 0, 0, 1, 1).setStatic(3);
  expect(space.snapshot().length).toBe(24 + 17_000);
  space.setFilter(4, 1, 0xffffffff);
  expect(space.snapshot().length).toBe(24 + 21_000);
  space.setFilter(4, 0xffffffff, 0xffffffff).setStatic(3, false).delete(0);
  expect(space.snapshot().length).toBe(24 + 24 * 999 + 4 + 4); // and the order in which boxes came
});

test('pairs and answers are those of the boxes that were restored', () => {
  const space = new BroadPhase().set(1, 0, 0, 2, 2).set(2, 1, 1, 3, 3).update();
  const saved = space.snapshot();
  space.set(3, 2, 2, 4, 4).update();
  expect(space.pairCount).toBe(3);
  expect(space.queryPoint(3.5, 3.5)).toEqual([3]);
  space.restore(saved);
  expect(space.has(3)).toBe(false);
  for (const each of [space, new BroadPhase().restore(saved)]) {
    expect(each.stats.pairs).toBe(1);
    expect(Array.from(each.pairs)).toEqual([1, 2]);
    expect(each.isColliding(2, 3)).toBe(false);
    expect(each.isColliding(2, 1)).toBe(true);
    expect(each.collisionsOf(1)).toEqual([2]);
    expect(each.queryPoint(3.5, 3.5)).toEqual([]);
    expect(each.queryPoint(0.5, 0.5)).toEqual([1]);
  }
  space.update();
  expect(Array.from(space.pairs)).toEqual([1, 2]);
  expect(space.isColliding(2, 3)).toBe(false);
  expect(space.queryPoint(3.5, 3.5)).toEqual([]);
});

describe('events after a restore', () => {
  const events = (space: BroadPhase<2 | 3>) => [Array.from(space.began), Array.from(space.ended)];

  test('are relative to the pairs of the snapshot, and repeat exactly', () => {
    const space = new BroadPhase({ events: true }).set(1, 0, 0, 2, 2).set(2, 1, 1, 3, 3).update();
    const saved = space.snapshot();
    const next = () => space.set(2, 5, 5, 6, 6).set(3, 0, 0, 1, 1).update();
    next();
    expect(events(space)).toEqual([
      [1, 3],
      [1, 2],
    ]);
    space.set(4, 0, 0, 9, 9).update();
    expect(space.isColliding(1, 4)).toBe(true); // asks in between, which must not matter
    space.restore(saved);
    expect(space.isColliding(1, 4)).toBe(false);
    expect(events(space)).toEqual([[1, 2], []]);
    next();
    expect(events(space)).toEqual([
      [1, 3],
      [1, 2],
    ]);
  });

  test('know of boxes that were deleted before the snapshot', () => {
    const space = new BroadPhase({ events: true }).set(1, 0, 0, 2, 2).set(2, 1, 1, 3, 3).set(3, 0, 0, 3, 3).update();
    space.delete(2);
    space.set(2, 1, 1, 3, 3);
    const other = new BroadPhase({ events: true }).set(9, 0, 0, 1, 1).set(8, 0, 0, 1, 1).update();
    other.delete(9);
    other.restore(space.snapshot());
    for (const each of [space, other]) {
      expect(new Set(each.update().began)).toEqual(new Set([1, 2, 3]));
      expect(each.began.length).toBe(4);
      expect(each.ended.length).toBe(4);
      expect(each.pairCount).toBe(3);
    }
  });

  test('all pairs begin if the snapshot has none, and a space without events restores one with pairs', () => {
    const plain = new BroadPhase().set(1, 0, 0, 2, 2).set(2, 1, 1, 3, 3).update();
    const space = new BroadPhase({ events: true }).set(5, 0, 0, 2, 2).set(6, 1, 1, 3, 3).update();
    const saved = space.snapshot();
    expect(events(space.restore(plain.snapshot()).update())).toEqual([[1, 2], []]);
    expect(Array.from(plain.restore(saved).update().pairs)).toEqual([5, 6]);
  });
});

/** The checksum of kernel/space/snapshot.hpp, for forgeries. */
function sealed(bytes: Uint8Array): Uint8Array {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let sum = BigInt(bytes.length);
  for (let at = 0; at < bytes.length; at += 8) {
    sum = BigInt.asUintN(64, (sum ^ (at === 8 ? 0n : view.getBigUint64(at, true))) * 0x9e3779b97f4a7c15n);
    sum ^= sum >> 29n;
  }
  view.setBigUint64(8, sum, true);
  return bytes;
}

describe('bytes that are no snapshot leave the space as it was', () => {
  /** Everything that a snapshot can hold. */
  function full(dimensions: 2 | 3): BroadPhase<2 | 3> {
    const modelled = new Modelled({ dimensions, events: true }, 5);
    for (let id = 0; id < 30; id++) modelled.set(id * 3);
    for (let id = 0; id < 30; id += 4) modelled.filter(id * 3, 1, 3);
    modelled.setStatic(6, true);
    modelled.setEnabled(12, false);
    for (const id of [15, 18]) modelled.setGroup(id, 7);
    modelled.setReach(21, 0.5);
    modelled.space.update();
    modelled.delete(9);
    return modelled.space;
  }
  const refused = (space: BroadPhase<2 | 3>, bytes: unknown, reason: RegExp | string, kind = RangeError) => {
    const before = space.snapshot();
    const restore = () => space.restore(bytes as Uint8Array);
    expect(restore).toThrow(kind);
    expect(restore).toThrow(reason);
    expect(Buffer.compare(space.snapshot(), before)).toBe(0);
    space.validate();
  };

  test.each([2, 3] as const)('any bit that is wrong, in %d dimensions', { tags: 'long' }, (dimensions) => {
    const saved = full(dimensions).snapshot();
    const space = full(dimensions);
    const before = space.set(1000, ...([0, 0, 0.1, 9, 9, 9].slice(0, 2 * dimensions) as [0, 0, 0, 0])).snapshot();
    for (let bit = 0; bit < 8 * saved.length; bit++) {
      saved[bit >> 3]! ^= 1 << (bit & 7);
      expect(() => space.restore(saved), `bit ${bit}`).toThrow(RangeError);
      saved[bit >> 3]! ^= 1 << (bit & 7);
    }
    expect(Buffer.compare(space.validate().snapshot(), before)).toBe(0);
    space.restore(saved).update();
    expect(space.has(1000)).toBe(false);
  });

  test('any bytes in their place', () => {
    const saved = full(2).snapshot();
    const space = full(2);
    const property = fc.property(
      fc.array(fc.tuple(fc.nat(saved.length - 1), fc.nat(255)), { minLength: 1, maxLength: 40 }),
      (changes) => {
        const bytes = saved.slice();
        for (const [at, value] of changes) bytes[at] = value;
        if (Buffer.compare(bytes, saved) !== 0) refused(space, bytes, /^restore: /);
      },
    );
    fc.assert(property, { seed, numRuns: 20 * numRuns });
  });

  test('any bytes with a correct checksum: refused, or a valid space', () => {
    const saved = full(2).snapshot();
    const property = fc.property(
      fc.array(fc.tuple(fc.nat(saved.length - 1), fc.nat(255)), { minLength: 1, maxLength: 4 }),
      fc.constantFrom<('auto' | 'aabb-tree' | 'retained-grid')[]>('auto', 'aabb-tree', 'retained-grid'),
      (changes, technique) => {
        const space = full(2);
        space.technique = technique;
        const before = space.snapshot();
        const bytes = saved.slice();
        for (const [at, value] of changes) bytes[at] = value;
        try {
          space.restore(sealed(bytes));
        } catch (error) {
          expect(error).toBeInstanceOf(RangeError);
          expect(Buffer.compare(space.snapshot(), before)).toBe(0);
        }
        space.validate().update().validate();
        const again = new BroadPhase({ events: true }).restore(space.snapshot()).update();
        expectSameWords(again.pairs, space.pairs, 'from a snapshot of it');
      },
    );
    fc.assert(property, { seed, numRuns: 20 * numRuns });
  });

  test('damaged ones so long that memory grows detach the array of boxes(), but not what was written to it', () => {
    const damaged = new BroadPhase().setAll(new Float32Array(800_000)).snapshot();
    damaged[damaged.length - 1]! ^= 1;
    const space = new BroadPhase();
    space.boxes(2).set([0, 0, 2, 2, 1, 1, 3, 3]);
    expect(() => space.restore(damaged)).toThrow('the snapshot is damaged');
    expect(() => space.update()).toThrow('the array of boxes() was detached');
    expect([...space.boxes(2)]).toEqual([0, 0, 2, 2, 1, 1, 3, 3]);
    expect(space.update().pairCount).toBe(1);
  });

  test('fewer of them, or more', () => {
    const saved = full(3).snapshot();
    const space = full(3);
    for (let length = 0; length < saved.length; length++) {
      refused(
        space,
        saved.subarray(0, length),
        length < 24 ? /are not a snapshot|is not the snapshot's length/ : /is not the snapshot's length/,
      );
    }
    refused(space, Uint8Array.from([...saved, 0, 0, 0, 0, 0, 0, 0, 0]), "which is not the snapshot's length");
    space.restore(saved.buffer);
  });

  test('others', () => {
    const space = full(2);
    const saved = space.snapshot();
    const changed = (at: number, value: number) => sealed(saved.map((byte, k) => (k === at ? value : byte)));
    refused(space, new Uint8Array(), 'got 0 bytes that are not a snapshot');
    refused(space, new TextEncoder().encode('{"boxes": [0, 0, 10, 10]}'.repeat(40)), 'are not a snapshot');
    refused(space, changed(4, 3), 'format 3, expected at most 2: it was made by a newer version');
    refused(space, full(3).snapshot(), 'a space with 3 dimensions, expected 2');
    refused(space, changed(7, 77), 'the technique number 77');
    for (const value of [undefined, null, 'abc', 12, {}, [1, 2, 3]]) {
      refused(space, value, 'expected the bytes of snapshot()', TypeError as never);
    }
  });

  test('more boxes than the bytes can hold, for which no memory is taken', () => {
    const space = full(2);
    space.update();
    const { bytes } = space.stats;
    const forged = space.snapshot();
    new DataView(forged.buffer).setUint32(16, 2 ** 24, true);
    refused(space, sealed(forged), "which is not the snapshot's length");
    new DataView(forged.buffer).setUint32(20, 2 ** 32 - 1, true);
    refused(space, sealed(forged), "which is not the snapshot's length");
    expect(space.update().stats.bytes).toBeLessThan(bytes + 2 ** 16);
  });

  test('forged: boxes that came later than the next one will', () => {
    const space = full(2);
    const ordered = new BroadPhase();
    for (const id of [1, 2, 3]) ordered.set(id, 0, 0, 1, 1);
    ordered.delete(1);
    const [boxes, ids] = [2 * 16, 2 * 4];
    const forge = (at: number, value: number) => {
      const bytes = ordered.snapshot();
      new DataView(bytes.buffer).setUint32(24 + boxes + ids + at, value, true);
      refused(space, sealed(bytes), 'contents that no space can have');
    };
    forge(0, 0); // there is no next one
    forge(0, 2); // the second box came as number 2
    forge(4, 3);
    expect([...new BroadPhase().restore(sealed(ordered.snapshot())).keys()]).toEqual([2, 3]);
  });

  test('forged: as many boxes have come as there are numbers for their order', () => {
    const ordered = new BroadPhase();
    for (const id of [3, 1, 4, 5, 9, 2, 6]) ordered.set(id, 0, 0, 1, 1);
    for (const id of [4, 3]) ordered.delete(id);
    const [boxes, ids] = [ordered.size * 16, ordered.size * 4];
    for (let left = 0; left < 4; left++) {
      const bytes = ordered.snapshot();
      const view = new DataView(bytes.buffer);
      const more = 2 ** 32 - 1 - left - view.getUint32(24 + boxes + ids, true); // as if these had come before
      for (let n = 0; n <= ordered.size; n++) {
        const at = 24 + boxes + ids + 4 * n;
        view.setUint32(at, view.getUint32(at, true) + more, true);
      }
      const space = new BroadPhase().restore(sealed(bytes));
      const model = new Set(ordered.keys());
      for (const id of [7, 3, 8, 0, 5, 6, 4, 1, 7, 10]) {
        if (model.delete(id)) space.delete(id);
        else space.set(id, 0, 0, 1, 1);
        if (space.has(id)) model.add(id);
        expect([...space.keys()], `${left} left, after ${id}`).toEqual([...model]);
      }
      space.validate();
    }
  });

  test('forged: right checksum, wrong content', () => {
    const plain = new BroadPhase().set(5, 0, 0, 1, 1).set(7, 0, 0, 1, 1);
    plain.setStatic(5);
    const space = full(2);
    const forge = (change: (view: DataView) => void) => {
      const bytes = plain.snapshot();
      change(new DataView(bytes.buffer));
      refused(space, sealed(bytes), 'contents that no space can have');
    };
    space.restore(sealed(plain.snapshot()));
    forge((view) => view.setFloat32(24, Number.NaN, true));
    forge((view) => view.setFloat32(24, 2, true)); // above its maximum
    forge((view) => view.setUint32(24 + 32, 7, true)); // twice the same id
    forge((view) => view.setUint32(24 + 32, 2 ** 24, true));
    forge((view) => view.setUint32(24 + 36, 0xffffffff, true));
    forge((view) => view.setUint8(24 + 40, 0x80)); // a bit that no call sets

    const kept = new BroadPhase({ events: true }).set(5, 0, 0, 1, 1).set(7, 0, 0, 1, 1).update();
    for (const pair of [
      [7, 5],
      [5, 5],
      [5, 2 ** 24],
    ] as const) {
      const bytes = kept.snapshot();
      new DataView(bytes.buffer).setUint32(24, pair[0], true);
      new DataView(bytes.buffer).setUint32(28, pair[1], true);
      refused(space, sealed(bytes), 'contents that no space can have');
    }
  });

  test('a bad box written in place cannot be saved', () => {
    const space = new BroadPhase();
    space.boxes(3)[5] = Number.NaN;
    expect(() => space.snapshot()).toThrow('snapshot: minY of box 1 is NaN');
    space.boxes(3)[5] = 0;
    expect(space.restore(space.snapshot()).update().pairCount).toBe(3);
  });
});

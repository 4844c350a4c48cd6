// Where memory ends and where it moves: what does not fit is a RangeError that says so, after which the same object goes
// on with fewer boxes; a view that growing memory has cut off is never written to unnoticed.
import { readFileSync } from 'node:fs';
import { BroadPhase, findPairs, findPairsBetween, init } from 'broadphase';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { describeEach, testEach } from '../support/each-technique.ts';
import { setBox } from '../support/set-box.ts';

const mebibyte = 2 ** 20;
const kernel = readFileSync(new URL('../../build/kernel.wasm', import.meta.url));

/** The kernel, with a limit to its memory, so that running out of it takes milliseconds. */
function kernelWith(bytes: number): Uint8Array<ArrayBuffer> {
  const wasm = Uint8Array.from(kernel);
  const read = (at: number): [value: number, next: number] => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = wasm[at++]!;
      value |= (byte & 127) << shift;
      if (byte < 128) return [value, at];
    }
  };
  const number = (value: number): number[] => (value < 128 ? [value] : [(value & 127) | 128, ...number(value >>> 7)]);
  // After the magic number and the version come sections: a kind, a length, a content. Kind 5 is the memory.
  for (let at = 8; at < wasm.length; ) {
    const kind = wasm[at];
    const [length, content] = read(at + 1);
    if (kind === 5) {
      const [pages] = read(content + 2); // behind the number of memories and the flag that there is no limit
      const limited = [1, 1, ...number(pages), ...number(bytes / 65536)];
      return Uint8Array.from([...wasm.slice(0, at), 5, limited.length, ...limited, ...wasm.slice(content + length)]);
    }
    at = content + length;
  }
  throw new Error('the kernel has no memory of its own');
}

const identical = (count: number, dimensions: number) =>
  Float32Array.from({ length: count * 2 * dimensions }, (_, k) => (k % (2 * dimensions) < dimensions ? 1 : 2));

// Files that run after this one in the same process get the kernel as it is.
afterAll(() => init(kernel));

describeEach('a cell size far too small, %s in %d dimensions', (technique, dimensions) => {
  const space = new BroadPhase({ technique, dimensions, cellSize: 1e-6 });
  const low = Array(dimensions);

  test('takes little memory for few boxes far apart', () => {
    const boxes = [...low.fill(-1e6), ...low.fill(-1e6), ...low.fill(1e6), ...low.fill(1e6)];
    space.setAll(boxes).update();
    expect(space.pairCount).toBe(0);
    expect(space.stats.bytes).toBeLessThan(2 * mebibyte);
  });

  test('takes time for the pairs of large boxes, not for the cells they have in common', () => {
    const count = 1000;
    const boxes = Array.from({ length: count }, (_, k) => [...low.fill(k / count), ...low.fill(1000 + k)]).flat();
    space.setAll(boxes).update();
    const pairs = (count * (count - 1)) / 2;
    expect(space.pairCount).toBe(pairs);
    expect(space.stats.tests).toBeLessThan(200 * pairs);
  });
});

describe('with 32 MiB of memory', () => {
  beforeAll(() => init(kernelWith(32 * mebibyte)));

  test('a search names the call that ran out of memory', () => {
    const boxes = identical(20_000, 2);
    const ownSpace = { technique: 'auto' } as const; // not the spare one, which another kernel may have made
    expect(() => findPairs(boxes, ownSpace)).toThrow(/^findPairs: out of memory/);
    expect(() => findPairsBetween(boxes, boxes, ownSpace)).toThrow(/^findPairsBetween: out of memory/);
  });

  test('boxes that were set are not lost if a query runs out of memory', () => {
    let failures = 0;
    for (const count of [200_000, 270_000, 350_000, 420_000]) {
      const space = new BroadPhase().setAll(Float32Array.from({ length: 4 * count }, (_, k) => (k >> 2) + (k & 2) / 4));
      space.update().queryPoint(0, 0);
      for (let id = 0; id < 300; id++) space.set(id, 0, 0, id, 1.25);
      try {
        space.nearest(0, 0, count);
      } catch (error) {
        expect(String(error)).toMatch(/out of memory|or memory ran out/);
        if (error instanceof RangeError) failures++;
      }
      for (let id = 0; id < 300; id++) expect(Array.from(space.get(id)!)).toEqual([0, 0, id, 1.25]);
      expect(space.validate().size).toBe(count);
      space.dispose();
    }
    expect(failures).toBeGreaterThan(1);
  });

  testEach(
    '%s in %d dimensions recovers from too many pairs',
    (technique, dimensions) => {
      const space = new BroadPhase({ technique, dimensions });
      const count = 20_000;
      for (let round = 0; round < 2; round++) {
        space.setAll(identical(count, dimensions));
        const update = () => space.update();
        expect(update).toThrow(RangeError);
        expect(update).toThrow(/^update: out of memory: \d+ more bytes are needed for 20000 boxes and their pairs/);
        expect(space.size).toBe(count);
        expect(space.pairCount).toBe(0);
        expect(space.pairs.length).toBe(0);
        expect(space.stats.pairs).toBe(0);
        expect(space.structure().length).toBe(0);
        space.validate();
        for (let id = 1000; id < count; id++) space.delete(id);
        expect(space.update().pairCount).toBe((1000 * 999) / 2);
        expect(space.validate().stats.pairs).toBe(space.pairCount);
      }
    },
    ['long'],
  );
});

describe('with 64 MiB of memory', () => {
  beforeAll(() => init(kernelWith(64 * mebibyte)));

  test('boxes that do not fit are refused, and those that were there stay', () => {
    const space = new BroadPhase().set(3, 0, 0, 1, 1).set(5, 1, 1, 2, 2.1).update();
    const check = () => {
      expect(space.size).toBe(2);
      expect(Array.from(space.get(5)!)).toEqual([1, 1, 2, 2.1]);
      expect(Array.from(space.update().validate().pairs)).toEqual([3, 5]);
    };
    const numbers = 64 * mebibyte; // at 4 bytes each or more
    expect(() => space.setAll(new Float32Array(numbers / 4))).toThrow(/^setAll: out of memory/);
    check();
    expect(() => space.setAll(new Float64Array(numbers / 8))).toThrow(/^setAll: out of memory/);
    check();
    expect(() => space.boxes(numbers / 16)).toThrow(/^boxes: out of memory/);
    check();
    expect(() => new BroadPhase({ capacity: 2 ** 24 })).toThrow(/^capacity: out of memory/);
  });

  test('a snapshot whose pairs do not fit leaves its boxes and no pairs', () => {
    const count = 8000;
    const crowd = new BroadPhase({ technique: 'strip-sweep' }).setAll(identical(count, 2)).snapshot();
    const space = new BroadPhase().set(3, 0, 0, 1, 1).set(5, 1, 1, 2, 2.1).update();
    expect(() => space.restore(crowd)).toThrow(/^restore: out of memory/);
    expect([space.size, space.pairCount, space.technique]).toEqual([count, 0, 'strip-sweep']);
    expect(() => space.update()).toThrow(/^update: out of memory/);
    for (let id = 10; id < count; id++) space.delete(id);
    expect(space.set(10, 0, 0, 1, 1).update().validate().pairCount).toBe(55);
  });

  test('a snapshot that does not fit is refused, and what was there stays', () => {
    const space = new BroadPhase({ events: true }).set(3, 0, 0, 1, 1).set(5, 1, 1, 2, 2.1).update();
    const before = space.snapshot();
    const forged = new Uint8Array(24 + 16 * 2 ** 22); // 64 MiB of boxes at the origin, behind a header that says so
    forged.set(before.subarray(0, 24));
    forged[6] = 0;
    new DataView(forged.buffer).setUint32(16, 2 ** 22, true);
    expect(() => space.restore(forged)).toThrow(/^restore: out of memory/);
    expect(Buffer.compare(space.snapshot(), before)).toBe(0);
    expect(Array.from(space.update().validate().pairs)).toEqual([3, 5]);

    // Room for the bytes, but not for the boxes beside them.
    const many = new BroadPhase().setAll(new Float32Array(4 * 1_000_000));
    expect(() => many.snapshot()).not.toThrow();
    expect(() => {
      for (let k = 0; k < 3; k++) many.restore(many.snapshot()).setAll(new Float64Array(4 * 1_000_000));
    }).toThrow(/out of memory/);
    expect(many.validate().size).toBe(1_000_000);
  });

  test.each([2, 3] as const)('boxes are added one by one until memory runs out, in %d dimensions', (dimensions) => {
    const space = new BroadPhase({ dimensions });
    const add = (id: number) =>
      dimensions === 2 ? space.set(id, id, 0, id + 0.1, 1) : space.set(id, id, 0, 0, id + 0.1, 1, 1);
    let count = 0;
    expect(() => {
      for (; ; count++) add(3 * count);
    }).toThrow(/^set: out of memory/);
    expect(count).toBeGreaterThan(100_000);
    expect(space.size).toBe(count);
    expect(space.has(3 * count)).toBe(false);
    space.validate();
    let deleted = 0;
    for (let k = 10; k < count; k++) deleted += Number(space.delete(3 * k));
    expect(deleted).toBe(count - 10);
    add(31);
    add(30);
    expect(space.update().validate().size).toBe(12);
    expect(space.pairCount).toBe(0);
  });
});

// Takes 4 GiB and half a minute, so only where it is asked for: LARGE_MEMORY=1.
describe.runIf(process.env.LARGE_MEMORY)('with all memory that WebAssembly allows', () => {
  beforeAll(() => init(kernel));

  test.each([2, 3] as const)('every id has a box, in %d dimensions', { timeout: 300_000 }, (dimensions) => {
    const count = 2 ** 24;
    const space = new BroadPhase({ dimensions });
    const boxes = space.boxes(count);
    for (let id = 0; id < count; id++) {
      // Rows of 4,096 along the second axis; each touches the next in its row.
      for (let a = 0; a < dimensions; a++) {
        const at = a === 0 ? id % 4096 : a === 1 ? 2 * (id >> 12) : 0;
        boxes[id * 2 * dimensions + a] = at;
        boxes[id * 2 * dimensions + dimensions + a] = at + 1;
      }
    }
    expect(space.update().pairCount).toBe(4096 * 4095);
    expect(space.size).toBe(count);
    expect(space.has(count - 1)).toBe(true);
    expect(() => space.set(count, ...([0, 0, 0, 0] as const))).toThrow(RangeError);
    space.delete(0);
    expect(space.update().pairCount).toBe(4096 * 4095 - 1);
    space.validate();
  });

  test('20,000,000 pairs begin, are found one by one, and end', { timeout: 300_000 }, () => {
    const count = 6400;
    const space = new BroadPhase({ technique: 'brute-force', events: true }).setAll(identical(count, 2)).update();
    const pairs = (count * (count - 1)) / 2;
    expect(pairs).toBeGreaterThan(20_000_000);
    for (const view of [space.pairs, space.began]) expect(view.length).toBe(2 * pairs);
    let sum = 0;
    for (const id of space.pairs) sum += id;
    expect(sum).toBe((count - 1) * ((count * (count - 1)) / 2)); // each id is in a pair with all others
    expect(space.isColliding(17, 6000)).toBe(true);
    expect(space.collisionsOf(5).length).toBe(count - 1);
    space.setAll(identical(2, 2)).update().validate();
    expect(Array.from(space.pairs)).toEqual([0, 1]);
    expect(space.ended.length).toBe(2 * (pairs - 1));
  });

  // Those that retain pairs would need as much memory again.
  const searches = ['hierarchical-grid', 'home-cell-grid', 'quadtree', 'r-tree', 'strip-sweep', 'bsp-tree'] as const;
  test.each(searches)('more than 2 GiB of pairs are counted, with %s', { timeout: 300_000 }, (technique) => {
    const count = 25_000;
    const space = new BroadPhase({ technique }).setAll(identical(count, 2)).update();
    expect(space.pairCount).toBe((count * (count - 1)) / 2);
    space.dispose();
  });

  test('pairs and boxes are found beyond the first 2 GiB', { timeout: 300_000 }, () => {
    const count = 25_000;
    const space = new BroadPhase({ technique: 'brute-force' }).setAll(identical(count, 2)).update();
    expect(space.pairCount).toBe((count * (count - 1)) / 2);
    expect(space.stats.pairs).toBe(space.pairCount);
    const { pairs } = space;
    expect(pairs.byteLength).toBeGreaterThan(2 ** 31);
    const [a, b] = pairs.subarray(-2);
    expect(a).toBeLessThan(b);
    expect(b).toBe(count - 1);
    space.validate();
    space.boxes(100_000).set(identical(100_000, 2)); // stands behind the pairs
    expect(() => space.update()).toThrow(/^update: out of memory: \d+ more bytes are needed for 100000 boxes/);
    space.boxes(1000).set(identical(1000, 2));
    expect(space.update().validate().pairCount).toBe((1000 * 999) / 2);
  });
});

describe('views of memory', () => {
  beforeAll(() => init(kernelWith(1024 * mebibyte)));

  /** Fills boxes so that the pairs of the next update need more memory than there is yet. */
  function crowd(space: BroadPhase<2 | 3>, count = 3000) {
    space.boxes(count).set(identical(count, space.dimensions));
    space.update();
  }

  test('of 20,000,000 pairs and more are views of all of them', { tags: 'long' }, () => {
    const count = 6400;
    const space = new BroadPhase({ technique: 'brute-force' }).setAll(identical(count, 2)).update();
    expect(space.pairCount).toBeGreaterThan(20_000_000);
    expect(space.pairs.length).toBe(count * (count - 1));
    let sum = 0;
    for (const id of space.pairs) sum += id;
    expect(sum).toBe((count - 1) * ((count * (count - 1)) / 2)); // each id is in a pair with all others
    space.setAll(identical(2, 2)).update().validate();
    expect(Array.from(space.pairs)).toEqual([0, 1]);
  });

  test('of boxes stay while memory does not grow', () => {
    const space = new BroadPhase();
    crowd(space, 100);
    const view = space.boxes(100);
    for (let frame = 0; frame < 5; frame++) {
      view.set(identical(100, 2));
      expect(space.update().pairCount).toBe(4950);
      expect(space.boxes(100) === view).toBe(true);
    }
  });

  test.each([2, 3] as const)('of boxes stay when what is found begins to be kept, %i dimensions', (dimensions) => {
    const random = createRandom(3);
    const count = 10_000;
    const width = 2 * dimensions;
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    const space = new BroadPhase({ dimensions });
    const view = space.boxes(count);
    for (let k = 0; k < view.length; k++)
      view[k] = k % width < dimensions ? random() * world : view[k - dimensions]! + 10;
    for (let frame = 0; frame < 150; frame++) {
      expect(space.boxes(count) === view, `frame ${frame}`).toBe(true);
      for (let k = 0; k < view.length; k++) view[k]! += (Math.floor(k / width) % 3) - 1;
      space.update();
    }
    expect(space.stats.reason).toMatch(/are retained/);
  });

  test('of boxes that were cut off are noticed by the next update', () => {
    const space = new BroadPhase();
    const view = space.boxes(3000);
    crowd(space);
    expect(view.length).toBe(0);
    view[0] = 7; // is lost
    expect(() => space.update()).toThrow(/^update: the array of boxes\(\) was detached when memory grew/);
    expect(() => space.update()).toThrow(/call boxes\(count\) again before you write/);
    const again = space.boxes(3000);
    expect(again === view).toBe(false);
    expect(again).toEqual(identical(3000, 2));
    expect(space.update().pairCount).toBe((3000 * 2999) / 2);
  });

  test.each<[string, (space: BroadPhase<2 | 3>) => unknown]>([
    ['set', (space) => space.set(0, 0, 0, 9, 9)],
    ['setAll', (space) => space.setAll(identical(3000, 2))],
    ['delete', (space) => space.delete(0)],
    ['clear', (space) => space.clear()],
    ['restore', (space) => space.restore(new BroadPhase().set(1, 0, 0, 1, 1).snapshot())],
  ])('of boxes are over with %s, so an update after it goes through', (_, change) => {
    const space = new BroadPhase();
    crowd(space);
    change(space);
    space.update().validate();
  });

  test('of pairs are renewed when memory has grown', () => {
    const space = new BroadPhase().setAll([0, 0, 1, 1, 1, 1, 2, 2]).update();
    const { pairs } = space;
    expect(Array.from(pairs)).toEqual([0, 1]);
    crowd(space);
    expect(pairs.length).toBe(0);
    expect(space.pairs.length).toBe(3000 * 2999);
    space.setAll([0, 0, 1, 1, 1, 1, 2, 2]).update();
    expect(Array.from(space.pairs)).toEqual([0, 1]);
    expect(space.stats.pairs).toBe(1);
  });

  // What a game does with its pairs: boxes come and go meanwhile, and queries are asked.
  test.each([2, 3] as const)(
    'of pairs stay while a few boxes are added and queries asked, in %d dimensions',
    { tags: 'long' },
    (dimensions) => {
      const calls: ((space: BroadPhase<2 | 3>, count: number) => unknown)[] = [
        (space, count) => setBox(space, count, Array(2 * dimensions).fill(count)),
        (space, count) => setBox(space, 2 * count + 1, Array(2 * dimensions).fill(0.1)),
        (space, count) => space.setFilter(count - 1, 1, 2),
        (space) => space.isColliding(0, 1),
        (space) => space.collisionsOf(0),
        (space) => (space.queryPoint as (...point: number[]) => number[])(...Array(dimensions).fill(3)),
        (space) => space.delete(0),
      ];
      for (let count = 2; count < 12_000; count += count < 20 ? 1 : Math.ceil(count / 5)) {
        for (const step of [1, 0.1]) {
          const boxes = Array.from({ length: count }, (_, k) =>
            Array.from({ length: 2 * dimensions }, (_, n) => step * (k + Number(n >= dimensions))),
          ).flat();
          for (const first of calls) {
            const space = new BroadPhase({ dimensions, events: true }).setAll(boxes).update();
            const { pairs, began } = space;
            for (const call of [first, ...calls]) call(space, count);
            expect(pairs.length, `${count} boxes`).toBe(2 * space.pairCount);
            expect(began.length).toBe(pairs.length);
          }
        }
      }
    },
  );

  // Deletions are recorded in a bit per id: see events.hpp.
  test.each([
    ['delete', (space: BroadPhase, id: number) => space.delete(id)],
    ['set and delete', (space: BroadPhase) => space.set(2 ** 24 - 7, 0, 0, 1, 1).delete(2 ** 24 - 7)],
    ['clear', (space: BroadPhase) => space.clear()],
  ] as const)('of pairs stay while boxes of high ids are deleted: %s', (_, call) => {
    for (const id of [1, 2 ** 20, 2 ** 22, 2 ** 23, 2 ** 24 - 1]) {
      const space = new BroadPhase({ events: true }).set(0, 0, 0, 1, 1).set(id, 0, 0, 1, 1).update();
      const { pairs, began } = space;
      call(space, id);
      expect(Array.from(pairs), `id ${id}`).toEqual([0, id]);
      expect(Array.from(began)).toEqual([0, id]);
      space.queryPoint(0, 0);
      expect(pairs.length).toBe(2);
    }
  });

  test('a bad box written in place is named by its id, though another was deleted since', () => {
    const space = new BroadPhase();
    const view = space.boxes(3);
    view[2 * 4 + 1] = Number.NaN;
    space.delete(0);
    expect(() => space.update()).toThrow(/^update: minY of box 2 is NaN/);
    space.set(1, 0, 0, 0.1, 0.1).validate();
    expect(() => space.update()).toThrow(/box 2/);
    space.set(2, 0, 0, 1, 1);
    expect(Array.from(space.update().validate().pairs)).toEqual([1, 2]);
  });
});

// `set` in a row: what was set last counts, and whoever reads boxes next finds it, many or few that were set before.
import { BroadPhase, findPairs } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { keysOf } from '../support/reference.ts';
import { setBox } from '../support/set-box.ts';

/** Who may be the first to read a box after it was set. */
const readers: Record<string, (space: BroadPhase<2 | 3>, id: number) => Iterable<number>> = {
  get: (space, id) => space.get(id)!,
  'get after another was deleted': (space, id) => {
    space.delete(id === 0 ? 1 : 0);
    return space.get(id)!;
  },
  'get after a box that float32 cannot hold': (space, id) => {
    setBox(space, 999_999, space.dimensions === 2 ? [0.1, 0, 0.1, 0] : [0.1, 0, 0, 0.1, 0, 0]);
    return space.get(id)!;
  },
  boxes: (space, id) => {
    const width = 2 * space.dimensions;
    return space.boxes(space.size).subarray(id * width, (id + 1) * width);
  },
  'a snapshot': (space, id) => new BroadPhase({ dimensions: space.dimensions }).restore(space.snapshot()).get(id)!,
  'get after an update': (space, id) => space.update().get(id)!,
  'get after setAll was refused': (space, id) => {
    const bad = new Float32Array(2 * space.dimensions * space.size).fill(Number.NaN);
    expect(() => space.setAll(bad)).toThrow('NaN');
    return space.get(id)!;
  },
};

describe.each([2, 3] as const)('in %i dimensions', (dimensions) => {
  const box = (random: () => number) => {
    const low = Array.from({ length: dimensions }, () => Math.floor(random() * 100));
    return [...low, ...low.map((x) => x + Math.floor(random() * 10))];
  };

  test.each(Object.keys(readers))('%s', (name) => {
    const random = createRandom(dimensions);
    for (const count of [2, 63, 64, 65, 200]) {
      const space = new BroadPhase({ dimensions });
      const boxes = Array.from({ length: count }, () => box(random));
      for (const [id, its] of boxes.entries()) setBox(space, id, its);
      space.update();
      for (let k = 0; k < 2 * count; k++) {
        const id = Math.floor(random() * count);
        boxes[id] = box(random);
        setBox(space, id, boxes[id]);
      }
      const last = count - 1;
      for (let k = 0; k < 3; k++) {
        boxes[last] = box(random);
        setBox(space, last, boxes[last]);
      }
      expect([...readers[name]!(space, last)], `of ${count}`).toEqual(boxes[last]);
    }
  });

  test('has and size are right at once, even if boxes wait in the ring', () => {
    const random = createRandom(dimensions);
    for (const first of [0, 1, 4095, 70_000]) {
      const space = new BroadPhase({ dimensions });
      const there = new Map<number, number[]>();
      for (let k = 0; k < 1200; k++) {
        const what = random();
        const id = first + Math.floor(random() * (k < 600 ? k + 1 : 9000));
        if (what < 0.9) {
          there.set(id, box(random));
          setBox(space, id, there.get(id)!);
        } else if (what < 0.97) {
          expect(space.delete(id)).toBe(there.delete(id));
        } else if (what < 0.972) {
          space.clear();
          there.clear();
        } else if (what < 0.98) {
          space.update();
        }
        expect(space.has(id)).toBe(there.has(id));
        expect(space.size).toBe(there.size);
        if (k % 100 === 0) for (const [id, its] of there) expect(space.get(id, [])).toEqual(its);
      }
      space.validate();
    }
  });

  test('boxes that wait in the ring are taken even if memory grows', () => {
    const space = new BroadPhase({ dimensions });
    const point = (x: number) => Array<number>(2 * dimensions).fill(x);
    for (let id = 0; id < 100; id++) setBox(space, id, point(id));
    space.update();
    setBox(space, 3, point(7));
    new BroadPhase({ dimensions }).setAll(new Float32Array(2 * dimensions)).update(); // another space has another ring
    space.setAll(new Float32Array(200_000 * 2 * dimensions)); // takes what waits, then replaces it
    expect(space.get(3, [])).toEqual(point(0));
    setBox(space, 5, point(9));
    const before = space.snapshot();
    expect(() => setBox(space, 6, point(Number.NaN))).toThrow('NaN');
    expect(Buffer.compare(space.snapshot(), before)).toBe(0);
    expect(space.get(5, [])).toEqual(point(9));
  });

  test('the first query sees the last update; cells and invariants include boxes set since', () => {
    const point = (x: number) => Array<number>(dimensions).fill(x);
    const space = new BroadPhase({ dimensions, technique: 'incremental' });
    for (let id = 0; id < 500; id++) setBox(space, id, [...point(id), ...point(id + 1)]);
    space.update();
    setBox(space, 42, [...point(1e4), ...point(1e4 + 1)]);
    expect(Math.max(...space.structure())).toBe(1e4 + 1);
    setBox(space, 42, [...point(-2), ...point(-1)]);
    const nearest = dimensions === 2 ? space.nearest(3e4, 3e4, 1) : space.nearest(3e4, 3e4, 3e4, 1);
    expect(nearest).toEqual([499]);
    setBox(space, 42, [...point(0.1), ...point(0.3)]);
    space.validate();
    setBox(space, 42, [...point(0.2), ...point(0.7)]);
    space.validate();
  });

  test('boxes that are set alternately in place and one by one', () => {
    const random = createRandom(dimensions);
    const space = new BroadPhase({ dimensions });
    const count = 30;
    const width = 2 * dimensions;
    let view = space.boxes(count);
    for (let frame = 0; frame < 20; frame++) {
      const id = Math.floor(random() * count);
      const [first, second, third] = [box(random), box(random), box(random)];
      view.set(first, id * width);
      setBox(space, id, second);
      expect([...view.subarray(id * width, (id + 1) * width)]).toEqual(second);
      view.set(third, id * width);
      space.update();
      expect([...space.get(id)!]).toEqual(third);
      view = space.boxes(count);
      expect(keysOf(space.pairs)).toEqual(keysOf(findPairs(view, { dimensions })));
    }
  });

  test('all boxes are set in each frame, and only those that moved count as changed', () => {
    const random = createRandom(dimensions);
    const space = new BroadPhase({ dimensions });
    const count = 1000;
    const boxes = Array.from({ length: count }, () => box(random));
    const setAllOfThem = () => {
      for (const [id, its] of boxes.entries()) setBox(space, id, its);
    };
    setAllOfThem();
    for (let frame = 0; frame < 260; frame++) {
      if (frame % 3 === 0) boxes[Math.floor(random() * 20)] = box(random);
      setAllOfThem();
      space.update();
      if (frame % 10 === 0) expect(keysOf(space.pairs)).toEqual(keysOf(findPairs(boxes.flat(), { dimensions })));
      if (frame > 200 && frame % 3 !== 0) expect(space.stats.tests, 'nothing has changed').toBe(0);
    }
  });

  test('a box that is moved away and back between two updates keeps its pairs', () => {
    const space = new BroadPhase({ dimensions });
    const here = Array(2 * dimensions).fill(5);
    const there = Array(2 * dimensions).fill(50);
    for (let id = 0; id < 300; id++) setBox(space, id, id < 2 ? here : Array(2 * dimensions).fill(100 + id));
    for (let frame = 0; frame < 200; frame++) space.update();
    for (const [way, pairs] of [
      [[there, here], 1],
      [[there], 0],
      [[here, there], 0],
      [[there, here, there, here], 1],
    ] as const) {
      for (const to of way) setBox(space, 0, to);
      expect(space.update().pairCount).toBe(pairs);
    }
  });
});

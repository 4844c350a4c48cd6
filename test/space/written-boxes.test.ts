// Boxes that come all at once, by `boxes()` or `setAll`, of which few change: the library finds out which by comparing,
// or by looking where it expects them.
// In between come what could mislead it: bad numbers, all changing at once, `set`, doubles, another way of giving them.
import { BroadPhase, findPairs } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { keysOf, pairOf } from '../support/reference.ts';
import { setBox } from '../support/set-box.ts';

const ways = ['boxes', 'floats', 'doubles', 'mixed'] as const;

describe.each([2, 3] as const)('in %i dimensions', (dimensions) => {
  test.each(ways)('what has changed is found, given by %s', (way) => {
    const random = createRandom(dimensions);
    const width = 2 * dimensions;
    const count = 700;
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    const space = new BroadPhase({ dimensions });
    const boxes = new Float64Array(count * width);
    const rounded = (x: number) => (way === 'doubles' ? x : Math.fround(x));
    const place = (id: number) => {
      for (let axis = 0; axis < dimensions; axis++) {
        const low = random() * world;
        const size = 10 * random();
        boxes[id * width + axis] = rounded(low);
        boxes[id * width + dimensions + axis] = rounded(low + size);
      }
    };
    const creep = (id: number, frame: number) => {
      const step = frame % 50 < 25 ? 0.125 : -0.125;
      for (let k = 0; k < width; k++) boxes[id * width + k] = rounded(boxes[id * width + k]! + step);
    };
    for (let id = 0; id < count; id++) place(id);
    let little = 0;
    for (let frame = 0; frame < 260; frame++) {
      const share = frame === 150 ? 1 : frame === 200 ? 0.6 : 0;
      for (let id = 0; id < count; id++) {
        if (random() < share) place(id);
        else if (id % 30 === 0) creep(id, frame);
      }
      const how = way === 'mixed' ? ways[Math.floor(random() * 3)] : way;
      const give = () => {
        if (how === 'boxes') space.boxes(count).set(boxes);
        else space.setAll(how === 'floats' ? new Float32Array(boxes) : boxes);
      };
      if (frame % 20 === 7) {
        const at = Math.floor(random() * count) * width + Math.floor(random() * width);
        const good = boxes[at]!;
        boxes[at] = NaN;
        const bad = () => {
          give();
          space.update();
        };
        expect(bad, `frame ${frame}`).toThrow(String(Math.floor(at / width)));
        if (how === 'boxes') expect(() => space.update(), 'still bad').toThrow(String(Math.floor(at / width)));
        boxes[at] = good;
      }
      give();
      if (frame % 7 === 3) {
        const id = Math.floor(random() * count);
        place(id);
        setBox(space, id, Array.from(boxes.subarray(id * width, (id + 1) * width)));
      }
      space.update();
      const expected = findPairs(way === 'doubles' ? boxes : new Float32Array(boxes), { dimensions });
      expect(keysOf(space.pairs), `frame ${frame}`).toEqual(keysOf(expected));
      if (space.stats.reason.startsWith('candidates are retained')) little++;
      space.validate();
    }
    expect(little, 'updates answered from what is kept').toBeGreaterThan(40);
  });

  test('a bad box among moved boxes with retained structure is found, and nothing is lost', () => {
    const count = 800;
    const width = 2 * dimensions;
    const random = createRandom(dimensions);
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    const space = new BroadPhase({ dimensions });
    const boxes = space.boxes(count);
    for (let id = 0; id < count; id++) {
      for (let axis = 0; axis < dimensions; axis++) {
        boxes[id * width + axis] = random() * world;
        boxes[id * width + dimensions + axis] = boxes[id * width + axis]! + 10;
      }
    }
    let caught = 0;
    for (let frame = 0; frame < 150; frame++) {
      for (let k = 0; k < boxes.length; k++) boxes[k]! += Math.floor(k / width) % 3 === 0 ? 0.03125 : -0.015625;
      const kept = space.stats.reason.includes('are retained');
      if (frame >= 40 && frame % 4 === 0 && kept) {
        const at = width * Math.floor(random() * count) + Math.floor(random() * width);
        const was = boxes[at]!;
        const other = (at % width) + (at % width < dimensions ? dimensions : -dimensions) + at - (at % width);
        // NaN; or inside of where the box may go, with a minimum that is above the maximum.
        boxes[at] = frame % 8 === 0 ? Number.NaN : boxes[other]! + (at % width < dimensions ? 0.25 : -0.25);
        const before = space.pairs.slice();
        expect(() => space.update(), `frame ${frame}`).toThrow(new RegExp(`\\b${Math.floor(at / width)}\\b`));
        expect(space.pairs).toEqual(before);
        boxes[at] = was;
        caught++;
      }
      space.update();
      expect(keysOf(space.pairs), `frame ${frame}`).toEqual(keysOf(findPairs(boxes, { dimensions })));
    }
    expect(caught, 'found while what was found is kept').toBeGreaterThan(15);
  });

  // What is kept knows where it expects each box. One at rest that grows shorter is still where it was, and nobody tells.
  test.each([
    ['boxes', false],
    ['boxes', true],
    ['floats', false],
    ['doubles', false],
  ] as const)(
    'in a world mostly at rest, given by %s, all that is else than expected is seen (static: %s)',
    { tags: 'long' },
    (way, isStatic) => {
      const count = 1203;
      const width = 2 * dimensions;
      const random = createRandom(count);
      const world = 10 * (count / 0.2) ** (1 / dimensions);
      const space = new BroadPhase({ dimensions });
      const boxes = new Float64Array(count * width);
      const give = () => {
        if (way === 'boxes') space.boxes(count).set(boxes);
        else space.setAll(way === 'floats' ? new Float32Array(boxes) : boxes);
      };
      for (let k = 0; k < boxes.length; k++) {
        boxes[k] = k % width < dimensions ? Math.floor(random() * world) : boxes[k - dimensions]! + 10;
      }
      if (way === 'doubles') boxes[0]! -= 2 ** -40;
      give();
      const still = (id: number) => id % 20 !== 0;
      if (isStatic) for (let id = 0; id < count; id++) if (still(id) && id < count / 2) space.setStatic(id);
      const expected = () => {
        const all = keysOf(findPairs(boxes, { dimensions }));
        if (!isStatic) return all;
        return all.filter((key) => pairOf(key).some((id) => !still(id) || id >= count / 2));
      };
      let seen = 0;
      let caught = 0;
      for (let frame = 0; frame < 340; frame++) {
        for (let id = 0; id < count; id += 20) {
          for (let k = id * width; k < (id + 1) * width; k++) boxes[k]! += frame % 80 < 40 ? 0.125 : -0.125;
        }
        const odd = Math.floor(random() * count);
        const at = odd * width + dimensions + (frame % dimensions);
        const was = boxes[at]!;
        const kept = frame > 230 && space.stats.reason.includes('are retained');
        if (kept && frame % 3 === 0) {
          boxes[at] = was - 5;
          seen++;
        } else if (kept && way === 'boxes' && frame % 3 === 1) {
          const other = (odd + 1 + Math.floor(random() * (count - 1))) % count;
          const there = other * width + dimensions;
          const good = boxes[there]!;
          boxes[at] = Number.NaN;
          boxes[there] = boxes[other * width]! - 0.0625;
          give();
          const before = space.pairs.slice();
          for (let again = 0; again < 2; again++) {
            expect(() => space.update(), `frame ${frame}`).toThrow(new RegExp(`\\b${Math.min(odd, other)}\\b`));
          }
          expect(space.pairs).toEqual(before);
          boxes[at] = was;
          boxes[there] = good;
          caught++;
        }
        give();
        space.update();
        if (frame > 200) expect(keysOf(space.pairs), `frame ${frame}`).toEqual(expected());
        boxes[at] = was;
      }
      expect(seen).toBeGreaterThan(20);
      expect(caught).toBeGreaterThan(way === 'boxes' ? 20 : -1);
      for (let frame = 0; frame < 150; frame++) {
        give();
        space.update();
      }
      expect(keysOf(space.pairs)).toEqual(expected());
      if (way !== 'doubles') expect(space.stats.tests, 'all rests').toBe(0);
    },
  );

  test('boxes that are given again as they were cost nothing', () => {
    const random = createRandom(7);
    const count = 2000;
    const boxes = Float32Array.from({ length: count * 2 * dimensions }, (_, k) =>
      k % (2 * dimensions) < dimensions ? random() * 300 : 310,
    );
    const space = new BroadPhase({ dimensions });
    for (const give of [
      () => space.setAll(boxes),
      () => space.boxes(count).set(boxes),
      () => {
        for (let id = 0; id < count; id++) {
          setBox(space, id, Array.from(boxes.subarray(2 * dimensions * id, 2 * dimensions * (id + 1))));
        }
      },
    ]) {
      for (let k = 0; k < 3; k++) {
        give();
        space.update();
      }
      const { pairs } = space.stats;
      expect(space.stats.tests).toBe(0);
      expect(space.stats.reason).toMatch(/^candidates are retained/);
      expect(pairs).toBe(findPairs(boxes, { dimensions }).length / 2);
    }
  });

  // Before the first list, what rests is known by what strip-sweep has found them in.
  test.each([300, 3000])('one of %i boxes written in place that moves at once is seen, and that none does', (count) => {
    const random = createRandom(count);
    const width = 2 * dimensions;
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    for (let trial = 0; trial < 25; trial++) {
      const space = new BroadPhase({ dimensions });
      const boxes = space.boxes(count);
      for (let k = 0; k < boxes.length; k++) {
        boxes[k] = k % width < dimensions ? random() * world : boxes[k - dimensions]! + 10 * random();
      }
      space.update();
      const mover = trial === 0 ? 0 : Math.floor(random() * count);
      const side = mover * width + dimensions + (trial % dimensions);
      const was = boxes[side]!;
      boxes[side] = world;
      space.update();
      expect(keysOf(space.pairs), `${mover} has become longer`).toEqual(keysOf(findPairs(boxes, { dimensions })));
      boxes[side] = was;
      space.update();
      expect(keysOf(space.pairs), `${mover} is as before`).toEqual(keysOf(findPairs(boxes, { dimensions })));
    }
    const resting = new BroadPhase({ dimensions });
    resting.boxes(count).fill(1);
    for (let frame = 0; frame < 4; frame++) {
      resting.boxes(count);
      resting.update();
    }
    expect(resting.stats.tests, 'the fourth update of a world at rest').toBe(0);
  });

  // `boxes()` gives them as float32, rounded to the nearest: those that only nearly touched as doubles do now.
  test.each([1, 3, 400])('doubles are float32 once they are written in place, after %i updates at rest', (updates) => {
    const count = 400;
    const width = 2 * dimensions;
    const doubles = Float64Array.from({ length: count * width }, (_, k) => (k % width < dimensions ? 0 : 5));
    for (let id = 0; id < count; id++) {
      doubles[id * width] = 20 * id;
      doubles[id * width + dimensions] = 20 * id + 5;
    }
    doubles[dimensions] = 10 + 1 / 3;
    doubles[width] = 10 + 1 / 3 + 1e-9;
    const space = new BroadPhase({ dimensions });
    for (let k = 0; k < updates; k++) {
      space.setAll(doubles);
      space.update();
    }
    expect(space.pairCount).toBe(0);
    const boxes = space.boxes(count);
    space.update();
    expect(keysOf(space.pairs)).toEqual(keysOf(findPairs(boxes, { dimensions })));
    expect(space.pairCount).toBe(1);
  });

  test('a single box written in place is where it was written, or is named as bad', () => {
    const space = new BroadPhase({ dimensions, technique: 'incremental' });
    const found = (x: number) =>
      (dimensions === 2 ? space.queryBox(x, 0, x, 0) : space.queryBox(x, 0, 0, x, 0, 0)).length;
    for (const x of [5, 5, 700, 700]) {
      const boxes = space.boxes(1);
      boxes.fill(0);
      boxes[0] = x;
      boxes[dimensions] = x;
      space.update();
      expect([found(5), found(700)]).toEqual([Number(x === 5), Number(x === 700)]);
    }
    space.boxes(1)[0] = Number.NaN;
    expect(() => space.update()).toThrow(/\b0\b/);
  });
});

// Doubles far from the origin were all alike once they were rounded: 30,000 boxes at 1e10 took seconds, then memory.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { keysOf } from '../support/reference.ts';

const count = 3000;

/** Where boxes of size 1 stand, from where they would stand at the origin. */
const places: Record<string, (x: number, id: number) => number> = {
  'at 1e10': (x) => x + 1e10,
  'at 1.7e12, as milliseconds do': (x) => x + 1.7e12,
  'in two clusters 1e12 apart': (x, id) => x + (id % 2) * 1e12,
  'in seven clusters': (x, id) => x - 3e9 + (id % 7) * 1e9,
  'one of a hundred far away': (x, id) => x + (id % 100 === 31 ? 1e11 : 0),
};

function world(dimensions: number, place: (x: number, id: number) => number): Float64Array {
  const random = createRandom(dimensions);
  const size = (count * 2) ** (1 / dimensions);
  const boxes = new Float64Array(count * 2 * dimensions);
  for (let id = 0; id < count; id++) {
    for (let a = 0; a < dimensions; a++) {
      const at = 2 * dimensions * id + a;
      boxes[at] = place(random() * size, id);
      boxes[at + dimensions] = boxes[at]! + 1;
    }
  }
  return boxes;
}

function pairsOf(boxes: Float64Array, dimensions: number) {
  const width = 2 * dimensions;
  const pairs: number[] = [];
  for (let a = 0; a < count; a++) {
    next: for (let b = a + 1; b < count; b++) {
      for (let k = 0; k < dimensions; k++) {
        if (boxes[a * width + k]! > boxes[b * width + k + dimensions]!) continue next;
        if (boxes[b * width + k]! > boxes[a * width + k + dimensions]!) continue next;
      }
      pairs.push(a, b);
    }
  }
  return keysOf(Uint32Array.from(pairs));
}

describe.each([2, 3] as const)('in %i dimensions', (dimensions) => {
  describe.each(Object.keys(places))('%s', (name) => {
    const boxes = world(dimensions, places[name]!);
    const expected = pairsOf(boxes, dimensions);
    test.each(BroadPhase.techniques)('%s finds the pairs among as few candidates', (technique) => {
      const space = new BroadPhase({ dimensions, technique });
      for (let frame = 0; frame < 3; frame++) {
        space.setAll(boxes).update().validate();
        expect(keysOf(space.pairs)).toEqual(expected);
        expect(space.stats.candidates).toBeLessThan(1.2 * expected.length + 10);
      }
    });
  });

  test('a world that jumps, grows and comes back is followed, and its boxes keep their numbers', () => {
    const space = new BroadPhase({ dimensions, technique: 'strip-sweep' });
    for (const name of ['at 1e10', 'in two clusters 1e12 apart', 'at 1.7e12, as milliseconds do', 'at 1e10']) {
      const boxes = world(dimensions, places[name]!);
      const width = 2 * dimensions;
      for (let id = 0; id < count; id++) {
        const box = [...boxes.subarray(id * width, (id + 1) * width)] as [number, number, number, number];
        space.set(id, ...box);
      }
      space.update().validate();
      const expected = pairsOf(boxes, dimensions);
      expect(keysOf(space.pairs)).toEqual(expected);
      expect(space.stats.candidates).toBeLessThan(1.2 * expected.length + 10);
      const least = boxes.filter((_, k) => k % width === 0).reduce((a, b) => Math.min(a, b));
      const cells = space.structure();
      let low = Number.POSITIVE_INFINITY;
      for (let k = 0; k < cells.length; k += width) low = Math.min(low, cells[k]!);
      expect(Math.abs(low - least)).toBeLessThan(1e-6 * Math.abs(least) + 1e-3);
      expect([...space.get(7)!]).toEqual([...boxes.subarray(7 * width, 8 * width)]);
      const point = [...boxes.subarray(7 * width, 7 * width + dimensions)];
      expect((space.queryPoint as (...point: number[]) => number[])(...point)).toContain(7);
    }
  });

  test('from a snapshot on the order of pairs is the same in a space that was elsewhere', () => {
    const one = new BroadPhase({ dimensions });
    one.setAll(world(dimensions, (x) => x + 5e11)).update();
    one.setAll(world(dimensions, places['in two clusters 1e12 apart']!)).update();
    const other = new BroadPhase({ dimensions }).restore(one.snapshot());
    for (const name of ['at 1e10', 'one of a hundred far away', 'in seven clusters']) {
      const boxes = world(dimensions, places[name]!);
      expect(other.setAll(boxes).update().pairs).toEqual(one.setAll(boxes).update().pairs);
    }
  });
});

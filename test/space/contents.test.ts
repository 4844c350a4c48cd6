// What is read back is what was given, in the order of a Map; boxes by their centre. SEED=… runs the same sequences again.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const all = 0xffffffff;

interface Entry {
  box: number[];
  filter: { layer: number; mask: number };
  isStatic: boolean;
}

/** A space and a Map, by the same random calls. */
class Twins {
  space: BroadPhase<2 | 3>;
  map = new Map<number, Entry>();
  readonly #integer: (below: number) => number;
  readonly #random: () => number;

  constructor(dimensions: 2 | 3, seed: number) {
    this.space = new BroadPhase({ dimensions });
    this.#random = createRandom(seed);
    this.#integer = (below) => Math.floor(this.#random() * below);
  }

  #box(): number[] {
    const place = () => this.#integer(50) + (this.#random() < 0.5 ? 0 : 0.1);
    const min = Array.from({ length: this.space.dimensions }, place);
    return [...min, ...min.map((x) => x + this.#integer(9))];
  }

  #set(id: number, box: number[]): void {
    const known = this.map.get(id);
    if (known) known.box = box;
    else this.map.set(id, { box, filter: { layer: all, mask: all }, isStatic: false });
  }

  step(): void {
    const chance = this.#random();
    const id = this.#random() < 0.1 ? 2 ** 24 - 1 - this.#integer(4) : this.#integer(40);
    const known = this.map.get(id);
    if (chance < 0.5) {
      const box = this.#box();
      setBox(this.space, id, box);
      this.#set(id, box);
    } else if (chance < 0.8) expect(this.space.delete(id)).toBe(this.map.delete(id));
    else if (chance < 0.88 && known) {
      known.filter = { layer: this.#integer(9), mask: this.#integer(2 ** 32) };
      this.space.setFilter(id, known.filter.layer, known.filter.mask);
    } else if (chance < 0.94 && known) {
      known.isStatic = this.#random() < 0.6;
      this.space.setStatic(id, known.isStatic);
    } else if (chance < 0.96) this.#replace();
    else if (chance < 0.98) {
      const fresh = new BroadPhase({ dimensions: this.space.dimensions });
      this.space = fresh.restore(this.space.snapshot());
    } else if (chance < 0.985) {
      this.space.clear();
      this.map.clear();
    }
  }

  #replace(): void {
    const boxes = Array.from({ length: this.#integer(30) }, () => this.#box());
    this.space.setAll(boxes.flat());
    const before = new Map(this.map);
    this.map.clear();
    for (const [id, box] of boxes.entries()) {
      const known = before.get(id);
      if (known) this.map.set(id, known);
      this.#set(id, box);
    }
  }

  compare(): void {
    const { space, map } = this;
    expect([...space.keys()]).toEqual([...map.keys()]);
    expect(Array.from(space, ([id, box]) => [id, [...box]])).toEqual(Array.from(map, ([id, { box }]) => [id, box]));
    for (const id of [...map.keys(), 41, 2 ** 23]) {
      expect(space.filterOf(id)).toEqual(map.get(id)?.filter);
      expect(space.isStatic(id)).toBe(map.get(id)?.isStatic ?? false);
    }
    space.validate();
  }
}

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  test(`reads back what a Map does, seed ${seed}`, () => {
    for (let run = 0; run < runs(20); run++) {
      const twins = new Twins(dimensions, seed + run);
      for (let call = 0; call < 400; call++) {
        twins.step();
        if (call % 5 === 0) twins.compare();
        if (call % 40 === 0) twins.space.update();
      }
    }
  });

  test('a restored space continues like the original, in the same order', () => {
    const flat = Array.from({ length: 2 * dimensions }, () => 1);
    const space = new BroadPhase({ dimensions });
    for (const id of [9, 3, 7, 5, 100]) setBox(space, id, flat);
    space.delete(9);
    space.delete(100);
    const other = new BroadPhase({ dimensions }).restore(space.snapshot());
    for (const each of [space, other]) {
      setBox(each, 9, flat);
      each.delete(3);
      expect([...each.keys()]).toEqual([7, 5, 9]);
    }
    expect(other.snapshot()).toEqual(space.snapshot());
  });

  test('boxes by centre and half size are those of the sums', () => {
    const space = new BroadPhase({ dimensions });
    const call =
      (...given: unknown[]) =>
      () =>
        (space.setCentred as (...given: unknown[]) => unknown).call(space, ...given);
    const [centre, half] = [[0.1, 5, -7].slice(0, dimensions), [0.2, 3, Infinity].slice(0, dimensions)];
    expect(call(3, ...centre, ...half)()).toBe(space);
    const [min, max] = [centre.map((x, axis) => x - half[axis]!), centre.map((x, axis) => x + half[axis]!)];
    expect([...space.get(3)!]).toEqual([...min, ...max]);
    for (const bad of [-1, Number.NaN]) {
      expect(call(4, ...centre, ...half.with(1, bad))).toThrow(`setCentred: halfHeight of box 4: got ${bad}`);
    }
    expect(call(4, ...centre.with(0, Infinity), ...half)).toThrow(
      'setCentred: x of box 4: got Infinity, expected a finite',
    );
    expect(call(4, ...centre, ...half.slice(1))).toThrow(`setCentred: got ${2 * dimensions} arguments for box 4`);
    expect(call(-4, ...centre, ...half)).toThrow('setCentred: the id is -4');
    expect(call(4, ...centre.with(1, '5' as never), ...half)).toThrow(TypeError);
    expect([...space.keys()]).toEqual([3]);
  });
});

test('boxes may be deleted and added while keys are walked, and ids have to be ids', () => {
  const space = new BroadPhase().setAll([0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1]);
  const seen: number[] = [];
  for (const id of space.keys()) {
    seen.push(id);
    space.delete(1);
    space.set(id + 10, 0, 0, 1, 1);
  }
  expect(seen).toEqual([0, 2]);
  for (const bad of [-1, 0.5, 2 ** 24]) {
    expect(() => space.filterOf(bad)).toThrow(`filterOf: the id is ${bad}`);
    expect(() => space.isStatic(bad)).toThrow(`isStatic: the id is ${bad}`);
  }
});

test('a loop over pairs sees those at its start, whatever changes meanwhile', () => {
  const space = new BroadPhase().setAll(Array.from({ length: 4 }, () => [0, 0, 1, 1]).flat()).update();
  const seen: number[][] = [];
  for (const pair of space.eachPair()) {
    seen.push(pair);
    space.delete(pair[0]);
    space.update();
  }
  expect(seen.sort()).toEqual([
    [0, 1],
    [0, 2],
    [0, 3],
    [1, 2],
    [1, 3],
    [2, 3],
  ]);
});

// Random sequences of calls against a model, a plain Map: whatever is done, a space holds what the model holds, its
// pairs are the reference's, and a second space that gets the same calls gives the same pairs in the same order.
// The seed is in the name of the suite and in the report of a failure; SEED=… runs it again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { describe, expect } from 'vitest';
import { testEach } from '../support/each-technique.ts';
import { expectKeys, expectSameWords } from '../support/expect-pairs.ts';
import { referencePairs } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const numRuns = runs(30);

type Model = Map<number, number[]>;

interface Call {
  /** Does it to the spaces and to the model. */
  run(spaces: readonly BroadPhase<2 | 3>[], model: Model, check: () => void): void;
  toString(): string;
}

/** Few ids, so that calls meet; some far ones. */
const anId = fc.oneof(
  { weight: 9, arbitrary: fc.nat(30) },
  { weight: 1, arbitrary: fc.constantFrom(1000, 65_535, 65_536, 1_000_000, 2 ** 24 - 1) },
);

/** Small whole numbers mostly, so that boxes touch; then fractions no float holds, and the extremes. */
const aPlace = fc.oneof(
  { weight: 12, arbitrary: fc.integer({ min: -10, max: 10 }) },
  { weight: 4, arbitrary: fc.integer({ min: -40, max: 40 }).map((tenths) => tenths / 10) },
  { weight: 2, arbitrary: fc.integer({ min: -5, max: 5 }).map((steps) => 1 + steps * 1e-12) },
  {
    weight: 2,
    arbitrary: fc.constantFrom(-Infinity, Infinity, -0, 1e9, -1e9, 1e-30, -1e-30, 5e-324, 1e-45, 1e39, -1e300),
  },
  { weight: 1, arbitrary: fc.double({ noNaN: true }) },
  { weight: 1, arbitrary: fc.float({ noNaN: true }) },
);

const aBox = (dimensions: number, place: fc.Arbitrary<number> = aPlace): fc.Arbitrary<number[]> =>
  fc
    .array(fc.tuple(place, place), { minLength: dimensions, maxLength: dimensions })
    .map((extents) => [...extents.map(([a, b]) => Math.min(a, b)), ...extents.map(([a, b]) => Math.max(a, b))]);

const call = (name: string, run: Call['run']): Call => ({ run, toString: () => name });

function aCall(dimensions: 2 | 3): fc.Arbitrary<Call> {
  const replace = (model: Model, boxes: readonly number[][]) => {
    model.clear();
    boxes.forEach((box, id) => {
      model.set(id, box);
    });
  };
  const someBoxes = fc.array(aBox(dimensions), { maxLength: 25 });
  const someFloats = fc.array(aBox(dimensions, aPlace.map(Math.fround)), { maxLength: 25 });

  return fc.oneof(
    {
      weight: 12,
      arbitrary: fc.tuple(anId, aBox(dimensions)).map(([id, box]) =>
        call(`set(${id}, ${box.join(', ')})`, (spaces, model) => {
          for (const space of spaces) expect(setBox(space, id, box)).toBe(space);
          model.set(id, box);
        }),
      ),
    },
    {
      weight: 4,
      arbitrary: anId.map((id) =>
        call(`delete(${id})`, (spaces, model) => {
          const had = model.delete(id);
          for (const space of spaces) expect(space.delete(id)).toBe(had);
        }),
      ),
    },
    { weight: 5, arbitrary: fc.constant(call('update()', (_spaces, _model, check) => check())) },
    {
      weight: 1,
      arbitrary: fc.constant(
        call('clear()', (spaces, model) => {
          for (const space of spaces) space.clear();
          model.clear();
        }),
      ),
    },
    {
      weight: 1,
      arbitrary: fc.tuple(someBoxes, fc.boolean()).map(([boxes, typed]) =>
        call(`setAll(${typed ? 'Float64Array ' : ''}[${boxes.flat().join(', ')}])`, (spaces, model) => {
          const flat = boxes.flat();
          for (const space of spaces) expect(space.setAll(typed ? Float64Array.from(flat) : flat)).toBe(space);
          replace(model, boxes);
        }),
      ),
    },
    {
      weight: 1,
      arbitrary: fc.tuple(someFloats, fc.boolean()).map(([boxes, shared]) =>
        call(`${shared ? 'boxes' : 'setAll'}(Float32Array [${boxes.flat().join(', ')}])`, (spaces, model) => {
          const flat = Float32Array.from(boxes.flat());
          for (const space of spaces) {
            if (shared) space.boxes(boxes.length).set(flat);
            else space.setAll(flat);
          }
          replace(model, boxes);
        }),
      ),
    },
    {
      weight: 1,
      arbitrary: fc.constantFrom(...BroadPhase.techniques).map((technique) =>
        call(`technique = '${technique}'`, (spaces) => {
          for (const space of spaces) space.technique = technique;
        }),
      ),
    },
    {
      weight: 1,
      arbitrary: anId.map((id) =>
        call(`set(${id}, NaN …)`, (spaces) => {
          for (const space of spaces) expect(() => setBox(space, id, Array(2 * dimensions).fill(Number.NaN))).toThrow();
        }),
      ),
    },
  );
}

/** Whether a space gives a box back as it was given, minus zero included. */
function holds(space: BroadPhase<2 | 3>, id: number, box: readonly number[]): boolean {
  const held = space.get(id);
  return held !== undefined && box.every((value, k) => Object.is(held[k], value));
}

describe(`any sequence of calls (SEED=${seed})`, () => {
  testEach('keeps %s in %d dimensions true to the model', (technique, dimensions) => {
    const sequence = fc.array(aCall(dimensions), { minLength: 1, maxLength: 60, size: 'max' });
    const property = fc.property(sequence, (calls) => {
      const spaces = [0, 1].map(() => new BroadPhase({ technique, dimensions }));
      const model: Model = new Map();
      const check = () => {
        const ids = [...model.keys()];
        const [space, twin] = spaces.map((each) => each.update());
        expect(space.size).toBe(model.size);
        expect(ids.filter((id) => !holds(space, id, model.get(id)!))).toEqual([]);
        expectKeys(space, referencePairs([...model.values()].flat(), dimensions, ids));
        expectSameWords(twin.pairs, space.pairs, 'the twin');
        space.validate();
      };
      for (const each of calls) each.run(spaces, model, check);
      check();
    });
    fc.assert(property, { seed, numRuns });
  });
});

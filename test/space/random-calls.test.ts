// Every method in any order, bad arguments mixed in, against a model: fast-check makes up the calls and makes those that
// fail fewer. The model is a Map of what each box was given, and what the last update saw. A second mixture of calls has
// another space beside it, a recording of all updates, and visitors that change boxes.
// The seed stands in the name of the suite and in the report of a failure: SEED=… runs it again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import { record } from 'broadphase/trace';
import fc from 'fast-check';
import { describe, test } from 'vitest';
import { runs, seed } from '../support/runs.ts';
import { badChanges, badQueries } from './random-calls/bad-calls.ts';
import { changes, rules, saves } from './random-calls/changes.ts';
import type { Model, RandomCall } from './random-calls/model.ts';
import { others } from './random-calls/others.ts';
import { manyQueries, queries } from './random-calls/queries.ts';

const numRuns = runs(150);
type Source = (dimensions: 2 | 3) => RandomCall[];
const mixtures: [string, Source[]][] = [
  ['bad ones too', [changes, rules, queries, manyQueries, saves, badChanges, badQueries]],
  ['with another space, a recording and visitors', [changes, rules, rules, saves, others, others]],
];

describe.each(mixtures)(`every method in any order, %s (SEED=${seed})`, (_, sources) => {
  test.each([2, 3] as const)('keeps a space true to the model, in %d dimensions', (dimensions) => {
    const technique = fc.constantFrom(...BroadPhase.techniques);
    const calls = fc.commands(
      sources.flatMap((calls) => calls(dimensions)),
      { maxCommands: 100, size: 'max' },
    );
    // What queries find there has tests of its own.
    const wraps = sources.includes(queries) ? [undefined] : [undefined, [10, 7, 4].slice(0, dimensions)];
    const world = fc.record({ touching: fc.boolean(), wrap: fc.constantFrom(...wraps) });
    const property = fc.property(technique, world, calls, (technique, world, calls) => {
      const setup = () => {
        const options = { dimensions, ...world };
        const real = new BroadPhase({ ...options, technique, events: true });
        const model: Model = {
          world,
          entries: new Map(),
          gone: new Set(),
          shown: new Set(),
          before: new Set(),
          began: [],
          ended: [],
          seen: new Map(),
          view: undefined,
          other: { space: new BroadPhase(options), entries: new Map(), seen: new Map() },
          recording: sources.includes(others) ? record(real) : undefined,
          frames: [],
        };
        return { model, real };
      };
      fc.modelRun(setup, calls);
    });
    fc.assert(property, { seed, numRuns });
  });
});

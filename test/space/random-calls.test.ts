// Every method in any order, bad arguments mixed in, against a model: fast-check makes up the calls and makes those that
// fail fewer. The model is a Map of what each box was given, and what the last update saw.
// The seed stands in the name of the suite and in the report of a failure: SEED=… runs it again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { describe, test } from 'vitest';
import { runs, seed } from '../support/runs.ts';
import { badChanges, badQueries } from './random-calls/bad-calls.ts';
import { changes, rules, saves } from './random-calls/changes.ts';
import type { Model } from './random-calls/model.ts';
import { manyQueries, queries } from './random-calls/queries.ts';

const numRuns = runs(150);
const sources = [changes, rules, queries, manyQueries, saves, badChanges, badQueries];

describe(`every method in any order (SEED=${seed})`, () => {
  test.each([2, 3] as const)('keeps a space true to the model, in %d dimensions', (dimensions) => {
    const technique = fc.constantFrom(...BroadPhase.techniques);
    const calls = fc.commands(
      sources.flatMap((calls) => calls(dimensions)),
      { maxCommands: 100, size: 'max' },
    );
    const property = fc.property(technique, calls, (technique, calls) => {
      const setup = () => ({
        model: {
          entries: new Map(),
          gone: new Set<number>(),
          shown: new Set<number>(),
          before: new Set<number>(),
          began: [],
          ended: [],
          seen: new Map(),
          view: undefined,
        } as Model,
        real: new BroadPhase({ dimensions, technique, events: true }),
      });
      fc.modelRun(setup, calls);
    });
    fc.assert(property, { seed, numRuns });
  });
});

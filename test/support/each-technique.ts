// Every technique, in 2D and 3D. `npm test` tests all of them. `npm run check` tests three, and one more that the seed
// chooses; the tests of the others are tagged as long.
import { format } from 'node:util';
import { BroadPhase, type TechniqueName } from 'broadphase';
import { describe, test } from 'vitest';
import { seed } from './runs.ts';

type Body = (technique: TechniqueName, dimensions: 2 | 3) => void;
type Declare = (name: string, options: { tags: string[] }, body: () => void) => void;

const chosen: readonly TechniqueName[] = ['auto', 'strip-sweep', 'incremental'];
const others = BroadPhase.techniques.filter((technique) => !chosen.includes(technique));
const short = [...chosen, others[seed % others.length]];

function declareEach(declare: Declare, name: string, tags: string[], body: Body): void {
  for (const technique of BroadPhase.techniques) {
    for (const dimensions of [2, 3] as const) {
      declare(format(name, technique, dimensions), { tags: short.includes(technique) ? tags : ['long'] }, () =>
        body(technique, dimensions),
      );
    }
  }
}

/** Declares a suite for each technique and dimension. `name` has %s for the technique and %d for the dimension. */
export const describeEach = (name: string, body: Body): void =>
  declareEach((title, options, suite) => describe(title, options, suite), name, [], body);

/** The same for a test. */
export const testEach = (name: string, body: Body, tags: string[] = []): void =>
  declareEach((title, options, run) => test(title, options, run), name, tags, body);

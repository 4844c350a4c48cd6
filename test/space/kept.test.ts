// Where a list of candidates is worth keeping, and where it must not be made: `auto` on scenes and motions that were once
// judged wrongly. What it costs is counted in tests and bytes, not in time.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';
import { createMotion } from '../../bench/motions/index.ts';
import { createScene } from '../../src/scenes/index.ts';
import { keysOf } from '../support/reference.ts';

const isKept = ({ stats }: { stats: { reason: string } }) => stats.reason.includes('are retained');

test('where boxes are long along different axes, no list has many times as many candidates as pairs', () => {
  const count = 10_000;
  const scene = createScene('skewed3d', count);
  const space = new BroadPhase({ dimensions: 3 });
  for (let frame = 0; frame < 80; frame++) {
    scene.step();
    space.setAll(scene.boxes).update();
    const { tests, pairs, bytes } = space.stats;
    if (isKept(space)) expect(tests / pairs, `candidates a pair in frame ${frame}`).toBeLessThan(8);
    expect(bytes / count, `bytes a box in frame ${frame}`).toBeLessThan(1500);
  }
});

test.each([
  ['circles', 3],
  ['patrols', 2],
  ['patrols', 3],
  ['groups', 3],
  ['units', 3],
] as const)('%s in %iD are kept, though all that move might leave their regions at once', (name, dimensions) => {
  const motion = createMotion(name, dimensions, 3000);
  const [kept, fresh] = (['auto', 'strip-sweep'] as const).map(
    (technique) => new BroadPhase({ dimensions, technique }),
  );
  let [answered, tests, spent] = [0, 0, 0];
  for (let frame = 1; frame <= 250; frame++) {
    motion.step(frame);
    for (const space of [kept!, fresh!]) space.setAll(motion.boxes).update();
    if (frame % 10 === 0) expect(keysOf(kept!.pairs), `frame ${frame}`).toEqual(keysOf(fresh!.pairs));
    if (frame <= 50) continue;
    answered += Number(isKept(kept!));
    tests += kept!.stats.tests;
    spent += fresh!.stats.tests;
  }
  expect(answered, 'updates of 200 answered from what is kept').toBeGreaterThan(180);
  expect(tests / spent, 'tests, as a share of those of full rebuilds').toBeLessThan(0.3);
});

test.each([1, 2, 3, 4])('sand that falls and comes to rest is kept, seed %i', (seed) => {
  // All fall alike for a long time, then more and more lie still. Lists planned from how far boxes got before that fail
  // at once.
  const motion = createMotion('sand', 2, 1000, seed);
  const space = new BroadPhase();
  let answered = 0;
  for (let frame = 1; frame <= 500; frame++) {
    motion.step(frame);
    space.setAll(motion.boxes).update();
    answered += Number(isKept(space));
  }
  expect(answered, 'updates of 500 answered from what is kept').toBeGreaterThan(390);
});

// Where a list of candidates is worth keeping, and where it must not be made: `auto` on scenes and motions that were once
// judged wrongly. What it costs is counted in tests and bytes, not in time.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';
import { createMotion } from '../../bench/motions/index.ts';
import { createScene } from '../../src/scenes/index.ts';
import { createRandom } from '../../src/scenes/random.ts';
import { expectSamePairs } from '../support/expect-pairs.ts';

/** Sets a box of side 10 by its minima, in 2D or 3D. */
const setCube = (space: BroadPhase<2 | 3>, id: number, low: readonly number[]) =>
  space.set(id, ...([...low, ...low.map((x) => x + 10)] as [number, number, number, number]));

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
    if (frame % 10 === 0) expectSamePairs(kept!.pairs, fresh!.pairs, `frame ${frame}`);
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

test.each([
  [2, 1 / 100],
  [3, 1 / 100],
  [3, 1 / 33],
] as const)('in %iD, a list lives long where a share of %d of the boxes moves in turn', (dimensions, share) => {
  // If boxes at rest had no margin, they would leave their regions one after another, and lists would end soon.
  const count = 1000;
  const random = createRandom(7);
  const world = 10 * (4 * count) ** (1 / dimensions);
  const at = Float64Array.from({ length: count * dimensions }, () => random() * world);
  const space = new BroadPhase<2 | 3>({ dimensions });
  let [lists, before] = [0, 0];
  for (let frame = 0, next = 0; frame < 400; frame++) {
    for (let moved = frame ? count * share : count; moved > 0; moved--, next++) {
      const from = (next % count) * dimensions;
      for (let k = from; frame && k < from + dimensions; k++) at[k]! += random() - 0.5;
      const low = [...at.subarray(from, from + dimensions)];
      setCube(space, next % count, low);
    }
    const { tests } = space.update().stats;
    // While a list lives, candidates are added to it.
    if (frame > 100) lists += Number(tests < 0.9 * before);
    before = tests;
  }
  expect(lists, 'lists made in 300 updates').toBeLessThan(5);
});

test.each([
  [2, 10, 8],
  [2, 5, 5],
  [3, 10, 8],
  [3, 4, 2],
] as const)(
  'in %iD, boxes that sway together by steps of %d, and jitter by %d, are not measured all the time',
  (dimensions, step, jitter) => {
    // They are back where they were every 12 updates. So at one measurement their motion is common, at the next it is not,
    // and all that is known is out of date each time.
    const count = 2000;
    const random = createRandom(3);
    const world = 10 * (4 * count) ** (1 / dimensions);
    const home = Float64Array.from({ length: count * dimensions }, () => random() * world);
    const space = new BroadPhase<2 | 3>({ dimensions });
    let observed = 0;
    for (let frame = 0; frame < 300; frame++) {
      const sway = step * Math.abs(((frame + 6) % 12) - 6);
      for (let id = 0; id < count; id++) {
        const from = id * dimensions;
        const low = [...home.subarray(from, from + dimensions)].map((x) => x + sway + (2 * random() - 1) * jitter);
        setCube(space, id, low);
      }
      observed += Number(space.update().stats.reason.includes('observed'));
    }
    expect(observed, 'updates of 300 in which motion was measured, without a list').toBeLessThan(60);
  },
);

test.each([
  [2, 0.06, 2, 0, 30, 22],
  [3, 0.07, 2, 0, 12, 21],
  [2, 0.12, 1, 0.01, 4, 21],
] as const)(
  'in %iD, lists pay where a share of %d of the boxes moves by up to %d sizes, and the others by up to %d',
  (dimensions, share, fast, slow, room, seed) => {
    // Late boxes must not count as more than they cost; nor may a long time count as cheap because distances beyond a few
    // sizes were not told apart.
    const count = 3000;
    const random = createRandom(seed);
    const world = 10 * (room * count) ** (1 / dimensions);
    const at = Float64Array.from({ length: count * dimensions }, () => random() * world);
    const speeds = Float64Array.from({ length: count }, () => 10 * (random() < share ? fast : slow));
    const by = Float64Array.from(at, (_, k) => (2 * random() - 1) * speeds[Math.floor(k / dimensions)]!);
    const space = new BroadPhase<2 | 3>({ dimensions });
    let kept = 0;
    for (let frame = 0; frame < 300; frame++) {
      for (let id = 0; id < count; id++) {
        if (frame > 0 && speeds[id] === 0) continue;
        for (let k = id * dimensions; k < (id + 1) * dimensions; k++) {
          at[k]! += by[k]!;
          if (at[k]! < 0 || at[k]! > world) by[k]! *= -1;
        }
        const low = [...at.subarray(id * dimensions, (id + 1) * dimensions)];
        setCube(space, id, low);
      }
      kept += Number(isKept(space.update()) && frame >= 50);
    }
    expect(kept, 'updates of 250 answered from what is kept').toBeGreaterThan(220);
  },
);

test.each([
  [2, 'no rules', 0],
  [3, 'no rules', 0],
  [2, 'one group', 0],
  [3, 'one group', 0],
  [2, 'no rules', 40],
  [2, 'one group', 5],
] as const)(
  'a pool at one place beside boxes that move is kept, %iD, %s, one is fired every %i frames',
  (dimensions, rules, every) => {
    // Nearly all pairs are of two boxes at rest, though half of the boxes move.
    const random = createRandom(31);
    const [pool, count] = [200, 400];
    const extent = dimensions === 2 ? 350 : 110;
    const axes = Array.from({ length: dimensions }, (_, a) => a);
    const [kept, fresh] = (['auto', 'strip-sweep'] as const).map(
      (technique) => new BroadPhase({ dimensions, technique }),
    );
    const both = [kept!, fresh!];
    const at = Array.from({ length: count }, (_, id) => axes.map(() => (id < pool ? -1000 : random() * extent)));
    const way = at.map((_, id) => axes.map(() => (id < pool ? 0 : random() - 0.5)));
    for (let id = 0; id < count; id++) {
      for (const space of both) setCube(space, id, at[id]!);
      if (rules === 'one group' && id < pool) for (const space of both) space.setGroup(id, 7);
    }
    let [answered, tests, spent] = [0, 0, 0];
    for (let frame = 1; frame <= 200; frame++) {
      if (every > 0 && frame % every === 0) {
        const id = Math.floor(random() * pool);
        at[id] = axes.map(() => random() * extent);
        way[id] = axes.map(() => random() - 0.5);
      }
      for (let id = 0; id < count; id++) {
        if (way[id]!.every((x) => x === 0)) continue;
        at[id] = at[id]!.map((x, a) => x + way[id]![a]!);
        for (const space of both) setCube(space, id, at[id]!);
      }
      for (const space of both) space.update();
      if (frame % 40 === 0) expectSamePairs(kept!.pairs, fresh!.pairs, `frame ${frame}`);
      answered += Number(isKept(kept!));
      tests += kept!.stats.tests;
      spent += fresh!.stats.tests;
    }
    expect(answered, 'updates of 200 answered from what is kept').toBeGreaterThan(150);
    expect(tests / spent, 'tests, as a share of those of full rebuilds').toBeLessThan(0.2);
  },
);

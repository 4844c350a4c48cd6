// Few changes of every kind, in each frame: boxes that move, jump, come and go, with ids of their own or not, rules,
// groups, reaches, snapshots; in an open world and in one that wraps around. Whatever is retained (candidates, named
// pairs, ghosts), a space finds the pairs and events of brute force. SEED=… runs a failure again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const most = 150;
const frames = 80;

type Space = BroadPhase<2 | 3>;
type Random = () => number;

const upTo = (random: Random, n: number) => Math.floor(random() * n);

interface World {
  readonly size: readonly number[];
  readonly origin: number;
  /** The share of boxes that reach to infinity, or are there. */
  readonly infinite: number;
}

/** A box anywhere in three worlds or, mostly, in the one at `origin`; on borders, too; a few as long as the world. */
function anyBox(random: Random, { size: wrap, origin, infinite }: World): number[] {
  const lower = wrap.map((size) => {
    const at = random() < 0.1 ? (upTo(random, 7) - 3) * (size / 2) : (random() + origin) * size;
    return random() < 0.1 ? at + size * (upTo(random, 3) - 1) : at;
  });
  const giant = random() < 0.02;
  const box = [...lower, ...lower.map((at, a) => at + (giant ? random() * 1.2 * wrap[a]! : upTo(random, 6) * 0.7))];
  if (random() < infinite) {
    const axis = upTo(random, wrap.length);
    const [from, to] = [upTo(random, 3) - 1, upTo(random, 3) - 1].sort(); // -1 and 1 are infinite
    if (from !== 0) box[axis] = from! * Infinity;
    if (to !== 0) box[axis + wrap.length] = to! * Infinity;
    if (!(box[axis]! <= box[axis + wrap.length]!)) box[axis + wrap.length] = box[axis]!;
  }
  return box;
}

/** A call, made to all spaces alike. `stride`: from one id to the next. */
function change(spaces: Space[], random: Random, world: World, stride: number): void {
  const id = upTo(random, most) * stride;
  const [first] = spaces as [Space];
  const box = first.get(id);
  const kind = random();
  const value = upTo(random, 3);
  const another = anyBox(random, world);
  const step = world.size.map(() => (random() - 0.5) * 0.8);
  const stepped = Array.from(box ?? [], (at, k) => at + step[k % step.length]!);
  for (const space of spaces) {
    if (!box) setBox(space, id, another);
    else if (kind < 0.5) setBox(space, id, stepped);
    else if (kind < 0.6) setBox(space, id, another);
    else if (kind < 0.7) space.delete(id);
    else if (kind < 0.78) space.setEnabled(id, value > 0);
    else if (kind < 0.82) space.setStatic(id, value > 1);
    else if (kind < 0.86) space.setFilter(id, 1 << value, 0b101);
    else if (kind < 0.9) space.setGroup(id, value);
    else if (kind < 0.93) space.setReach(id, value / 2);
  }
}

const keysOf = (pairs: Uint32Array) =>
  Array.from({ length: pairs.length / 2 }, (_, k) => pairs[2 * k]! * 2 ** 24 + pairs[2 * k + 1]!).sort((a, b) => a - b);

const worlds = ([2, 3] as const).flatMap((dimensions) => [
  [dimensions, 'wrapped'] as const,
  [dimensions, 'open'] as const,
]);

describe.each(worlds)(`in %dD, in a world that is %s (SEED=${seed})`, (dimensions, world) => {
  const sides = world === 'wrapped' ? [24, 17, 20] : [12, 8, 10]; // where few boxes wrap around, few meet
  const size = sides.slice(0, dimensions) as [number, number];
  test.each(['auto', 'incremental', 'retained-grid', 'sweep-and-prune', 'aabb-tree'] as const)('%s', (technique) => {
    let [retained, moved] = [0, 0];
    for (let run = 0; run < runs(16); run++) {
      const random = createRandom(seed + run);
      const [origin, touching, busy] = [run % 3 ? 0 : -0.5, run % 4 > 0, run % 2 ? 3 : 12];
      const stride = run % 5 < 3 ? 1 : 7;
      const options = { dimensions, touching, events: true, ...(world === 'wrapped' && { wrap: size }) };
      const spaces: Space[] = [
        new BroadPhase({ ...options, technique }),
        new BroadPhase({ ...options, technique: 'brute-force' }),
      ];
      // In some runs all boxes are float32 at first.
      const at = { size, origin, infinite: world === 'open' && run % 2 ? 0.2 : 0 };
      const boxes = Array.from({ length: most / 2 }, () => anyBox(random, at));
      for (const space of spaces) {
        if (run % 5 === 1) space.setAll(Float32Array.from(boxes.flat()));
        else for (const [id, box] of boxes.entries()) setBox(space, id * stride, box);
      }
      let before = new Set<number>();
      for (let frame = 0; frame < frames; frame++) {
        for (let call = upTo(random, busy); call > 0; call--) change(spaces, random, at, stride);
        if (random() < 0.02) spaces[0]!.restore(spaces[0]!.snapshot());
        for (const space of spaces) space.update();
        const [found, expected] = spaces.map(({ pairs }) => keysOf(pairs)) as [number[], number[]];
        expect(found, `run ${run}, frame ${frame}`).toEqual(expected);
        for (const list of ['began', 'ended'] as const) {
          const [its, others] = spaces.map((space) => keysOf(space[list]));
          expect(its, `${list}, run ${run}, frame ${frame}`).toEqual(others);
        }
        const now = new Set(expected);
        moved += [...now].filter((key) => !before.has(key)).length;
        before = now;
        retained += Number(spaces[0]!.stats.reason.includes('are retained'));
        spaces[0]!.validate();
      }
    }
    expect(moved).toBeGreaterThan(100);
    if (technique === 'auto') expect(retained).toBeGreaterThan(frames / 2);
  });
});

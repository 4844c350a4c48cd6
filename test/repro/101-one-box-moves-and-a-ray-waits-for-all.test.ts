// One of 100,000 boxes moved, and the first ray of the frame rebuilt the whole index: 2.8 ms. Now the index follows,
// exactly, whatever moves, comes, goes or gets another layer.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import type { Entry } from '../support/model.ts';
import { ahead, inBox, near } from '../support/query-reference.ts';

type Loose = Record<string, (...given: unknown[]) => unknown>;

test.each([
  [2, 400],
  [3, 400],
  [2, 30],
  [2, 3000],
] as const)('in %d dimensions, among %d boxes, it answers as a look at all', { tags: 'long' }, (dimensions, count) => {
  const random = createRandom(dimensions + count);
  const world = 100;
  const place = () => world * random() * (random() < 0.02 ? 50 : 1);
  const box = (near?: readonly number[]) => {
    const low = Array.from({ length: dimensions }, (_, a) => (near ? near[a]! + random() - 0.5 : place()));
    return [...low, ...low.map((x) => x + 3 * random())]
      .map((x) => (random() < 0.9 ? Math.fround(x) : x))
      .map((x, k, all) => (k < dimensions ? x : Math.max(x, all[k - dimensions]!)));
  };
  const space = new BroadPhase({ dimensions });
  const ask = space as unknown as Loose;
  const entries = new Map<number, Entry>();
  const put = (id: number, given: number[]) => {
    ask.set(id, ...given);
    const { layer = 0xffffffff } = entries.get(id) ?? {};
    entries.set(id, { box: given, layer, mask: 0xffffffff, isStatic: false });
  };
  for (let id = 0; id < count; id++) put(2 * id, box());
  space.setFilter(0, 1, 1);
  entries.get(0)!.layer = 1;
  space.update();
  for (let frame = 0; frame < 250; frame++) {
    const moves = frame % 40 === 0 ? count : Math.floor(4 * random());
    for (let k = 0; k < moves; k++) {
      const id = 2 * Math.floor(count * random()) + (random() < 0.05 ? 1 : 0);
      const known = entries.get(id);
      if (random() < 0.1) {
        space.delete(id);
        entries.delete(id);
      } else put(id, box(random() < 0.7 ? known?.box : undefined));
      if (entries.has(id) && random() < 0.2) {
        const layer = 1 << Math.floor(3 * random());
        space.setFilter(id, layer, 0xffffffff);
        entries.get(id)!.layer = layer;
      }
    }
    space.update();
    const point = Array.from({ length: dimensions }, () => world * random());
    const asked = random() < 0.3 ? { mask: 2 } : {};
    const all = [...point, ...point.map((x) => x + 60 * random())];
    const found = ask.queryBox(...all, asked) as number[];
    expect(found.sort((a, b) => a - b)).toEqual(inBox(entries, all, asked));
    const everywhere = [...point.map(() => -Infinity), ...point.map(() => Infinity)];
    expect((ask.queryBox(...everywhere) as number[]).length).toBe(entries.size);
    const way = point.map(() => random() - 0.5);
    const [first] = ahead(entries, [...point, ...point], way, Infinity, asked, 1);
    expect((ask.rayCast(...point, ...way, asked) as { id: number } | undefined)?.id).toBe(first?.id);
    expect(ask.nearest(...point, 5, asked)).toEqual(near(entries, point, 5, asked).map(({ id }) => id));
    const visited: number[] = [];
    ask.queryBox(...all, { ...asked, visit: (id: number) => visited.push(id) });
    expect(visited.sort((a, b) => a - b)).toEqual(inBox(entries, all, asked));
  }
});

// Boxes that jitter around their places while all others rest, such as a selection that is dragged about: a list of
// candidates soon holds them, and no update makes another.
import { BroadPhase, type Dimensions } from 'broadphase';
import { expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

const [count, movers, side, settled, updates] = [3000, 150, 10, 100, 400];

test.each([2, 3] as const)('in %dD boxes that jitter are soon held by one list of candidates', (dimensions) => {
  const random = createRandom(7);
  const world = (dimensions === 2 ? count * 400 : count * 4000) ** (1 / dimensions);
  const homes = Array.from({ length: count }, () => Array.from({ length: dimensions }, () => random() * world));
  const spaces = (['auto', 'strip-sweep'] as const).map((technique) => new BroadPhase({ dimensions, technique }));
  const [space, plain] = spaces as [BroadPhase<Dimensions>, BroadPhase<Dimensions>];
  const put = (id: number, reach: number) => {
    const low = homes[id]!.map((home) => home + reach * side * (random() - 0.5));
    const box = [...low, ...low.map((x) => x + side)] as [number, number, number, number];
    for (const each of spaces) each.set(id, ...box);
  };
  for (let id = 0; id < count; id++) put(id, 0);
  let lists = 0;
  let entries = 0; // of the list in use: they are those of the sweep that made it
  for (let update = 0; update < updates; update++) {
    for (let id = 0; id < count; id += count / movers) put(id, 1);
    for (const each of spaces) each.update();
    expect(space.pairCount).toBe(plain.pairCount);
    if (update >= settled && space.stats.entries !== entries) lists++;
    entries = space.stats.entries;
  }
  expect(lists).toBeLessThanOrEqual(2);
});

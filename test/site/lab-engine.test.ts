// What runs in a worker of the lab: that what it shows is what is there.
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';
import { BroadPhase, findPairs } from 'broadphase';
import { openTrace, TraceWriter } from 'broadphase/trace';
import { describe, expect, test } from 'vitest';
import { traces } from '../../site/lab/catalog.ts';
import { Engine } from '../../site/lab/worker/engine.ts';
import { worldOf } from '../../site/lab/worker/feed.ts';
import type { Wanted } from '../../site/lab/worker/messages.ts';
import { cellSlot, chosenSlot, heatSlot, partnerSlot } from '../../site/shared/groups.ts';
import { createScene } from '../../src/scenes/index.ts';
import { concat } from '../support/random-frames.ts';

const plain: Wanted = { steps: 0, boxes: true, structure: false, heat: false, pairs: false, chosen: undefined };
const everything: Wanted = { ...plain, structure: true, heat: true, pairs: true };

async function opened(name: string, boxes: number, frame = 0): Promise<Engine> {
  const engine = new Engine();
  await engine.open({ kind: 'scene', name, boxes }, frame);
  return engine;
}

const traceOf = (frames: readonly { boxes: Float32Array; ids?: number[] }[]): Blob => {
  const writer = new TraceWriter(2);
  return new Blob([
    concat([writer.header(), ...frames.map(({ boxes, ids }) => writer.frame(boxes, ids)), writer.end()]),
  ]);
};

/** Boxes of ids 70, 5 and 900: the first two overlap. */
const named = {
  boxes: Float32Array.of(0, 0, 4, 4, 3, 3, 8, 8, 20, 20, 21, 21),
  ids: [70, 5, 900],
};

test.each(BroadPhase.techniques)('%s: the picture is the scene, its pairs and its cells', async (technique) => {
  const engine = await opened('mixed2d', 300);
  engine.setup({ technique, cellSize: undefined });
  const scene = createScene('mixed2d', 300, { speed: 0.02 * Math.sqrt(300) });
  for (let frame = 0; frame < 3; frame++) {
    const picture = engine.picture({ ...everything, steps: frame === 0 ? 0 : 1 });
    if (frame > 0) scene.step();
    const { cells, boxes, drawn, slots, lines, stats } = picture;
    expect(picture.index).toBe(frame);
    expect(drawn.subarray(4 * cells, 4 * (cells + boxes))).toEqual(scene.boxes);
    expect(stats.pairs).toBe(findPairs(scene.boxes).length / 2);
    expect(lines!.length).toBe(4 * stats.pairs);
    expect(cells).toBeGreaterThan(0);
    for (const slot of slots.subarray(0, cells)) expect(slot).toBeGreaterThanOrEqual(cellSlot);
    for (const slot of slots.subarray(cells, cells + boxes)) expect(slot).toBeLessThan(cellSlot);
  }
});

test('of the intervals of sweep-and-prune some are drawn: each reaches across the view, so all would hide it', async () => {
  const engine = await opened('uniform2d', 5000);
  engine.setup({ technique: 'sweep-and-prune', cellSize: undefined });
  const { stats, cells, drawn } = engine.picture(everything);
  expect(stats.cells).toBe(5000);
  expect(cells).toBeGreaterThan(20);
  expect(cells).toBeLessThanOrEqual(40);
  const axis = Number(Number.isFinite(drawn[1]));
  const spread = (from: number, to: number) => {
    const low = Array.from({ length: to - from }, (_, k) => drawn[4 * (from + k) + axis]);
    return Math.max(...low) - Math.min(...low);
  };
  expect(spread(0, cells)).toBeGreaterThan(0.9 * spread(cells, cells + 5000));
  const { chosen, cells: with1 } = engine.picture({ ...plain, structure: true, chosen: 1 });
  expect(with1).toBeGreaterThanOrEqual(chosen!.cells); // all that the chosen box is in
});

test('a scene begun at a frame is as one that was stepped to it', async () => {
  const stepped = await opened('crowd', 200);
  const jumped = await opened('crowd', 200, 7);
  const one = stepped.picture({ ...plain, steps: 7 });
  const other = jumped.picture(plain);
  expect(other.index).toBe(7);
  expect(other.drawn).toEqual(one.drawn);
});

test('arrays that are handed back are used again', async () => {
  const engine = await opened('uniform2d', 500);
  const first = engine.picture(plain);
  const second = engine.picture({ ...plain, steps: 1, spare: { drawn: first.drawn, slots: first.slots } });
  expect(second.drawn).toBe(first.drawn);
  expect(second.slots).toBe(first.slots);
});

test('a click finds the smallest box there, or the nearest within reach', async () => {
  const engine = new Engine();
  const boxes = Float32Array.of(0, 0, 100, 100, 10, 10, 12, 12);
  await engine.open({ kind: 'file', file: traceOf([{ boxes }]) }, 0);
  expect(engine.pick([11, 11], 0)).toBe(1);
  expect(engine.pick([50, 50], 0)).toBe(0);
  expect(engine.pick([103, 50], 5)).toBe(0);
  expect(engine.pick([103, 50], 2)).toBeUndefined();
});

test('a ray finds the first box of a solid scene', async () => {
  const engine = await opened('uniform3d', 50);
  const { drawn } = engine.picture(plain);
  const [x, y, z] = [0, 1, 2].map((axis) => (drawn[axis] + drawn[axis + 3]) / 2);
  expect(engine.pick([x, y, z, 0, 0, 1], Infinity)).toBeDefined();
});

test('a chosen box tells its partners by their ids, and both are marked', async () => {
  const engine = new Engine();
  await engine.open({ kind: 'file', file: traceOf([named]) }, 0);
  const { chosen, slots, cells, boxes } = engine.picture({ ...plain, chosen: 5 });
  expect(chosen).toMatchObject({ id: 5, box: [3, 3, 8, 8], partners: [70], partnerCount: 1 });
  expect(chosen!.cells).toBeGreaterThan(0);
  expect([...slots.subarray(cells, cells + boxes)]).toEqual([partnerSlot, chosenSlot, 0]);
  expect(engine.picture({ ...plain, chosen: 6 }).chosen).toBeUndefined();
});

test('the hottest cell is where the boxes are, and each box counts once', async () => {
  const engine = new Engine();
  const crowded = Array.from({ length: 40 }, (_, k) => [k / 100, 0, k / 100 + 1, 1]);
  const alone = Array.from({ length: 40 }, (_, k) => [10 * k, 50, 10 * k + 1, 51]);
  const boxes = Float32Array.from([...crowded, ...alone].flat());
  await engine.open({ kind: 'file', file: traceOf([{ boxes }]) }, 0);
  for (const technique of ['spatial-grid', 'quadtree', 'r-tree'] as const) {
    engine.setup({ technique, cellSize: undefined });
    const { hottest, slots, cells } = engine.picture({ ...everything, boxes: false });
    expect(hottest[0].boxes, technique).toBeGreaterThan(3);
    expect(hottest[0].boxes, technique).toBeLessThanOrEqual(40);
    expect(hottest[0].box[1], technique).toBeLessThan(50);
    expect(Math.max(...slots.subarray(0, cells)), technique).toBe(heatSlot + 3);
  }
});

test('a trace begins again after its last frame', async () => {
  const engine = new Engine();
  const { frames } = await engine.open({ kind: 'file', file: traceOf([named, named, named]) }, 0);
  expect(frames).toBe(3);
  const indices = Array.from({ length: 5 }, () => engine.picture({ ...plain, steps: 1 }).index);
  expect(indices).toEqual([1, 2, 0, 1, 2]);
});

test('a broken file leaves what was shown', async () => {
  const engine = await opened('uniform2d', 40);
  const good = new Uint8Array(await traceOf([named, named]).arrayBuffer());
  const broken = good.slice();
  broken[good.length - 12] ^= 1;
  await expect(engine.open({ kind: 'file', file: new Blob([broken]) }, 0)).rejects.toThrow('corrupted: wrong checksum');
  await expect(engine.open({ kind: 'file', file: new Blob(['a text']) }, 0)).rejects.toThrow('not a trace');
  await expect(engine.open({ kind: 'file', file: new Blob([]) }, 0)).rejects.toThrow('truncated');
  expect(engine.picture(plain).boxes).toBe(40);
});

test('what is recorded is what was shown', async () => {
  const engine = await opened('uniform2d', 30);
  const shown = [engine.picture(plain).drawn.slice(0, 120)];
  engine.record();
  for (let k = 0; k < 3; k++) shown.push(engine.picture({ ...plain, steps: 1 }).drawn.slice(0, 120));
  const trace = openTrace(engine.recording());
  expect(Array.from(trace, ({ boxes }) => new Float32Array(boxes))).toEqual(shown);
  expect(() => engine.recording()).toThrow('nothing is being recorded');
});

test('the cost of a cell size is that of the technique at hand', async () => {
  const engine = await opened('uniform2d', 2000);
  engine.setup({ technique: 'spatial-grid', cellSize: undefined });
  expect(engine.cellSizes()).toEqual({ heeded: true, typical: 10 });
  const [fine, coarse] = [engine.cost(20), engine.cost(640)];
  expect(coarse.tests).toBeGreaterThan(2 * fine.tests);
  expect(fine.ms).toBeGreaterThan(0);
  engine.setup({ technique: 'brute-force', cellSize: undefined });
  expect(engine.cellSizes().heeded).toBe(false);
});

describe('the traces that come with the page', () => {
  test.each(Object.entries(traces))('%s opens', async (_, { url }) => {
    const file = fileURLToPath(new URL(`../../recordings/${basename(url)}`, import.meta.url));
    const engine = new Engine();
    const { frames, world } = await engine.open({ kind: 'file', file: new Blob([readFileSync(file)]) }, 1);
    expect(frames).toBeGreaterThan(1);
    expect(world.every(Number.isFinite)).toBe(true);
    expect(engine.picture(plain)).toMatchObject({ index: 1 });
    expect(engine.picture(plain).stats.pairs).toBeGreaterThan(0);
  });
});

test('the world that is shown has walls around what happens, and leaves out what reaches far away', () => {
  const pile = Array.from({ length: 200 }, (_, k) => [10 + k / 4, k / 4, 11 + k / 4, k / 4 + 1]).flat();
  expect(worldOf([...pile, 0, 0, 80, 1, 0, 0, 1, 80, 0, 79, 80, 80], 2)).toEqual([0, 0, 80, 80]);
  const boxes = Array.from({ length: 200 }, (_, k) => [k, k, k + 1, k + 1]).flat();
  expect(worldOf([...boxes, -1e6, -5, 1e6, 0], 2)[2]).toBeLessThan(300);
  expect(worldOf([-Infinity, -Infinity, Infinity, Infinity], 2).every(Number.isFinite)).toBe(true);
  expect(worldOf([], 3)).toHaveLength(6);
});

// The grids that the article adds to the engine's own: each finds what brute force finds, for the work it promises.
import * as ro from 'broadphase/ro';
import { describe, expect, test } from 'vitest';
import { HierarchicalGrid } from '../../site/article/demos/hierarchical-grid.ts';
import { HomeCellGrid } from '../../site/article/demos/home-cell-grid.ts';
import { RetainedGrid } from '../../site/article/demos/retained-grid.ts';
import { random, recordPairs, squares } from './scene.ts';

const grids: [name: string, make: () => ro.coltech.EntityList][] = [
  ['RetainedGrid', () => new RetainedGrid(20)],
  ['HomeCellGrid', () => new HomeCellGrid(20)],
  ['HierarchicalGrid', () => new HierarchicalGrid()],
];

describe.each(grids)('%s', (_, make) => {
  test('finds what brute force finds, in a crowd of all sizes where entities come and go', () => {
    const run = (technique: ro.coltech.Technique) => {
      const next = random(11);
      const frames = recordPairs(technique);
      const world = new ro.World(null, { coltech: technique });
      for (let frame = 0; frame < 30; frame++) {
        for (let i = 0; i < 5; i++) {
          const size = 10 ** (2.5 * next() - 0.5);
          const entity = new ro.Entity(800 * next() - 300, 600 * next() - 200, size, size * next());
          entity.ppos.x -= 8 * next() - 4;
          entity.ppos.y -= 8 * next() - 4;
          world.addEntity(entity);
        }
        if (frame % 3 === 0) world.removeEntity(world.entities[Math.floor(next() * world.entities.length)]);
        world.step();
      }
      return frames;
    };
    const expected = run(new ro.coltech.BruteForce());
    expect(expected.flat().length).toBeGreaterThan(150);
    expect(run(make())).toEqual(expected);
  });

  test('makes far fewer tests than brute force', () => {
    const technique = make();
    squares(technique, 100, (i) => [(i % 10) * 13, Math.floor(i / 10) * 13]).step();
    expect(technique.collisionTests).toBeGreaterThan(0);
    expect(technique.collisionTests).toBeLessThan(4950 / 5);
  });
});

describe('RetainedGrid', () => {
  test('only touches entities that change cells', () => {
    const grid = new RetainedGrid(20);
    const world = squares(grid, 3, (i) => [i * 40 + 5, 5]);
    world.step();
    expect([grid.moved, grid.changes.length, grid.entries]).toEqual([3, 3, 3]);

    world.entities[0].ppos.x -= 1; // moves on by 1 a step: within its cell at first
    world.step();
    world.step();
    expect([grid.moved, grid.changes.length]).toEqual([0, 0]);

    for (let i = 0; i < 4; i++) world.step();
    expect([grid.moved, grid.changes.length, grid.entries]).toEqual([1, 1, 4]); // its right edge reached 20
  });
});

describe('HomeCellGrid', () => {
  test('searches as far as the largest box, beyond the cells that a box overlaps', () => {
    const grid = new HomeCellGrid(10);
    const world = new ro.World(null, { coltech: grid });
    const wide = new ro.Entity(2, 14, 39, 2);
    const tall = new ro.Entity(34, 2, 2, 39);
    world.addEntity(wide);
    world.addEntity(tall);
    grid.update();
    expect(grid.queryForCollisionPairs()).toEqual([[wide, tall]]);
    expect(grid.at(0, 1)).toEqual([wide]); // and the tall one begins in column 3
    expect(grid.searchArea(tall)).toEqual([-1, -4, 3, 4]);
  });
});

describe('HierarchicalGrid', () => {
  test('keeps each entity in the grid that fits it', () => {
    const grid = new HierarchicalGrid();
    const world = new ro.World(null, { coltech: grid });
    for (const size of [0, 3, 4, 5, 64, 65]) world.addEntity(new ro.Entity(0, 0, size, size));
    grid.update();
    expect(grid.grids.map(({ cellSize }) => cellSize)).toEqual([1, 4, 8, 64, 128]);
  });

  test('comes near the best cell size of a flat grid without choosing one, where sizes differ by a hundred', () => {
    const build = <T extends ro.coltech.EntityList>(technique: T): T => {
      const next = random(5);
      const world = new ro.World(null, { coltech: technique });
      for (let i = 0; i < 600; i++) {
        const size = i % 20 === 0 ? 150 + 150 * next() : 1 + 2 * next();
        world.addEntity(new ro.Entity(1000 * next(), 1000 * next(), size, size));
      }
      technique.update();
      technique.queryForCollisionPairs();
      return technique;
    };
    const flat = [2, 8, 32, 128, 512]
      .map((cellSize) => build(new ro.coltech.SpatialGrid(0, 0, 1000, 1000, cellSize)))
      .map((grid) => grid.grid.flat(2).length + grid.hashChecks + grid.collisionTests)
      .sort((a, b) => a - b);
    const grids = build(new HierarchicalGrid());
    const work = grids.lookUps + grids.collisionTests;
    expect(work).toBeLessThan(2 * flat[0]);
    expect(work).toBeLessThan(flat[2] / 2);
  });
});

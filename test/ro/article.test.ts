// The article's figures and footnotes as facts.
import * as ro from 'broadphase/ro';
import { describe, expect, test } from 'vitest';
import { squares } from './scene.ts';

const { BruteForce, SpatialGrid } = ro.coltech;

describe('figure 1: the number of brute-force tests', () => {
  test.each([
    [0, 0],
    [1, 0],
    [2, 1],
    [10, 45],
    [100, 4950],
  ])('%i entities make %i tests', (count, tests) => {
    const technique = new BruteForce();
    squares(technique, count, (i) => [i * 20, 0]).step();
    expect(technique.collisionTests).toBe(tests);
  });
});

describe('figure 2: the overlap test', () => {
  const technique = new BruteForce();
  const hit = (a: number[], b: number[]) =>
    technique.aabb2DIntersection(
      new ro.Entity(a[0], a[1], a[2] - a[0], a[3] - a[1]),
      new ro.Entity(b[0], b[1], b[2] - b[0], b[3] - b[1]),
    );

  test('footnote 5: boxes overlap when their projections overlap on both axes, and only then', () => {
    expect(hit([0, 0, 10, 10], [5, 5, 15, 15])).toBe(true);
    expect(hit([0, 0, 10, 10], [11, 5, 20, 15])).toBe(false); // a gap along x only
    expect(hit([0, 0, 10, 10], [5, 11, 15, 20])).toBe(false); // a gap along y only
    expect(hit([11, 5, 20, 15], [0, 0, 10, 10])).toBe(false);
    expect(hit([5, 11, 15, 20], [0, 0, 10, 10])).toBe(false);
    expect(hit([11, 11, 20, 20], [0, 0, 10, 10])).toBe(false);
    expect(hit([0, 0, 10, 10], [4, 4, 5, 5])).toBe(true); // one within the other
    expect(hit([4, -5, 5, 15], [-5, 4, 15, 5])).toBe(true); // a cross: no corner of one is in the other
  });

  test('touching is overlapping, and a box without a size is a point', () => {
    expect(hit([0, 0, 10, 10], [10, 0, 20, 10])).toBe(true);
    expect(hit([0, 0, 10, 10], [10, 10, 20, 20])).toBe(true);
    expect(hit([5, 5, 5, 5], [0, 0, 10, 10])).toBe(true);
    expect(hit([5, 5, 5, 5], [5, 5, 5, 5])).toBe(true);
  });

  test("the article's AABB at 10, 20 of width and height 10", () => {
    expect(new ro.Entity(10, 20, 10, 10).getAABB()).toEqual({ min: [10, 20], max: [20, 30] });
  });

  test('no pair is tested twice, and no entity against itself', () => {
    const technique = new BruteForce();
    const seen: string[] = [];
    technique.aabb2DIntersection = (a, b) => {
      seen.push([a._roId, b._roId].sort().join());
      return false;
    };
    squares(technique, 9, () => [0, 0]).step();
    expect(seen).toHaveLength(36);
    expect(new Set(seen).size).toBe(36);
    expect(seen.some((key) => new Set(key.split(',')).size === 1)).toBe(false);
  });
});

describe('figures 4 and 5: from a position to a cell', () => {
  test('floor((position - grid minimum) / cell size)', () => {
    const grid = new SpatialGrid(0, 0, 320, 320, 32);
    expect([grid.columnOf(46), grid.cellOf(237)]).toEqual([1, 7]);
  });

  test('a grid with a negative minimum maps negative positions to indices of 0 or more', () => {
    const grid = new SpatialGrid(-100, -50, 220, 270, 32);
    expect([grid.columnOf(46), grid.cellOf(237)]).toEqual([4, 8]);
    expect([grid.columnOf(-100), grid.cellOf(-50)]).toEqual([0, 0]);
    expect([grid.columnOf(-68), grid.cellOf(-18)]).toEqual([1, 1]);
  });

  test('the entity at { x: 20, y: 50 } is in six cells, its corner in grid[0][1]', () => {
    const grid = new SpatialGrid(0, 0, 160, 160, 40);
    const world = new ro.World(null, { coltech: grid });
    const entity = new ro.Entity(20, 50, 50, 80);
    world.addEntity(entity);
    world.step();
    const cells: string[] = [];
    grid.grid.forEach((column, col) => {
      column.forEach((entities, cell) => {
        expect(entities).toEqual([entity]);
        cells.push(`${col},${cell}`);
      });
    });
    expect(cells).toEqual(['0,1', '0,2', '0,3', '1,1', '1,2', '1,3']);
    expect(grid.allocatedCells).toBe(6);
    expect(grid.arraysCreated).toBe(1 + 2 + 6);
  });

  test('footnote 6: cells may be rectangles', () => {
    const grid = new SpatialGrid(0, 0, 100, 100, [50, 20]);
    const world = new ro.World(null, { coltech: grid });
    world.addEntity(new ro.Entity(45, 15, 10, 10));
    world.step();
    expect(grid.totalCells).toBe(2 * 5);
    expect([grid.columnOf(45), grid.columnOf(55), grid.cellOf(15), grid.cellOf(25)]).toEqual([0, 1, 0, 1]);
    expect(grid.allocatedCells).toBe(4);
    expect(grid.pxCellSize).toEqual({ x: 50, y: 20 });
    expect(grid.cellSize).toEqual([50, 20]);
  });
});

describe('figures 6 to 8: the choice of a cell size', () => {
  test('cells far too small: one entity is in many, and each of them is visited', () => {
    const grid = new SpatialGrid(0, 0, 100, 100, 1);
    squares(grid, 2, () => [0.5, 0.5]).step();
    expect(grid.allocatedCells).toBe(121);
    expect(grid.hashChecks).toBe(121);
    expect(grid.collisionTests).toBe(1);
  });

  test('cells far too large: as many tests as by brute force', () => {
    const grid = new SpatialGrid(0, 0, 1000, 1000, 1000);
    squares(grid, 100, (i) => [(i % 10) * 100, Math.floor(i / 10) * 100]).step();
    expect(grid.collisionTests).toBe(4950);
    expect(grid.allocatedCells).toBe(1);
  });

  test('figure 9: the cell size changes on the fly, and the pairs do not', () => {
    const grid = new SpatialGrid(0, 0, 200, 200, 15);
    const world = squares(grid, 50, (i) => [(i * 37) % 190, (i * 59) % 190]);
    const found = [15, 1, 50, [3, 90] as const].map((cellSize) => {
      grid.cellSize = cellSize;
      world.step();
      return { pairs: grid.queryForCollisionPairs().length, cells: grid.totalCells };
    });
    expect(new Set(found.map(({ pairs }) => pairs)).size).toBe(1);
    expect(found.map(({ cells }) => cells)).toEqual([14 * 14, 200 * 200, 4 * 4, 67 * 3]);
  });
});

describe('the closing table: cell size 15, 100 entities of 10x10, a grid of 150x150', () => {
  test('each alone in a cell: no test, and 1 + 10 + 100 = 111 arrays', () => {
    const grid = new SpatialGrid(0, 0, 150, 150, 15);
    squares(grid, 100, (i) => [(i % 10) * 15 + 2, Math.floor(i / 10) * 15 + 2]).step();
    expect(grid.collisionTests).toBe(0);
    expect(grid.hashChecks).toBe(0);
    expect(grid.arraysCreated).toBe(111);
    expect(grid.totalCells).toBe(100);
    expect(grid.allocatedCells).toBe(100);
  });

  // The article says 100 * 100 = 10,000: that counts A with B, B with A, and each with itself. Different pairs are
  // 100 * 99 / 2 = 4,950, for the grid as for brute force.
  test('all in one cell: 4,950 tests, and 1 + 1 + 1 = 3 arrays', () => {
    const grid = new SpatialGrid(0, 0, 150, 150, 15);
    const world = squares(grid, 100, () => [2, 2]);
    world.step();
    expect(grid.collisionTests).toBe(4950);
    expect(grid.hashChecks).toBe(4950);
    expect(grid.arraysCreated).toBe(3);
    expect(grid.allocatedCells).toBe(1);
    world.broadPhase = new BruteForce();
    world.step();
    expect((world.broadPhase as ro.coltech.BruteForce).collisionTests).toBe(4950);
  });
});

describe('figure 14: the table of tested pairs', () => {
  test('two entities that share several cells are tested once, and looked up once per cell', () => {
    const grid = new SpatialGrid(0, 0, 100, 100, 10);
    squares(grid, 2, () => [5, 5]).step();
    expect(grid.allocatedCells).toBe(4);
    expect(grid.hashChecks).toBe(4);
    expect(grid.collisionTests).toBe(1);
  });

  test('ids whose digits run together are told apart: 1:11 is not 11:1', () => {
    const grid = new SpatialGrid(0, 0, 100, 100, 50);
    squares(grid, 112, () => [5, 5]).step();
    expect(grid.collisionTests).toBe((112 * 111) / 2);
  });
});

describe('footnote 3: Verlet integration', () => {
  test('the velocity is pos - ppos: what moved once moves on', () => {
    const entity = new ro.Entity(0, 0, 10, 10);
    entity.ppos = { x: -3, y: 2 };
    entity.inertia(16);
    expect([entity.pos, entity.ppos]).toEqual([
      { x: 3, y: -2 },
      { x: 0, y: 0 },
    ]);
    entity.inertia(16);
    expect(entity.pos).toEqual({ x: 6, y: -4 });
    expect('velocity' in entity).toBe(false);
  });

  test('a collision response only has to move the entity, and its velocity is right', () => {
    const entity = new ro.Entity(90, 0, 10, 10);
    entity.ppos.x = 80;
    const world = new ro.World(null, {
      handleCollisions: () => {
        if (entity.pos.x > 85) entity.pos.x = 70;
      },
    });
    world.addEntity(entity);
    world.step();
    expect(entity.pos.x).toBe(60); // flung back by the 10 from 80 to 70
  });

  test('an acceleration acts once, by its square of dt, and carries on as velocity', () => {
    const world = new ro.World(null);
    const entity = new ro.Entity(0, 0, 10, 10);
    world.addEntity(entity);
    entity.accel = { x: 0.5, y: -0.25 };
    world.step(2);
    expect(entity.accel).toEqual({ x: 0, y: 0 });
    expect(entity.pos).toEqual({ x: 4, y: -2 }); // 0.5 * 2 * 2 by accelerate, and as much again by inertia
    world.step(2);
    expect(entity.pos).toEqual({ x: 6, y: -3 });
  });
});

describe('footnote 4: boxes relative to a position', () => {
  test('a relative box plus the position is the absolute AABB, at every position', () => {
    const relative = { min: [0, 0], max: [10, 20] };
    const entity = new ro.Entity(0, 0, 10, 20);
    for (const [x, y] of [
      [0, 0],
      [-7, 3],
      [1e6, -1e6],
    ]) {
      entity.pos = { x, y };
      entity.updateAABB();
      const { min, max } = entity.getAABB();
      expect([...min, ...max]).toEqual([
        x + relative.min[0],
        y + relative.min[1],
        x + relative.max[0],
        y + relative.max[1],
      ]);
    }
  });
});

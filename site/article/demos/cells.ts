// What a spatial grid does with boxes that stand still, counted by doing it: for every cell size there is a different sum.
import { type coltech, Entity, World } from 'broadphase/ro';

/** x, y, width, height. */
export type Box = readonly [x: number, y: number, width: number, height: number];

/** A world of these boxes, one that nobody sees, on the technique. */
export function place<T extends coltech.Technique>(technique: T, boxes: readonly Box[]): T {
  const world = new World(null, { coltech: technique });
  for (const box of boxes) world.addEntity(new Entity(...box));
  return technique;
}

/** Fills the grid, asks it for the pairs, and adds up what that took. */
export function countWork(grid: coltech.SpatialGrid) {
  grid.update();
  const pairs = grid.queryForCollisionPairs();

  const visits = grid.allocatedCells; // of cells that hold something
  const lookUps = grid.hashChecks; // of pairs in the table of tested pairs
  const tests = grid.collisionTests; // of one box against another
  return { pairs, visits, lookUps, tests, work: visits + lookUps + tests };
}

/** The cell size, of those given, with the least work. */
export function bestCellSize(grid: coltech.SpatialGrid, cellSizes: readonly number[]): number {
  const before = grid.cellSize;
  const work = cellSizes.map((cellSize) => {
    grid.cellSize = cellSize;
    return countWork(grid).work;
  });
  grid.cellSize = before;
  return cellSizes[work.indexOf(Math.min(...work))];
}

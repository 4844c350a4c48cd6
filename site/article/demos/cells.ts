// Counts what a spatial grid does with boxes at rest, by running it. Every cell size gives different counts.
import { type coltech, Entity, World } from 'broadphase/ro';

/** x, y, width, height. */
export type Box = readonly [x: number, y: number, width: number, height: number];

/** A world of these boxes with this technique, without a picture. */
export function place<T extends coltech.Technique>(technique: T, boxes: readonly Box[]): T {
  const world = new World(null, { coltech: technique });
  for (const box of boxes) world.addEntity(new Entity(...box));
  return technique;
}

/** Fills the grid, queries the pairs, and counts the work. */
export function countWork(grid: coltech.SpatialGrid) {
  grid.update();
  const pairs = grid.queryForCollisionPairs();

  const visits = grid.allocatedCells; // of cells that hold something
  const lookUps = grid.hashChecks; // of pairs in the table of tested pairs
  const tests = grid.collisionTests; // of one box against another
  return { pairs, visits, lookUps, tests, work: visits + lookUps + tests };
}

/** The cell size with the least work, among those given. */
export function bestCellSize(grid: coltech.SpatialGrid, cellSizes: readonly number[]): number {
  const before = grid.cellSize;
  const work = cellSizes.map((cellSize) => {
    grid.cellSize = cellSize;
    return countWork(grid).work;
  });
  grid.cellSize = before;
  return cellSizes[work.indexOf(Math.min(...work))];
}

// The two extremes of a grid, by running it: a hundred boxes of 10 by 10, cells of 15, a world of 150 by 150.
import { coltech } from 'broadphase/ro';
import { type Box, countWork, place } from './cells.ts';

const COUNT = 100;
const SIDE = 10;
const CELL = 15;
const WORLD = 150;

/** @param heaped from 0, a cell for each box, to 1, all in one cell */
export function hundredBoxes(heaped: number): Box[] {
  const columns = WORLD / CELL;
  const margin = (CELL - SIDE) / 2;
  return Array.from({ length: COUNT }, (_, i) => {
    const x = margin + (i % columns) * CELL * (1 - heaped);
    const y = margin + Math.floor(i / columns) * CELL * (1 - heaped);
    return [x, y, SIDE, SIDE];
  });
}

export function measure(boxes: readonly Box[]) {
  const grid = place(new coltech.SpatialGrid(0, 0, WORLD, WORLD, CELL), boxes);
  const { tests } = countWork(grid);

  const bruteForce = place(new coltech.BruteForce(), boxes);
  bruteForce.queryForCollisionPairs();

  return {
    tests,
    arrays: grid.arraysCreated,
    cells: grid.allocatedCells,
    bruteForce: bruteForce.collisionTests, // n * (n - 1) / 2: each pair once
    ordered: boxes.length ** 2, // n * n: A with B, B with A, and each with itself
  };
}

// Fig. 9: the rings on a spatial grid, whose cells are too small, fitting or too large.
import { ro } from 'broadphase/ro';
import source from '../../../src/ro/coltech/spatial-grid.ts?raw';
import { demoColumns } from '../demo.ts';
import { rings } from '../demos/rings.ts';
import { button, choice, excerpt, listing } from '../kit/index.ts';
import { createStage } from '../stage.ts';

const width = 480;
const height = 360;
const sizes = [
  [2, 'Too small: 2'],
  [15, 'Fitting: 15'],
  [150, 'Too large: 150'],
] as const;

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);
  const grid = new ro.coltech.SpatialGrid(0, 0, width, height, 15);

  choice(left, 'Cell size', sizes, 15, (cellSize) => {
    grid.cellSize = cellSize;
    stage.refresh();
  });
  const stage = createStage(left, {
    width,
    height,
    build(canvas, colors) {
      const demo = rings(ro, canvas, grid, colors);
      for (let i = 1; i < 4; i++) demo.addRing();
      demo.world.debug = true; // draws the cells in use
      return demo;
    },
    counters: {
      tests: 'Collision tests',
      hashes: 'Hash checks',
      allocated: 'Allocated cells',
      cells: 'Total cells',
      entities: 'Entities',
      pairs: 'Colliding pairs',
    },
    count: ({ world, pairCount }) => ({
      tests: grid.collisionTests,
      hashes: grid.hashChecks,
      allocated: grid.allocatedCells,
      cells: grid.totalCells,
      entities: world.entities.length,
      pairs: pairCount,
    }),
    inWords: ({ world, ringCount, pairCount }) =>
      `${world.entities.length} squares on ${ringCount} rings, on a grid with cells of ${grid.pxCellSize.x}. ` +
      `${grid.allocatedCells.toLocaleString('en')} cells are in use. ${pairCount} colliding pairs, found by ` +
      `${grid.collisionTests.toLocaleString('en')} collision tests.`,
  });
  button(stage.controls, 'Add a ring', () => {
    stage.demo.addRing();
    stage.refresh();
  });
  button(stage.controls, 'Start over', () => {
    stage.demo.startOver();
    stage.refresh();
  });
  stage.canvas.addEventListener('click', stage.refresh);

  listing(right, 'src/ro/coltech/spatial-grid.ts', excerpt(source, 'override update(): void'));
  return stage.rest;
}

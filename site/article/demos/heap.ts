// The same rings, without a picture, with four techniques, to see how much garbage each leaves behind.
import { ro } from 'broadphase/ro';
import { rings } from './rings.ts';

const RINGS = 9;

/** A world of ten squares' width to the ring, and what finds its pairs. */
function on<T extends ro.coltech.EntityList>(coltech: T): { coltech: T; world: ro.World } {
  const { world, addRing } = rings(ro, null, coltech);
  for (let i = 1; i < RINGS; i++) addRing();
  return { coltech, world };
}

const grid = (cellSize: number) => new ro.coltech.SpatialGrid(0, 0, 400, 300, cellSize);

export const makeWorlds = () => [
  { name: 'Cells of 1', ...on(grid(1)) },
  { name: 'Cells of 15', ...on(grid(15)) },
  { name: 'Cells of 50', ...on(grid(50)) },
  { name: 'Library', ...on(new ro.coltech.BroadPhase()) },
];

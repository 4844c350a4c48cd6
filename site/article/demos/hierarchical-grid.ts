// A grid for every size: cells of 1, 2, 4, 8 … units, with each entity in the finest grid whose cells are no smaller
// than the entity. There is no cell size to choose, so none can be wrong.
//
// In its own grid an entity overlaps at most four cells. It is compared with the entities there, and with those in the
// cells that it overlaps of every coarser grid. Partners in finer grids find it themselves. So the work per entity
// grows with the number of sizes, not with how far they differ.
import { coltech, type Entity } from 'broadphase/ro';

interface Grid {
  cellSize: number;
  /** The entities of each occupied cell, by its column and row. */
  cells: Map<string, Entity[]>;
}

export class HierarchicalGrid extends coltech.EntityList {
  /** Cells visited by the last query. */
  lookUps = 0;
  /** The grids with entities, from fine to coarse. */
  grids: Grid[] = [];

  override update(): void {
    super.update();
    const grids = new Map<number, Grid>();

    for (const entity of this.entities) {
      const cellSize = this.cellSizeOf(entity);
      let grid = grids.get(cellSize);
      if (!grid) {
        grid = { cellSize, cells: new Map() };
        grids.set(cellSize, grid);
      }
      for (const [column, row] of cellsUnder(entity, cellSize)) {
        const cell = grid.cells.get(`${column}:${row}`);
        if (cell) cell.push(entity);
        else grid.cells.set(`${column}:${row}`, [entity]);
      }
    }

    this.grids = [...grids.values()].sort((a, b) => a.cellSize - b.cellSize);
    this.allocatedCells = this.grids.reduce((sum, { cells }) => sum + cells.size, 0);
  }

  queryForCollisionPairs(): coltech.Pair<Entity>[] {
    const pairs: coltech.Pair<Entity>[] = [];
    this.collisionTests = this.lookUps = 0;

    for (const entity of this.entities) {
      const own = this.cellSizeOf(entity);

      for (const { cellSize, cells } of this.grids) {
        if (cellSize < own) continue;

        for (const [column, row] of cellsUnder(entity, cellSize)) {
          this.lookUps++;
          for (const other of cells.get(`${column}:${row}`) ?? []) {
            // In their own grid each would find the other: only the newer one does.
            if (cellSize === own && other._roId >= entity._roId) continue;
            // Two that share several cells are compared in the first of them.
            if (column !== firstShared(entity, other, 0, cellSize) || row !== firstShared(entity, other, 1, cellSize))
              continue;

            this.collisionTests++;
            if (this.aabb2DIntersection(entity, other)) {
              pairs.push(entity._roId < other._roId ? [entity, other] : [other, entity]);
            }
          }
        }
      }
    }

    return pairs;
  }

  /** The smallest power of two that is at least an entity's longer side; at least 1. */
  cellSizeOf(entity: Entity): number {
    const { min, max } = entity.getAABB();
    const side = Math.max(max[0] - min[0], max[1] - min[1], 1);
    return 2 ** Math.ceil(Math.log2(side));
  }
}

/** Column and row of every cell of a grid that an entity overlaps. */
function* cellsUnder(entity: Entity, cellSize: number): Iterable<[column: number, row: number]> {
  const { min, max } = entity.getAABB();
  for (let column = Math.floor(min[0] / cellSize); column <= Math.floor(max[0] / cellSize); column++) {
    for (let row = Math.floor(min[1] / cellSize); row <= Math.floor(max[1] / cellSize); row++) yield [column, row];
  }
}

/** The first column (axis 0) or row (axis 1) that both entities overlap. */
function firstShared(a: Entity, b: Entity, axis: 0 | 1, cellSize: number): number {
  return Math.floor(Math.max(a.getAABB().min[axis], b.getAABB().min[axis]) / cellSize);
}

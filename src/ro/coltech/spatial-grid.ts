// Spatial grid: the world is cut into equal cells, and only entities that share a cell are tested.
//
// grid[column][cell] is an array of the entities that overlap that cell; columns and cells that nothing overlaps are
// not there. An entity is in every cell it overlaps, so two that overlap share one, and may share several: a table of
// the pairs already tested keeps each test from being made twice. The grid is thrown away and rebuilt by every update,
// which saves following each entity from cell to cell.
//
// Cost: one visit per entity and cell it overlaps, then one lookup per pair in a cell. Wins where entities are about
// as large as a cell and spread out. Loses where cells are far smaller (many visits, many arrays), far larger (brute
// force within a cell), or where sizes differ so much that no cell size suits them all.
import type { Collidable } from '../aabb.ts';
import type { Entity } from '../entity.ts';
import type { Vector } from '../vector.ts';
import { EntityList, type Pair } from './technique.ts';

/** The width and height of a cell in world units: one number for a square. */
export type CellSize = number | readonly [width: number, height: number];

/** More cells than this along an axis is a mistake in the cell size, and would take the memory of the machine. */
const MAX_CELLS_PER_AXIS = 2 ** 20;

/**
 * A spatial grid: the world is cut into equal cells, and only entities that share a cell are tested.
 *
 * @example
 * const technique = new coltech.SpatialGrid(0, 0, 2000, 100, 20);
 * const world = new World(null, { coltech: technique });
 * for (let k = 0; k < 100; k++) world.addEntity(new Entity(20 * k, 0, 10, 10));
 * world.step();
 * technique.collisionTests; // → 0
 * technique.allocatedCells; // → 100
 */
export class SpatialGrid<E extends Collidable = Entity> extends EntityList<E> {
  /** The upper left corner of the grid. */
  readonly min: Readonly<Vector>;
  /** Its lower right corner. */
  readonly max: Readonly<Vector>;
  /** The grid of the last update. */
  grid: E[][][] = [];
  #pxCellSize: Vector = { x: 0, y: 0 };
  #columns = 0;
  #cellsPerColumn = 0;

  /**
   * The grid covers minX to maxX and minY to maxY. What lies outside is found all the same: the cells at the border
   * hold whatever is beyond them.
   * @param cellSize above 0, finite
   * @throws RangeError for bounds that are not finite or have no area, or for a cell size out of range.
   */
  constructor(minX: number, minY: number, maxX: number, maxY: number, cellSize: CellSize) {
    super();
    if (!(minX < maxX && minY < maxY && Number.isFinite(maxX - minX) && Number.isFinite(maxY - minY))) {
      throw new RangeError(
        `SpatialGrid: the bounds are ${minX}, ${minY} to ${maxX}, ${maxY}; expected finite numbers with min < max`,
      );
    }
    this.min = { x: minX, y: minY };
    this.max = { x: maxX, y: maxY };
    this.cellSize = cellSize;
  }

  /** May be set at any time; the next update divides the world again. */
  get cellSize(): CellSize {
    const { x, y } = this.#pxCellSize;
    return x === y ? x : [x, y];
  }

  /** @throws RangeError for sizes that are not above 0, and for more than 2^20 cells along an axis */
  set cellSize(cellSize: CellSize) {
    const [x, y] = typeof cellSize === 'number' ? [cellSize, cellSize] : cellSize;
    if (!(x > 0 && y > 0 && x < Infinity && y < Infinity)) {
      throw new RangeError(`SpatialGrid: cellSize is ${cellSize}, expected a finite number above 0, or two for [w, h]`);
    }
    const columns = Math.ceil((this.max.x - this.min.x) / x);
    const cellsPerColumn = Math.ceil((this.max.y - this.min.y) / y);
    if (columns > MAX_CELLS_PER_AXIS || cellsPerColumn > MAX_CELLS_PER_AXIS) {
      throw new RangeError(
        `SpatialGrid: cellSize is ${cellSize}, which makes ${columns} columns of ${cellsPerColumn} cells; ` +
          `expected at most ${MAX_CELLS_PER_AXIS} along either axis`,
      );
    }
    this.#pxCellSize = { x, y };
    this.#columns = columns;
    this.#cellsPerColumn = cellsPerColumn;
  }

  /** The width (x) and height (y) of a cell in world units. */
  get pxCellSize(): Readonly<Vector> {
    return this.#pxCellSize;
  }

  /**
   * The index of the column that x is in; left of the grid the first, right of it the last.
   *
   * @example
   * new coltech.SpatialGrid(0, 0, 100, 100, 10).columnOf(25); // → 2
   */
  columnOf(x: number): number {
    const column = Math.floor((x - this.min.x) / this.#pxCellSize.x);
    return Math.min(Math.max(column, 0), this.#columns - 1);
  }

  /**
   * The index, within its column, of the cell that y is in; above the grid the first, below it the last.
   *
   * @example
   * new coltech.SpatialGrid(0, 0, 100, 100, 10).cellOf(1000); // → 9
   */
  cellOf(y: number): number {
    const cell = Math.floor((y - this.min.y) / this.#pxCellSize.y);
    return Math.min(Math.max(cell, 0), this.#cellsPerColumn - 1);
  }

  /** Builds the grid and puts every entity into the cells it overlaps. */
  override update(): void {
    super.update();
    this.totalCells = this.#columns * this.#cellsPerColumn;
    this.allocatedCells = 0;
    this.grid = new Array(this.#columns);
    this.arraysCreated = 1;

    for (const entity of this.entities) {
      const { min, max } = entity.getAABB();
      const lastColumn = this.columnOf(max[0]);
      const firstCell = this.cellOf(min[1]);
      const lastCell = this.cellOf(max[1]);

      for (let col = this.columnOf(min[0]); col <= lastColumn; col++) {
        if (!this.grid[col]) {
          this.grid[col] = [];
          this.arraysCreated++;
        }
        const column = this.grid[col];

        for (let cell = firstCell; cell <= lastCell; cell++) {
          if (!column[cell]) {
            column[cell] = [];
            this.arraysCreated++;
            this.allocatedCells++;
          }
          column[cell].push(entity);
        }
      }
    }
  }

  /** Tests the entities of every occupied cell against each other, each pair once. */
  queryForCollisionPairs(): Pair<E>[] {
    this.refresh();
    const pairs: Pair<E>[] = [];
    const checked = new Set<string>();
    this.collisionTests = 0;
    this.hashChecks = 0;

    this.#forEachCell((entities) => {
      for (let i = 0; i < entities.length; i++) {
        for (let j = i + 1; j < entities.length; j++) {
          const entityA = entities[i];
          const entityB = entities[j];
          const hashA = `${entityA._roId}:${entityB._roId}`;
          const hashB = `${entityB._roId}:${entityA._roId}`;

          this.hashChecks++;
          if (checked.has(hashA) || checked.has(hashB)) continue;
          checked.add(hashA);
          checked.add(hashB);

          this.collisionTests++;
          if (this.aabb2DIntersection(entityA, entityB)) pairs.push([entityA, entityB]);
        }
      }
    });

    return pairs;
  }

  /**
   * Strokes the outline of every occupied cell.
   *
   * @example
   * // In a world with a canvas, `debug: true` does so in each step.
   * const world = new World(null, { coltech: new coltech.SpatialGrid(0, 0, 100, 100, 10), debug: true });
   * world.step(); // → undefined
   */
  draw(ctx: CanvasRenderingContext2D): void {
    const { x: width, y: height } = this.#pxCellSize;
    this.#forEachCell((_, col, cell) => {
      ctx.strokeRect(this.min.x + col * width, this.min.y + cell * height, width, height);
    });
  }

  /** `forEach` skips the columns and cells that were never made. */
  #forEachCell(visit: (entities: E[], col: number, cell: number) => void): void {
    this.grid.forEach((column, col) => {
      column.forEach((entities, cell) => {
        visit(entities, col, cell);
      });
    });
  }
}

// A grid in which every entity has one home cell, that of its upper left corner. A query searches the cells nearby.
//
// Building it takes one entry per entity, of any size. The query pays for that: the home of a partner that reaches in
// from the left or from above may be as far away as the largest box is wide or high. So every search extends that
// far, and a single giant makes all of them wide.
import { coltech, type Entity } from 'broadphase/ro';

export class HomeCellGrid extends coltech.EntityList {
  /** Cells visited by the last query. */
  lookUps = 0;
  readonly cellSize: number;
  readonly #cells = new Map<string, Entity[]>();
  /** The width of the widest box and the height of the tallest. */
  #largest: [width: number, height: number] = [0, 0];

  constructor(cellSize: number) {
    super();
    this.cellSize = cellSize;
  }

  override update(): void {
    super.update();
    this.#cells.clear();
    this.#largest = [0, 0];

    for (const entity of this.entities) {
      const { min, max } = entity.getAABB();
      const name = this.#nameOf(this.#cellAt(min[0]), this.#cellAt(min[1]));
      const cell = this.#cells.get(name);
      if (cell) cell.push(entity);
      else this.#cells.set(name, [entity]);

      this.#largest[0] = Math.max(this.#largest[0], max[0] - min[0]);
      this.#largest[1] = Math.max(this.#largest[1], max[1] - min[1]);
    }

    this.allocatedCells = this.#cells.size;
  }

  /** The cells that may be home to a partner of this entity: first and last column, first and last row. */
  searchArea(entity: Entity): [left: number, top: number, right: number, bottom: number] {
    const { min, max } = entity.getAABB();
    const [width, height] = this.#largest;
    return [this.#cellAt(min[0] - width), this.#cellAt(min[1] - height), this.#cellAt(max[0]), this.#cellAt(max[1])];
  }

  /** The entities whose home is a cell. */
  at(column: number, row: number): readonly Entity[] {
    return this.#cells.get(this.#nameOf(column, row)) ?? [];
  }

  queryForCollisionPairs(): coltech.Pair<Entity>[] {
    const pairs: coltech.Pair<Entity>[] = [];
    this.collisionTests = this.lookUps = 0;

    for (const entity of this.entities) {
      const [left, top, right, bottom] = this.searchArea(entity);
      for (let column = left; column <= right; column++) {
        for (let row = top; row <= bottom; row++) {
          this.lookUps++;
          for (const other of this.at(column, row)) {
            // Each would find the other: only the newer one does, so no table of tested pairs is needed.
            if (other._roId >= entity._roId) continue;
            this.collisionTests++;
            if (this.aabb2DIntersection(other, entity)) pairs.push([other, entity]);
          }
        }
      }
    }

    return pairs;
  }

  #cellAt(position: number): number {
    return Math.floor(position / this.cellSize);
  }

  #nameOf(column: number, row: number): string {
    return `${column}:${row}`;
  }
}

// A retained spatial grid: from one step to the next most boxes stay in their cells, and only the others are moved.
//
// The price is state. Besides each cell's list of entities there is, for each entity, the stretch of cells that list
// it. Both have to be right after every move. The gain: a box that moves within its cells costs one comparison, and
// nothing is thrown away.
import { coltech, type Entity } from 'broadphase/ro';

/** The cells under a box: from the left column to the right one, from the top row to the bottom one. */
interface Stretch {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

interface Cell {
  column: number;
  row: number;
  entities: Entity[];
}

export class RetainedGrid extends coltech.EntityList {
  /** Entities that the last update took out of a cell or put into one. */
  moved = 0;
  /** The cells of these changes, once for each entity put in or taken out. */
  changes: Cell[] = [];
  /** The number of entries: a grid that is rebuilt writes as many in every update. */
  entries = 0;
  readonly cellSize: number;
  readonly #cells = new Map<string, Cell>();
  readonly #stretches = new Map<Entity, Stretch>();

  constructor(cellSize: number) {
    super();
    this.cellSize = cellSize;
  }

  override removeEntity(entity: Entity): void {
    super.removeEntity(entity);
    const stretch = this.#stretches.get(entity);
    if (stretch) this.#forEachCell(stretch, (column, row) => this.#leave(entity, column, row));
    this.#stretches.delete(entity);
  }

  override update(): void {
    super.update();
    this.moved = 0;
    this.changes = [];

    for (const entity of this.entities) {
      const before = this.#stretches.get(entity);
      const now = this.#stretchOf(entity);
      if (before && isSame(before, now)) continue; // most boxes, most of the time

      if (before) {
        this.#forEachCell(before, (column, row) => {
          if (!isIn(now, column, row)) this.#leave(entity, column, row);
        });
      }
      this.#forEachCell(now, (column, row) => {
        if (!before || !isIn(before, column, row)) this.#enter(entity, column, row);
      });
      this.#stretches.set(entity, now);
      this.moved++;
    }

    this.allocatedCells = this.#cells.size;
  }

  queryForCollisionPairs(): coltech.Pair<Entity>[] {
    const pairs: coltech.Pair<Entity>[] = [];
    this.collisionTests = 0;

    for (const { column, row, entities } of this.#cells.values()) {
      for (let i = 0; i < entities.length; i++) {
        for (let j = i + 1; j < entities.length; j++) {
          const a = entities[i];
          const b = entities[j];
          // Two boxes may share many cells, but only one is the first they share. Testing them there, and nowhere
          // else, is what the table of tested pairs was for.
          const stretchA = this.#stretches.get(a)!;
          const stretchB = this.#stretches.get(b)!;
          if (column !== Math.max(stretchA.left, stretchB.left) || row !== Math.max(stretchA.top, stretchB.top))
            continue;

          this.collisionTests++;
          if (this.aabb2DIntersection(a, b)) pairs.push(a._roId < b._roId ? [a, b] : [b, a]);
        }
      }
    }

    return pairs;
  }

  #stretchOf(entity: Entity): Stretch {
    const { min, max } = entity.getAABB();
    return {
      left: Math.floor(min[0] / this.cellSize),
      top: Math.floor(min[1] / this.cellSize),
      right: Math.floor(max[0] / this.cellSize),
      bottom: Math.floor(max[1] / this.cellSize),
    };
  }

  #forEachCell({ left, top, right, bottom }: Stretch, visit: (column: number, row: number) => void): void {
    for (let column = left; column <= right; column++) {
      for (let row = top; row <= bottom; row++) visit(column, row);
    }
  }

  #enter(entity: Entity, column: number, row: number): void {
    const name = `${column}:${row}`;
    let cell = this.#cells.get(name);
    if (!cell) {
      cell = { column, row, entities: [] };
      this.#cells.set(name, cell);
    }
    cell.entities.push(entity);
    this.entries++;
    this.changes.push(cell);
  }

  #leave(entity: Entity, column: number, row: number): void {
    const name = `${column}:${row}`;
    const cell = this.#cells.get(name)!;
    cell.entities.splice(cell.entities.indexOf(entity), 1);
    if (cell.entities.length === 0) this.#cells.delete(name);
    this.entries--;
    this.changes.push(cell);
  }
}

const isSame = (a: Stretch, b: Stretch) =>
  a.left === b.left && a.top === b.top && a.right === b.right && a.bottom === b.bottom;

const isIn = (stretch: Stretch, column: number, row: number) =>
  column >= stretch.left && column <= stretch.right && row >= stretch.top && row <= stretch.bottom;

// Records what the engine's techniques do, operation by operation, while they really run.
//
// The code shown beside the steps is the code that ran: nothing is simulated. The technique's public fields are
// replaced by watched ones, and its arrays by proxies that report reads and writes.
import { type AABB, coltech, type Entity, Entity as RoEntity, type Screen, World } from 'broadphase/ro';

/** x, y, width, height. */
export type Box = readonly [x: number, y: number, width: number, height: number];

/** A technique with the entities of these boxes, numbered in their order. */
function filled<T extends coltech.EntityList<Entity>>(technique: T, boxes: readonly Box[]): T {
  const world = new World(null, { coltech: technique });
  for (const box of boxes) world.addEntity(new RoEntity(...box));
  return technique;
}

/** Calls `changed` with every value that the property is set to, and stores what `changed` returns. */
function watch<T extends object, K extends keyof T>(target: T, key: K, changed: (value: T[K]) => T[K]): void {
  let value = target[key];
  Object.defineProperty(target, key, {
    configurable: true,
    get: () => value,
    set(next: T[K]) {
      value = changed(next);
    },
  });
}

const isIndex = (key: string | symbol): key is string => typeof key === 'string' && /^\d+$/.test(key);

/** An array that reports reads and writes of its elements; `write` may replace what is written. */
function spy<T>(array: T[], { read, write }: { read?(index: number): void; write?(index: number, value: T): T }): T[] {
  return new Proxy(array, {
    get(target, key) {
      if (read && isIndex(key)) read(Number(key));
      return Reflect.get(target, key);
    },
    set(target, key, value) {
      return Reflect.set(target, key, write && isIndex(key) ? write(Number(key), value) : value);
    },
  });
}

// Brute force.

export type BruteForceOperation =
  | { kind: 'outer'; i: number; tests: number; pairs: number }
  | { kind: 'inner'; i: number; j: number; tests: number; pairs: number }
  | { kind: 'count'; i: number; j: number; tests: number; pairs: number }
  | { kind: 'test'; i: number; j: number; tests: number; pairs: number; hit: boolean };

/** Every operation of `BruteForce.queryForCollisionPairs` on these boxes. */
export function recordBruteForce(boxes: readonly Box[]): BruteForceOperation[] {
  const technique = filled(new coltech.BruteForce(), boxes);
  const operations: BruteForceOperation[] = [];
  const { entities } = technique;
  const totals = { tests: 0, pairs: 0 };
  let i = -1;
  let j = entities.length;

  // Both loops read the length before each iteration: the inner one until it ends, then the outer one.
  Object.defineProperty(technique, 'entities', {
    get: () =>
      new Proxy(entities, {
        get(target, key) {
          if (key === 'length') {
            if (j < entities.length) {
              j++;
              operations.push({ kind: 'inner', i, j, ...totals });
            } else {
              i++;
              j = i;
              operations.push({ kind: 'outer', i, ...totals });
            }
          }
          return Reflect.get(target, key);
        },
      }),
  });
  watch(technique, 'collisionTests', (tests) => {
    totals.tests = tests;
    if (tests > 0) operations.push({ kind: 'count', i, j, ...totals });
    return tests;
  });
  const test = technique.aabb2DIntersection;
  technique.aabb2DIntersection = (a, b) => {
    const hit = test.call(technique, a, b);
    if (hit) totals.pairs++;
    operations.push({ kind: 'test', i: a._roId, j: b._roId, ...totals, hit });
    return hit;
  };
  technique.queryForCollisionPairs();
  return operations;
}

// The grid: population and query.

/** A place in the grid. */
export interface Place {
  col: number;
  cell: number;
}

export type PopulationOperation =
  | { kind: 'grid' }
  | { kind: 'entity'; id: number }
  | { kind: 'span'; id: number; first: Place; last: Place }
  | { kind: 'column'; id: number; col: number }
  | ({ kind: 'cell'; id: number } & Place)
  | ({ kind: 'insert'; id: number } & Place);

export type QueryOperation =
  | ({ kind: 'visit'; ids: readonly number[] } & Place)
  | ({ kind: 'lookup'; a: number; b: number; known: boolean } & Place)
  | ({ kind: 'mark'; a: number; b: number } & Place)
  | ({ kind: 'test'; a: number; b: number; hit: boolean } & Place);

/** The size of the world that a grid covers, from 0, and of its cells. */
export interface GridSize {
  width: number;
  height: number;
  cellSize: number;
}

/** A filled cell, and the entities in it. */
type FilledCell = Place & { ids: number[] };

export interface GridRecord {
  population: readonly PopulationOperation[];
  query: readonly QueryOperation[];
  /** The cells that were filled. */
  cells: readonly FilledCell[];
}

/** Every operation of `SpatialGrid.update` and of the query after it, and the cells that it filled. */
export function recordGrid(boxes: readonly Box[], { width, height, cellSize }: GridSize): GridRecord {
  const technique = filled(new coltech.SpatialGrid(0, 0, width, height, cellSize), boxes);
  const recorder = new GridRecorder();
  recorder.watchPopulation(technique);
  technique.update();
  recorder.watchQuery(technique);
  technique.queryForCollisionPairs();
  return recorder;
}

class GridRecorder implements GridRecord {
  readonly population: PopulationOperation[] = [];
  readonly query: QueryOperation[] = [];
  readonly cells: FilledCell[] = [];
  #populating = true;
  #id = -1;
  #here: Place = { col: 0, cell: 0 };
  /** The ids last read from a cell: the current pair. */
  #a = -1;
  #b = -1;

  watchPopulation(technique: coltech.SpatialGrid): void {
    const { entities, columnOf, cellOf } = technique;
    Object.defineProperty(technique, 'entities', {
      get: () =>
        spy(entities as Entity[], {
          read: (index) => {
            this.#id = entities[index]._roId;
            this.population.push({ kind: 'entity', id: this.#id });
          },
        }),
    });

    // The four ends are read in the order right, top, bottom, left; the last one completes the span.
    const asked: number[] = [];
    const ask = (index: number) => {
      if (asked.push(index) < 4) return index;
      const [lastCol, firstCell, lastCell, firstCol] = asked.splice(0);
      const first = { col: firstCol, cell: firstCell };
      this.population.push({ kind: 'span', id: this.#id, first, last: { col: lastCol, cell: lastCell } });
      return index;
    };
    technique.columnOf = (x) => ask(columnOf.call(technique, x));
    technique.cellOf = (y) => ask(cellOf.call(technique, y));

    watch(technique, 'grid', (grid) => {
      this.population.push({ kind: 'grid' });
      return spy(grid, {
        write: (col) => {
          this.population.push({ kind: 'column', id: this.#id, col });
          return this.#watchedColumn(col);
        },
      });
    });
  }

  #watchedColumn(col: number): Entity[][] {
    return spy<Entity[]>([], {
      read: (cell) => {
        if (this.#populating) return;
        this.#here = { col, cell };
        const { ids } = this.cells.find((each) => each.col === col && each.cell === cell)!;
        this.query.push({ kind: 'visit', ids, ...this.#here });
      },
      write: (cell) => {
        this.population.push({ kind: 'cell', id: this.#id, col, cell });
        return this.#watchedCell({ col, cell });
      },
    });
  }

  #watchedCell(place: Place): Entity[] {
    const ids: number[] = [];
    this.cells.push({ ...place, ids });
    return spy<Entity>([], {
      read: (index) => {
        this.#a = this.#b;
        this.#b = ids[index];
      },
      write: (_, entity) => {
        ids.push(entity._roId);
        this.population.push({ kind: 'insert', id: this.#id, ...place });
        return entity;
      },
    });
  }

  watchQuery(technique: coltech.SpatialGrid): void {
    this.#populating = false;
    const now = () => ({ a: this.#a, b: this.#b, ...this.#here });
    watch(technique, 'hashChecks', (checks) => {
      // If no test follows, the pair was in the table.
      if (checks > 0) this.query.push({ kind: 'lookup', known: true, ...now() });
      return checks;
    });
    watch(technique, 'collisionTests', (tests) => {
      const last = this.query.at(-1);
      if (tests > 0 && last?.kind === 'lookup') {
        last.known = false;
        this.query.push({ kind: 'mark', ...now() });
      }
      return tests;
    });
    const test = technique.aabb2DIntersection;
    technique.aabb2DIntersection = (entityA, entityB) => {
      const hit = test.call(technique, entityA, entityB);
      this.query.push({ kind: 'test', hit, ...now() });
      return hit;
    };
  }
}

// The world: the eight stages of a step.

export const stages = [
  'clear',
  'draw',
  'accelerate',
  'update',
  'query',
  'handleCollisions',
  'inertia',
  'user-update',
] as const;
export type Stage = (typeof stages)[number];

/** The state at the end of a stage. */
export interface StageRecord {
  stage: Stage;
  /** Which step of the world, from 1. */
  step: number;
  entities: { pos: Box; ppos: readonly [x: number, y: number]; aabb: AABB; accel: readonly [number, number] }[];
  /** What is on the screen: the boxes as they were when they were drawn. */
  drawn: { box: Box; hit: boolean }[];
  /** The filled cells, as x, y, width, height. */
  cells: Box[];
  pairs: readonly (readonly [number, number])[];
}

/** A box at the start, and how far it moves in a step. */
interface Start {
  box: Box;
  velocity: readonly [x: number, y: number];
}

const gravity = 0.0016;

/** Every stage of some steps of a world of bouncing boxes, `width` by `height`, on a grid. */
export function recordStages(starts: readonly Start[], size: GridSize, steps: number): StageRecord[] {
  const recorder = new StageRecorder(size);
  for (const start of starts) recorder.add(start);
  for (let step = 1; step <= steps; step++) recorder.run(step);
  return recorder.records;
}

const boxOf = ({ pos, size }: Entity): Box => [pos.x, pos.y, size.x, size.y];

/** What an entity is like at the end of a stage. */
function stateOf(entity: Entity): StageRecord['entities'][number] {
  const { min, max } = entity.getAABB();
  const { ppos, accel } = entity;
  return {
    pos: boxOf(entity),
    ppos: [ppos.x, ppos.y],
    aabb: { min: [...min], max: [...max] },
    accel: [accel.x, accel.y],
  };
}

/** Turns back an entity that is beyond a wall, with its speed: puts it on the wall, as if it came from outside. */
function bounce({ pos, ppos, size }: Entity, axis: 'x' | 'y', length: number): void {
  const velocity = pos[axis] - ppos[axis];
  const wall = Math.min(Math.max(pos[axis], 0), length - size[axis]);
  if (wall === pos[axis]) return;
  pos[axis] = wall;
  ppos[axis] = wall + velocity;
}

/** A world that records each stage when the next one begins. */
class StageRecorder {
  readonly records: StageRecord[] = [];
  readonly #world: World;
  #stage: Stage | undefined;
  #step = 0;
  #drawn: StageRecord['drawn'] = [];
  #pairs: StageRecord['pairs'] = [];
  #cells: Box[] = [];

  constructor({ width, height, cellSize }: GridSize) {
    const recorder = this;
    const grid = new coltech.SpatialGrid(0, 0, width, height, cellSize);
    this.#world = new World(document.createElement('canvas'), {
      coltech: grid,
      draw() {
        recorder.#begin('draw');
        recorder.#drawn = this.entities.map((entity) => ({ box: boxOf(entity), hit: false }));
      },
      handleCollisions(_dt, found) {
        recorder.#begin('handleCollisions');
        for (const entity of new Set(found.flat())) recorder.#drawn.push({ box: boxOf(entity), hit: true });
      },
      update() {
        recorder.#begin('user-update');
        for (const entity of this.entities) {
          bounce(entity, 'x', width);
          bounce(entity, 'y', height);
          entity.accel.y = gravity;
        }
      },
    });
    this.#watchScreen(this.#world.screen!);
    this.#watchGrid(grid, cellSize);
  }

  add({ box, velocity }: Start): void {
    const entity = new RoEntity(...box);
    entity.ppos = { x: box[0] - velocity[0], y: box[1] - velocity[1] };
    entity.accel.y = gravity;
    const { accelerate, inertia } = entity;
    entity.accelerate = (dt) => {
      this.#begin('accelerate');
      accelerate.call(entity, dt);
    };
    entity.inertia = (dt) => {
      this.#begin('inertia');
      inertia.call(entity, dt);
    };
    this.#world.addEntity(entity);
  }

  run(step: number): void {
    this.#step = step;
    this.#world.step();
    this.#close();
  }

  /** Ends the previous stage, unless it is this one. */
  #begin(stage: Stage): void {
    if (this.#stage === stage) return;
    this.#close();
    this.#stage = stage;
  }

  #close(): void {
    if (!this.#stage) return;
    this.records.push({
      stage: this.#stage,
      step: this.#step,
      entities: this.#world.entities.map(stateOf),
      drawn: [...this.#drawn],
      cells: this.#cells,
      pairs: this.#pairs,
    });
    this.#stage = undefined;
  }

  #watchScreen(screen: Screen): void {
    const { clear } = screen;
    screen.clear = () => {
      this.#begin('clear');
      this.#drawn = [];
      this.#pairs = [];
      this.#cells = [];
      clear.call(screen);
    };
  }

  #watchGrid(grid: coltech.SpatialGrid, cellSize: number): void {
    const { update, queryForCollisionPairs } = grid;
    grid.update = () => {
      this.#begin('update');
      update.call(grid);
      this.#cells = grid.grid.flatMap((column, col) =>
        column.map((_, cell): Box => [col * cellSize, cell * cellSize, cellSize, cellSize]).filter(Boolean),
      );
    };
    grid.queryForCollisionPairs = () => {
      this.#begin('query');
      const found = queryForCollisionPairs.call(grid);
      this.#pairs = found.map(([a, b]) => [a._roId, b._roId]);
      return found;
    };
  }
}

// Adding an entity.

export type AddingOperation = 'asked' | 'aabb' | 'id' | 'technique' | 'uniq' | 'world' | 'done';

/** Adds an entity to a world, and returns the operations of `World.addEntity` in order. */
export function recordAdding(world: World, entity: Entity): AddingOperation[] {
  const operations: AddingOperation[] = ['asked'];
  const { updateAABB } = entity;
  entity.updateAABB = () => {
    operations.push('aabb');
    updateAABB.call(entity);
  };
  const log =
    <T>(operation: AddingOperation) =>
    (value: T) => {
      operations.push(operation);
      return value;
    };
  watch(entity, '_roId', log('id'));
  watch(entity, 'world', log('world'));
  const technique = world.broadPhase;
  const { addEntity } = technique;
  technique.addEntity = (added) => {
    operations.push('technique');
    addEntity.call(technique, added);
  };
  watch(world, 'uniq', log('uniq'));
  world.addEntity(entity);
  Object.defineProperty(world, 'uniq', { configurable: true, writable: true, value: world.uniq });
  technique.addEntity = addEntity;
  entity.updateAABB = updateAABB;
  return [...operations, 'done'];
}

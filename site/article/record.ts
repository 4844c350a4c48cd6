// Records what the engine's techniques do, operation by operation, while they really run.
//
// The code shown beside the steps is the code that ran: nothing is simulated. The technique's public fields are
// replaced by watched ones, and its arrays by proxies that report reads and writes.
import { type AABB, coltech, type Entity, Entity as RoEntity, World } from 'broadphase/ro';

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
  | ({ kind: 'look-up'; a: number; b: number; known: boolean } & Place)
  | ({ kind: 'mark'; a: number; b: number } & Place)
  | ({ kind: 'test'; a: number; b: number; hit: boolean } & Place);

/** The size of the world that a grid covers, from 0, and of its cells. */
export interface GridSize {
  width: number;
  height: number;
  cellSize: number;
}

/** Every operation of `SpatialGrid.update` and of the query after it, and the cells that it filled. */
export function recordGrid(
  boxes: readonly Box[],
  { width, height, cellSize }: GridSize,
): { population: PopulationOperation[]; query: QueryOperation[]; cells: readonly (Place & { ids: number[] })[] } {
  const technique = filled(new coltech.SpatialGrid(0, 0, width, height, cellSize), boxes);
  const population: PopulationOperation[] = [];
  const query: QueryOperation[] = [];
  const cells: (Place & { ids: number[] })[] = [];
  let populating = true;
  let id = -1;
  let here: Place = { col: 0, cell: 0 };
  /** The ids last read from a cell: the current pair. */
  let a = -1;
  let b = -1;

  const { entities } = technique;
  Object.defineProperty(technique, 'entities', {
    get: () =>
      spy(entities as Entity[], {
        read(index) {
          id = entities[index]._roId;
          population.push({ kind: 'entity', id });
        },
      }),
  });

  // The four ends are read in the order right, top, bottom, left; the last one completes the span.
  const asked: number[] = [];
  const ask = (index: number) => {
    if (asked.push(index) < 4) return index;
    const [lastCol, firstCell, lastCell, firstCol] = asked.splice(0);
    population.push({
      kind: 'span',
      id,
      first: { col: firstCol, cell: firstCell },
      last: { col: lastCol, cell: lastCell },
    });
    return index;
  };
  const { columnOf, cellOf } = technique;
  technique.columnOf = (x) => ask(columnOf.call(technique, x));
  technique.cellOf = (y) => ask(cellOf.call(technique, y));

  const watchedCell = (place: Place) => {
    const ids: number[] = [];
    cells.push({ ...place, ids });
    return spy<Entity>([], {
      read(index) {
        a = b;
        b = ids[index];
      },
      write(_, entity) {
        ids.push(entity._roId);
        population.push({ kind: 'insert', id, ...place });
        return entity;
      },
    });
  };
  const watchedColumn = (col: number) =>
    spy<Entity[]>([], {
      read(cell) {
        if (populating) return;
        here = { col, cell };
        const ids = cells.find((each) => each.col === col && each.cell === cell)!.ids;
        query.push({ kind: 'visit', ids, ...here });
      },
      write(cell) {
        population.push({ kind: 'cell', id, col, cell });
        return watchedCell({ col, cell });
      },
    });
  watch(technique, 'grid', (grid) => {
    population.push({ kind: 'grid' });
    return spy(grid, {
      write(col) {
        population.push({ kind: 'column', id, col });
        return watchedColumn(col);
      },
    });
  });
  technique.update();

  populating = false;
  watch(technique, 'hashChecks', (checks) => {
    // If no test follows, the pair was in the table.
    if (checks > 0) query.push({ kind: 'look-up', a, b, known: true, ...here });
    return checks;
  });
  watch(technique, 'collisionTests', (tests) => {
    const last = query.at(-1);
    if (tests > 0 && last?.kind === 'look-up') {
      last.known = false;
      query.push({ kind: 'mark', a, b, ...here });
    }
    return tests;
  });
  const test = technique.aabb2DIntersection;
  technique.aabb2DIntersection = (entityA, entityB) => {
    const hit = test.call(technique, entityA, entityB);
    query.push({ kind: 'test', a, b, hit, ...here });
    return hit;
  };
  technique.queryForCollisionPairs();
  return { population, query, cells };
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

/** Every stage of some steps of a world of bouncing boxes, `width` by `height`, on a grid. */
export function recordStages(
  starts: readonly { box: Box; velocity: readonly [number, number] }[],
  { width, height, cellSize }: GridSize,
  steps: number,
): StageRecord[] {
  const records: StageRecord[] = [];
  const gravity = 0.0016;
  const grid = new coltech.SpatialGrid(0, 0, width, height, cellSize);
  const canvas = document.createElement('canvas');
  let stage: Stage | undefined;
  let step = 0;
  let drawn: StageRecord['drawn'] = [];
  let pairs: StageRecord['pairs'] = [];
  let cells: Box[] = [];

  const boxOf = ({ pos, size }: Entity): Box => [pos.x, pos.y, size.x, size.y];
  const close = () => {
    if (!stage) return;
    records.push({
      stage,
      step,
      entities: world.entities.map((entity) => {
        const { min, max } = entity.getAABB();
        const { ppos, accel } = entity;
        return {
          pos: boxOf(entity),
          ppos: [ppos.x, ppos.y],
          aabb: { min: [...min], max: [...max] },
          accel: [accel.x, accel.y],
        };
      }),
      drawn: [...drawn],
      cells,
      pairs,
    });
    stage = undefined;
  };
  /** Ends the previous stage, unless it is this one. */
  const begin = (next: Stage) => {
    if (stage === next) return;
    close();
    stage = next;
  };

  const world: World = new World(canvas, {
    coltech: grid,
    draw() {
      begin('draw');
      drawn = this.entities.map((entity) => ({ box: boxOf(entity), hit: false }));
    },
    handleCollisions(_dt, found) {
      begin('handleCollisions');
      for (const entity of new Set(found.flat())) drawn.push({ box: boxOf(entity), hit: true });
    },
    update() {
      begin('user-update');
      for (const entity of this.entities) {
        bounce(entity, 'x', width);
        bounce(entity, 'y', height);
        entity.accel.y = gravity;
      }
    },
  });

  /** Turns back an entity that is beyond a wall, with its speed: puts it on the wall, as if it came from outside. */
  const bounce = ({ pos, ppos, size }: Entity, axis: 'x' | 'y', length: number) => {
    const velocity = pos[axis] - ppos[axis];
    const wall = Math.min(Math.max(pos[axis], 0), length - size[axis]);
    if (wall === pos[axis]) return;
    pos[axis] = wall;
    ppos[axis] = wall + velocity;
  };

  const { clear } = world.screen!;
  world.screen!.clear = () => {
    begin('clear');
    drawn = [];
    pairs = [];
    cells = [];
    clear.call(world.screen);
  };
  const { update, queryForCollisionPairs } = grid;
  grid.update = () => {
    begin('update');
    update.call(grid);
    cells = grid.grid.flatMap((column, col) =>
      column.map((_, cell): Box => [col * cellSize, cell * cellSize, cellSize, cellSize]).filter(Boolean),
    );
  };
  grid.queryForCollisionPairs = () => {
    begin('query');
    const found = queryForCollisionPairs.call(grid);
    pairs = found.map(([a, b]) => [a._roId, b._roId]);
    return found;
  };

  for (const { box, velocity } of starts) {
    const entity = new RoEntity(...box);
    entity.ppos = { x: box[0] - velocity[0], y: box[1] - velocity[1] };
    entity.accel.y = gravity;
    const { accelerate, inertia } = entity;
    entity.accelerate = (dt) => {
      begin('accelerate');
      accelerate.call(entity, dt);
    };
    entity.inertia = (dt) => {
      begin('inertia');
      inertia.call(entity, dt);
    };
    world.addEntity(entity);
  }
  for (step = 1; step <= steps; step++) {
    world.step();
    close();
  }
  return records;
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

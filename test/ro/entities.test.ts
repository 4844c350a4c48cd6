// Entities that come and go, the technique that finds their pairs, and what is refused.
import * as ro from 'broadphase/ro';
import { describe, expect, test, vi } from 'vitest';
import { rings } from '../../site/article/demos/rings.ts';
import { FakeCanvas } from './fake-canvas.ts';
import { keys, squares } from './scene.ts';

const { BroadPhase, BruteForce, SpatialGrid } = ro.coltech;

const techniques: [name: string, make: () => ro.coltech.EntityList][] = [
  ['BruteForce', () => new BruteForce()],
  ['SpatialGrid', () => new SpatialGrid(0, 0, 100, 100, 15)],
  ['BroadPhase', () => new BroadPhase()],
];

describe.each(techniques)('entities that come and go, with %s', (_, make) => {
  test('get an id that no other ever had, and the world, when they are added', () => {
    const world = squares(make(), 3, () => [0, 0]);
    const [first, , last] = world.entities;
    expect(world.entities.map((entity) => entity._roId)).toEqual([0, 1, 2]);
    expect(first.world).toBe(world);
    world.removeEntity(last);
    expect(last.world).toBe(null);
    world.addEntity(last);
    expect(last._roId).toBe(3);
  });

  test('are where they are when they are added, not where they were made', () => {
    const technique = make();
    const world = squares(technique, 1, () => [0, 0]);
    const entity = new ro.Entity(500, 500, 10, 10);
    entity.pos = { x: 5, y: 5 };
    world.addEntity(entity);
    technique.update();
    expect(keys(technique.queryForCollisionPairs())).toEqual(['0:1']);
  });

  test('may be removed while pairs, the entities, or a step are gone through', () => {
    const technique = make();
    class Fleeting extends ro.Entity {
      override inertia(dt: number): void {
        super.inertia(dt);
        if (this._roId === 4) this.world?.removeEntity(this);
        if (this._roId === 5 && next.world) this.world?.removeEntity(next);
        if (this._roId === 6) expect.unreachable('it was removed before its turn');
      }
    }
    const world = new ro.World(null, {
      coltech: technique,
      handleCollisions(_dt, pairs) {
        for (const [a] of pairs) if (a._roId === 0 && a.world) this.removeEntity(a);
      },
      update() {
        for (const entity of this.entities) if (entity._roId < 3) this.removeEntity(entity);
      },
    });
    for (let i = 0; i < 8; i++) world.addEntity(new Fleeting(i, i, 10, 10));
    const next = world.entities[6];
    world.step();
    expect(world.entities.map((entity) => entity._roId)).toEqual([3, 5, 7]);
    expect(technique.entities).toEqual(world.entities);
    world.step();
    expect(keys(technique.queryForCollisionPairs())).toEqual(['3:5', '3:7', '5:7']);
  });

  test('that are added within a step take part from then on', () => {
    const world = new ro.World(null, { coltech: make() });
    class Mother extends ro.Entity {
      override accelerate(dt: number): void {
        super.accelerate(dt);
        if (world.entities.length < 2) world.addEntity(new Mother(0, 0, 10, 10));
      }
    }
    world.addEntity(new Mother(0, 0, 10, 10));
    world.step();
    expect(world.entities).toHaveLength(2);
    expect(keys(world.broadPhase.queryForCollisionPairs())).toEqual(['0:1']);
  });

  test('cannot be added twice, nor to two worlds', () => {
    const world = squares(make(), 2, () => [0, 0]);
    const [entity] = world.entities;
    expect(() => world.addEntity(entity)).toThrow(/entity 0 is in this world already, expected one that is in none/);
    expect(() => new ro.World(null).addEntity(entity)).toThrow(/entity 0 is in another world already/);
    expect(world.entities).toHaveLength(2);
    expect([entity._roId, world.uniq]).toEqual([0, 2]);
  });

  test('cannot be removed when they are not there; in 2012 the last one went instead', () => {
    const technique = make();
    const world = squares(technique, 2, () => [0, 0]);
    const stranger = new ro.Entity(0, 0, 1, 1);
    expect(() => world.removeEntity(stranger)).toThrow(/entity -1 is not in this world, expected one that was added/);
    expect(() => technique.removeEntity(stranger)).toThrow(/entity -1 is not here, expected one that was added/);
    stranger._roId = 1;
    expect(() => technique.removeEntity(stranger)).toThrow(/entity 1 is not here/);
    expect(world.entities).toHaveLength(2);
    expect(technique.entities).toHaveLength(2);
  });

  test('cannot be anywhere but at a place', () => {
    const technique = make();
    const world = squares(technique, 1, () => [0, 0]);
    const entity = new ro.Entity(0, 0, 1, 1);
    entity.pos.y = Number.NaN;
    expect(() => world.addEntity(entity)).toThrow('ro.Entity: pos is { x: 0, y: NaN }, expected finite numbers');
    expect([entity.world, world.entities.length, technique.entities.length, world.uniq]).toEqual([null, 1, 1, 1]);
    world.entities[0].accel.x = Infinity;
    expect(() => world.step()).toThrow('ro.Entity 0: pos is { x: Infinity, y: 0 }, expected finite numbers');
    expect(world.entities[0].getAABB()).toEqual({ min: [0, 0], max: [10, 10] });
  });

  test('a technique alone refuses a bad box, a bad id, and an id in use', () => {
    const technique = make();
    const box = (_roId: number, min: [number, number], max: [number, number]) =>
      ({ _roId, getAABB: () => ({ min, max }) }) as ro.Entity;
    const good = box(7, [0, 0], [1, 1]);
    technique.addEntity(good);
    expect(() => technique.addEntity(good)).toThrow(/entity 7 is here already, expected one that is not/);
    expect(() => technique.addEntity(box(7, [0, 0], [1, 1]))).toThrow(/another entity has the _roId 7/);
    expect(() => technique.addEntity(box(-1, [0, 0], [1, 1]))).toThrow(/_roId is -1, expected an integer of 0 or more/);
    expect(() => technique.addEntity(box(1.5, [0, 0], [1, 1]))).toThrow(/_roId is 1.5/);
    expect(() => technique.addEntity(box(8, [0, Number.NaN], [1, 1]))).toThrow(/entity 8 has the AABB min \[0, NaN\]/);
    expect(() => technique.addEntity(box(8, [2, 0], [1, 1]))).toThrow(/expected numbers with min <= max on both axes/);
    expect(technique.entities).toEqual([good]);
    good.getAABB().max[1] = Number.NaN;
    expect(() => technique.update()).toThrow(/entity 7 has the AABB/);
  });
});

describe('the technique', () => {
  test('can be changed at any time, and the entities move over', () => {
    const first = new BruteForce();
    const world = squares(first, 5, (i) => [i * 8, 0]);
    world.step();
    const expected = keys(first.queryForCollisionPairs());
    for (const [, make] of techniques) {
      const technique = make();
      const before = world.broadPhase;
      world.broadPhase = technique;
      world.step();
      expect(keys(technique.queryForCollisionPairs())).toEqual(expected);
      expect(before.entities).toEqual([]);
    }
    world.broadPhase = first; // and back
    world.broadPhase = first;
    world.step();
    expect(keys(first.queryForCollisionPairs())).toEqual(expected);
  });

  test('has to be without entities', () => {
    const taken = new BruteForce();
    const world = squares(taken, 5, () => [0, 0]);
    expect(() => new ro.World(null, { coltech: taken })).toThrow(
      /the coltech has 5 entities, expected one without any/,
    );
    const other = new ro.World(null);
    const { broadPhase } = other;
    expect(() => {
      other.broadPhase = taken;
    }).toThrow(/has 5 entities/);
    expect(other.broadPhase).toBe(broadPhase);
    expect(world.entities).toHaveLength(5);
  });
});

describe('the defects of 2012 are gone', () => {
  test('an entity outside the grid is not dropped', () => {
    const grid = new SpatialGrid(0, 0, 100, 100, 10);
    const world = squares(grid, 6, (i) => [[-500, -500, 900, 900, 50, 50][i], [-20, -20, 900, 900, 5000, 5000][i]]);
    world.addEntity(new ro.Entity(-1e6, -1e6, 2e6, 2e6)); // larger than the grid on every side
    world.step();
    expect(keys(grid.queryForCollisionPairs())).toEqual([
      '0:1',
      '0:6',
      '1:6',
      '2:3',
      '2:6',
      '3:6',
      '4:5',
      '4:6',
      '5:6',
    ]);
  });

  test('no global is left behind', () => {
    const before = Object.getOwnPropertyNames(globalThis);
    const { world } = rings(ro, null, new SpatialGrid(0, 0, 400, 300, 14));
    world.step();
    world.broadPhase = new BroadPhase();
    world.step();
    expect(Object.getOwnPropertyNames(globalThis)).toEqual(before);
  });

  test('nothing is written onto entities but _roId and world', () => {
    const technique = new SpatialGrid(0, 0, 100, 100, 10);
    const world = new ro.World(null, { coltech: technique });
    const entity = new ro.Entity(0, 0, 1, 1);
    const before = Object.keys(entity);
    world.addEntity(entity);
    world.step();
    expect(Object.keys(entity)).toEqual(before);
  });
});

describe('the rings demo', () => {
  test('only the movers collide, each with the squares of its own ring', () => {
    const technique = new BruteForce();
    const { world, addRing } = rings(ro, null, technique);
    addRing();
    const movers = world.entities.filter(({ _roId }, _, { length }) => _roId === 6 || _roId === length - 1);
    for (let frame = 0; frame < 200; frame++) {
      world.step();
      for (const pair of technique.queryForCollisionPairs()) {
        expect(pair.filter((square) => movers.includes(square))).toHaveLength(1);
      }
    }
  });

  test('draws the squares, the colliding ones again and darker, and adds a ring at a click', () => {
    const canvas = new FakeCanvas(400, 300);
    const { world } = rings(ro, canvas.asElement(), new SpatialGrid(0, 0, 400, 300, 14));
    const count = world.entities.length;
    canvas.drain();
    world.step();
    const drawn = canvas.drain().filter((name) => name === 'fillRect').length;
    expect(drawn).toBe(count + 2); // the mover begins on the first square
    canvas.fire('click');
    expect(world.entities.length).toBeGreaterThan(2 * count);
  });
});

describe('bad input', () => {
  test.each([Number.NaN, Infinity, -Infinity])('an entity cannot be at %d, nor be that large', (value) => {
    expect(() => new ro.Entity(value, 0, 1, 1)).toThrow(`pos is { x: ${value}, y: 0 }, expected finite numbers`);
    expect(() => new ro.Entity(0, value, 1, 1)).toThrow(RangeError);
    expect(() => new ro.Entity(0, 0, value, 1)).toThrow(`size is { x: ${value}, y: 1 }, expected finite numbers, 0`);
    expect(() => new ro.Entity(0, 0, 1, value)).toThrow(RangeError);
  });

  test('an entity cannot be of negative size', () => {
    expect(() => new ro.Entity(0, 0, -1, 1)).toThrow('size is { x: -1, y: 1 }, expected finite numbers, 0 or more');
  });

  test.each([0, -5, Number.NaN, Infinity])('a cell cannot be %d large, and a refused size changes nothing', (size) => {
    expect(() => new SpatialGrid(0, 0, 10, 10, size)).toThrow(`cellSize is ${size}, expected a finite number above 0`);
    const grid = new SpatialGrid(0, 0, 10, 10, 5);
    expect(() => {
      grid.cellSize = [1, size];
    }).toThrow(`cellSize is 1,${size}, expected`);
    expect(grid.cellSize).toBe(5);
    grid.update();
    expect(grid.totalCells).toBe(4);
  });

  test('cells cannot be so small that their number is beyond reason', () => {
    expect(() => new SpatialGrid(0, 0, 1000, 10, 1e-6)).toThrow(/makes 1000000000 columns.*expected at most 1048576/);
  });

  test.each([
    [0, 0, 0, 10],
    [0, 10, 10, 0],
    [0, 0, Number.NaN, 10],
    [-Infinity, 0, 0, 10],
  ])('the bounds of a grid cannot be %d, %d to %d, %d', (minX, minY, maxX, maxY) => {
    expect(() => new SpatialGrid(minX, minY, maxX, maxY, 5)).toThrow(/the bounds are .*; expected finite numbers/);
  });

  test.each([0, Number.NaN, -1])('a time step cannot be %d', (timeStep) => {
    expect(() => new ro.World(null, { timeStep })).toThrow(`timeStep is ${timeStep}, expected a finite number`);
  });

  test.each([
    [{ scale: -1 }, 'scale is -1, expected a finite number above 0'],
    [{ debug: 1 }, 'debug is 1, expected true or false'],
    [{ update: 5 }, 'update is 5, expected a function'],
    [{ init: 5 }, 'init is 5, expected a function'],
    [{ draw: null }, 'draw is null, expected a function'],
    [{ timeStep: '16' }, 'timeStep is 16, expected a finite number above 0'],
    [{ coltech: 5 }, 'coltech is 5, expected a technique'],
    [{ coltech: null }, 'coltech is null, expected a technique, such as those of ro.coltech'],
    [{ coltech: {} }, 'coltech is [object Object], expected a technique, such as those of ro.coltech'],
  ])('the options of a world cannot be %o', (options, message) => {
    expect(() => new ro.World(null, options as never)).toThrow(message);
  });

  test('nor can its technique be set to something else, nor a step be a string', () => {
    const world = new ro.World(null);
    expect(() => Object.assign(world, { broadPhase: {} })).toThrow('coltech is [object Object], expected a technique');
    expect(() => world.step('16' as never)).toThrow('ro.World: dt is 16, expected a finite number');
    expect(() => new ro.Entity(0, 0, '5' as never, 1)).toThrow('size is');
  });

  test('a canvas has to be one, and an id the id of one', () => {
    expect(() => new ro.World('game')).toThrow(/there is no document to find the canvas "game" in; expected null/);
    vi.stubGlobal('document', { getElementById: (id: string) => (id === 'text' ? {} : null) });
    expect(() => new ro.World('game')).toThrow('no element has the id "game"; expected the id of a <canvas>');
    expect(() => new ro.World('text')).toThrow(/the element with the id "text" is not a canvas; expected a <canvas>/);
    vi.unstubAllGlobals();
    expect(() => new ro.World(undefined as unknown as null)).toThrow(/undefined is not a canvas/);
  });
});

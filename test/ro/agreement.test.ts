// Every technique finds the same pairs: in the demos frame by frame, and in scenes made to break a grid.
import { BroadPhase as Space } from 'broadphase';
import * as ro from 'broadphase/ro';
import { describe, expect, test } from 'vitest';
import { rings } from '../../site/article/demos/rings.ts';
import { keys, random, recordPairs, squares } from './scene.ts';

const { BroadPhase, BruteForce, SpatialGrid } = ro.coltech;

const techniques: [name: string, make: () => ro.coltech.Technique][] = [
  ['SpatialGrid, fitting cells', () => new SpatialGrid(0, 0, 400, 300, 10 * Math.SQRT2)],
  ['SpatialGrid, tiny cells', () => new SpatialGrid(0, 0, 400, 300, 3)],
  ['SpatialGrid, one cell', () => new SpatialGrid(0, 0, 400, 300, 1000)],
  ['SpatialGrid, rectangular cells', () => new SpatialGrid(0, 0, 400, 300, [40, 9])],
  ['SpatialGrid, in a corner of the world', () => new SpatialGrid(350, 250, 400, 300, 12)],
  ...Space.techniques.map((technique): (typeof techniques)[number] => [
    `BroadPhase, ${technique}`,
    () => new BroadPhase({ technique }),
  ]),
];

describe.each(techniques)('%s finds what brute force finds', (_, make) => {
  test('on every frame of the rings demo, with a ring added now and then', () => {
    const run = (technique: ro.coltech.Technique) => {
      const frames = recordPairs(technique);
      const { world, addRing } = rings(ro, null, technique);
      for (let frame = 0; frame < 80; frame++) {
        if (frame % 10 === 9) addRing();
        world.step();
      }
      return frames;
    };
    const expected = run(new BruteForce());
    expect(expected.flat().length).toBeGreaterThan(80);
    expect(run(make())).toEqual(expected);
  });

  test('in a crowd of all sizes, in and far outside the bounds, where entities come and go', () => {
    const run = (technique: ro.coltech.Technique) => {
      const next = random(7);
      const frames = recordPairs(technique);
      const world = new ro.World(null, { coltech: technique });
      for (let frame = 0; frame < 40; frame++) {
        for (let i = 0; i < 4; i++) {
          const size = 10 ** (3 * next() - 0.5);
          const entity = new ro.Entity(1200 * next() - 400, 900 * next() - 300, size, size * next());
          entity.ppos.x -= 8 * next() - 4;
          entity.ppos.y -= 8 * next() - 4;
          world.addEntity(entity);
        }
        if (frame % 3 === 0) world.removeEntity(world.entities[Math.floor(next() * world.entities.length)]);
        world.step();
      }
      return frames;
    };
    const expected = run(new BruteForce());
    expect(expected.flat().length).toBeGreaterThan(1000);
    expect(run(make())).toEqual(expected);
  });

  test('for boxes that touch exactly on the border of a cell, and at the same place', () => {
    const run = (technique: ro.coltech.Technique) => {
      const world = squares(technique, 64, (i) => [(i % 8) * 10, Math.floor(i / 8) * 10]);
      world.addEntity(new ro.Entity(40, 40, 0, 0));
      world.addEntity(new ro.Entity(40, 40, 0, 0));
      world.step();
      return keys(technique.queryForCollisionPairs());
    };
    expect(run(make())).toEqual(run(new BruteForce()));
  });

  test('when it is asked between updates, after boxes met, parted, came and went', () => {
    const run = (technique: ro.coltech.Technique) => {
      const world = squares(technique, 6, (i) => [[0, 12, 100, 108, 200, 205][i], 0]);
      const [, meets, , parts, goes] = world.entities;
      const answers: string[][] = [];
      const ask = () => answers.push(keys(technique.queryForCollisionPairs()));
      ask(); // before the first update
      meets.ppos.x += 5;
      parts.ppos.x -= 5;
      world.step();
      ask();
      world.removeEntity(goes);
      ask();
      world.addEntity(new ro.Entity(206, 0, 10, 10));
      ask();
      meets.pos.x = 300;
      meets.updateAABB();
      ask();
      technique.update();
      world.removeEntity(parts);
      ask();
      return answers;
    };
    const answers = run(make());
    expect(answers).toEqual(run(new BruteForce()));
    expect(answers.slice(0, 4)).toEqual([['2:3', '4:5'], ['0:1', '4:5'], ['0:1'], ['0:1', '5:6']]);
  });
});

describe('coltech.BroadPhase', () => {
  test('gives each pair in the order of adding, also when places were given up and used again', () => {
    const technique = new BroadPhase();
    const world = squares(technique, 8, () => [0, 0]);
    world.step();
    for (const entity of world.entities.slice(0, 4)) world.removeEntity(entity);
    world.step();
    for (let i = 0; i < 4; i++) world.addEntity(new ro.Entity(0, 0, 10, 10));
    world.step();
    const pairs = technique.queryForCollisionPairs();
    expect(pairs).toHaveLength(28);
    expect(pairs.every(([a, b]) => a._roId < b._roId)).toBe(true);
    expect(Math.max(...world.entities.map((entity) => technique.idOf(entity)))).toBe(7);
  });

  test('knows no more of an entity that went, while another took its place', () => {
    const technique = new BroadPhase();
    const world = squares(technique, 3, () => [0, 0]);
    world.step();
    const [first] = world.entities;
    world.removeEntity(first);
    world.addEntity(new ro.Entity(500, 500, 1, 1));
    expect(keys(technique.queryForCollisionPairs())).toEqual(['1:2']);
    expect(() => technique.idOf(first)).toThrow(/entity 0 is not here/);
  });
});

// A sweep or a ray that starts where boxes touch hit at once, whatever its direction: walkers stuck to their floor, and
// Pong stopped at the first wall.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { moveAndBounce, moveAndSlide } from '../../examples/move-and-slide/move-and-slide.mjs';
import { createRandom } from '../../src/scenes/random.ts';

type Numbers = number[] | Float32Array;
interface Body {
  position: Numbers;
  size: Numbers;
}
type Loose = Record<string, (...given: unknown[]) => unknown>;

const player = 0;
const floor = 1;
const wall = 2;
const world = () =>
  new BroadPhase().set(floor, 0, 10, 1000, 20).set(wall, 50, -100, 60, 10).set(player, 0, 0, 10, 10).update();
const ignore = { ignore: player };

describe('a player who stands on a floor', () => {
  const sweep = (dx: number, dy: number) => world().sweep(0, 0, 10, 10, dx, dy, ignore);

  test('walks to the wall', () => expect(sweep(100, 0)).toEqual({ id: wall, time: 0.4, normal: [-1, 0] }));
  test('jumps', () => expect(sweep(0, -5)).toBeUndefined());
  test('presses down, and stays', () => expect(sweep(0, 5)).toEqual({ id: floor, time: 0, normal: [0, -1] }));
  test('stands', () => expect(sweep(0, 0)).toBeUndefined());
  test('stays where gravity and legs lead into the floor', () =>
    expect(sweep(3, 1)).toEqual({ id: floor, time: 0, normal: [0, -1] }));
  test('jumps aside', () => expect(sweep(3, -1)).toBeUndefined());
  test('at the wall: neither up nor back does it hold', () => {
    const at = (dx: number, dy: number) => world().sweep(40, 0, 50, 10, dx, dy, ignore);
    expect(at(0, -5)).toBeUndefined();
    expect(at(-5, 0)).toBeUndefined();
    expect(at(5, 0)).toEqual({ id: wall, time: 0, normal: [-1, 0] });
    expect(at(-5, -5)).toBeUndefined();
  });
});

test('inside is time 0 without a normal, and out of it there is no second hit', () => {
  const space = new BroadPhase().set(7, 0, 0, 10, 10).update();
  expect(space.sweep(2, 2, 4, 4, 100, 0)).toEqual({ id: 7, time: 0, normal: [0, 0] });
  expect(space.sweep(2, 2, 4, 4, 0, 0)).toEqual({ id: 7, time: 0, normal: [0, 0] });
  expect(space.rayCastAll(5, 5, 1, 0)).toEqual([{ id: 7, distance: 0, normal: [0, 0] }]);
});

test('falling flush along a wall of tiles does not land on each', () => {
  const space = new BroadPhase();
  for (let k = 0; k < 20; k++) space.set(k, 10, 10 * k, 20, 10 * k + 10);
  space.set(99, -50, 150, 50, 160).update();
  expect(space.sweep(0, 0, 10, 10, 0, 1000)).toEqual({ id: 99, time: 0.14, normal: [0, -1] });
  expect(space.sweep(20, 0, 30, 10, 0, 1000)).toEqual({ id: 99, time: 0.14, normal: [0, -1] });
});

test('a shaft exactly as wide as the box lets it through, one less wide does not', () => {
  const space = new BroadPhase().set(0, -10, 0, 0, 10).set(1, 10, 0, 20, 10).update();
  expect(space.sweep(0, -30, 10, -20, 0, 100)).toBeUndefined();
  expect(space.sweep(-0.001, -30, 10, -20, 0, 100)).toEqual({ id: 0, time: 0.2, normal: [0, -1] });
});

// Decided in docs/decisions/0010-where-boxes-touch.md: without a size it would fall between two boxes that touch.
describe.each([2, 3] as const)('a box of zero size hits edges too, as a ray does, in %d dimensions', (dimensions) => {
  const space = new BroadPhase({ dimensions });
  const at = (x: number, y: number, z = 5) => [x, y, z].slice(0, dimensions);
  for (let k = 0; k < 3; k++)
    (space.set as Loose[string]).call(space, k, ...at(10 * k, 10, 0), ...at(10 * k + 10, 20, 10));
  space.update();
  const cases: [string, number[], number[], [number, number, number] | undefined][] = [
    ['stands, in the middle of a tile', [5, 10], [0, 0], undefined],
    ['moves along it', [5, 10], [4, 0], undefined],
    ['leaves the last tile', [25, 10], [40, 0], undefined],
    ['jumps', [10, 10], [1, -1], undefined],
    ['reaches the next tile', [5, 10], [20, 0], [1, 0.25, -1]],
    ['starts at the next tile', [10, 10], [20, 0], [1, 0, -1]],
    ['comes to the first tile', [-5, 10], [20, 0], [0, 0.25, -1]],
  ];
  test.each(cases)('%s', (_, [x, y], [dx, dy], hit) => {
    const asked = [...at(x!, y!), ...at(x!, y!), ...at(dx!, dy!, 0)];
    const [id, time, side] = hit ?? [];
    const normal = [side, 0, 0].slice(0, dimensions);
    expect((space.sweep as Loose[string]).apply(space, asked)).toEqual(hit && { id, time, normal });
    const { ids, times, normals } = space.sweeps(asked);
    expect([[...ids], [...times], [...normals]]).toEqual(hit ? [[id], [time], normal] : [[], [], []]);
  });
  test('and does not fall between two tiles', () => {
    const down = [...at(10, 0), ...at(10, 0), ...at(0, 20, 0)];
    expect((space.sweep as Loose[string]).apply(space, down)).toMatchObject({ id: 0, time: 0.5 });
    expect([...space.sweeps(down).times]).toEqual([0.5]);
  });
});

test('a wall without thickness stops a point that comes to it, but not one that has stopped there', () => {
  const space = new BroadPhase().set(0, 10, 0, 10, 10).update();
  expect(space.sweep(0, 5, 0, 5, 20, 0)).toEqual({ id: 0, time: 0.5, normal: [-1, 0] });
  expect(space.rayCast(0, 5, 1, 0)).toEqual({ id: 0, distance: 10, normal: [-1, 0] });
  expect(space.sweep(10, 5, 10, 5, 20, 0)).toBeUndefined();
  expect(space.rayCast(10, 5, 1, 0)).toBeUndefined();
  expect(space.sweep(9, 5, 10, 5, 20, 0)).toEqual({ id: 0, time: 0, normal: [-1, 0] });
});

test('who walks over a seam of tiles under gravity does not run into the next, whichever has the smaller id', () => {
  for (const [here, next] of [
    [0, 1],
    [1, 0],
  ]) {
    const space = new BroadPhase().set(here, 0, 10, 10, 20).set(next, 10, 10, 20, 20).update();
    expect(space.sweep(0, 0, 10, 10, 3, 2)).toEqual({ id: here, time: 0, normal: [0, -1] });
  }
});

describe('a ray from a touch', () => {
  const space = new BroadPhase().set(1, 0, 0, 10, 10).update();
  const into = (x: number, y: number, dx: number, dy: number) => space.rayCast(x, y, dx, dy);

  test('into the face: at once, with its normal', () => {
    expect(into(0, 5, 1, 0)).toEqual({ id: 1, distance: 0, normal: [-1, 0] });
    expect(into(10, 5, -2, 1)).toEqual({ id: 1, distance: 0, normal: [1, 0] });
    expect(into(5, 10, 0, -1)).toEqual({ id: 1, distance: 0, normal: [0, 1] });
    expect(space.rayCastAll(5, 0, 0, 1)).toEqual([{ id: 1, distance: 0, normal: [0, -1] }]);
  });
  test('along or away: none', () => {
    for (const [dx, dy] of [
      [0, 1],
      [0, -1],
      [-1, 0],
      [-1, 1],
      [0, 0],
      [-0, 5],
    ]) {
      expect(into(0, 5, dx, dy)).toBeUndefined();
      expect(space.rayCastAll(0, 5, dx, dy)).toEqual([]);
    }
  });
  test('from a corner: into the box or none', () => {
    expect(into(0, 0, 1, 1)).toEqual({ id: 1, distance: 0, normal: [-1, 0] });
    for (const [dx, dy] of [
      [-1, 1],
      [1, -1],
      [-1, -1],
      [0, -1],
    ]) {
      expect(into(0, 0, dx, dy)).toBeUndefined();
    }
  });
  test('does not slip between two boxes that touch', () => {
    const tiles = new BroadPhase().set(0, 0, 0, 10, 10).set(1, 10, 0, 20, 10).update();
    expect(tiles.rayCastAll(10, -5, 0, 1).map(({ id }) => id)).toEqual([0, 1]);
    expect(tiles.rayCast(10, 0, 0, 1)).toEqual({ id: 0, distance: 0, normal: [0, -1] });
    const diagonal = new BroadPhase().set(0, 0, 0, 10, 10).set(1, 10, 10, 20, 20).update();
    expect(diagonal.rayCast(5, 15, 1, -1)?.distance).toBeCloseTo(Math.sqrt(50));
  });
  test('a visitor gets the same answers', () => {
    const heard: unknown[] = [];
    space.rayCastAll(0, 5, 0, 1, { visit: (...hit) => heard.push(hit) });
    space.sweep(-5, 0, 0, 5, 0, 9, { visit: (...hit) => heard.push(hit) });
    expect(heard).toEqual([]);
    space.rayCastAll(0, 0, 1, 1, { visit: (id, distance) => heard.push([id, distance]) });
    expect(heard).toEqual([[1, 0]]);
  });
  test('in 3D', () => {
    const solid = new BroadPhase({ dimensions: 3 }).set(1, 0, 0, 0, 10, 10, 10).update();
    expect(solid.rayCast(5, 5, 10, 0, 0, -1)).toEqual({ id: 1, distance: 0, normal: [0, 0, 1] });
    expect(solid.rayCast(5, 5, 10, 1, 1, 0)).toBeUndefined();
    expect(solid.sweep(0, 0, -2, 2, 2, 0, 1, 1, 0)).toBeUndefined();
    expect(solid.sweep(0, 0, -2, 2, 2, 0, 1, 1, 1)).toEqual({ id: 1, time: 0, normal: [0, 0, -1] });
    expect(solid.sweep(10, 0, -2, 12, 2, 0, -1, 0, 1)).toEqual({ id: 1, time: 0, normal: [1, 0, 0] });
  });
});

/** Walls around a room, and tiles of its floor (the second axis points down) and of its walls, in any order of ids. */
function room(space: BroadPhase<2 | 3>, least: number, size: number, tile: number, round: (x: number) => number): void {
  const { dimensions } = space;
  const boxes: number[][] = [];
  const slab = (axis: number, from: number, to: number) => {
    const other = 1 - axis;
    for (let at = least - tile; at < least + size; at += tile) {
      const box = Array<number>(2 * dimensions).fill(least - size);
      box.fill(least + 2 * size, dimensions);
      Object.assign(box, { [axis]: from, [axis + dimensions]: to, [other]: at, [other + dimensions]: at + tile });
      boxes.push(box);
    }
  };
  for (const axis of [0, 1]) {
    slab(axis, least - tile, least);
    slab(axis, least + size, least + size + tile);
  }
  if (dimensions === 3) {
    const end = least + size;
    boxes.push([least, least, least - tile, end, end, least], [least, least, end, end, end, end + tile]);
  }
  const random = createRandom(5);
  boxes.sort(() => random() - 0.5);
  space.setAll(boxes.flat().map(round)).update();
}

const kinds = [
  ['doubles', (numbers: number[]) => [...numbers], (x: number) => x],
  ['float32', (numbers: number[]) => Float32Array.from(numbers), Math.fround],
] as const;
const origins = [0, 1e6, -1e6, -1000, 0.3];
const sizes = [10, 0.7, 1 / 3];

describe.each(kinds)('in %s', (_, array, round) => {
  describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
    test('a ball bounces on and on', () => {
      for (const least of origins) {
        for (const side of sizes) {
          const space = new BroadPhase({ dimensions });
          room(space, least, 1000, 100, round);
          const body: Body = {
            position: array([least + 313, least + 414, least + 515].slice(0, dimensions)),
            size: array([side, side, side].slice(0, dimensions)),
          };
          const velocity = [37.3, 50.1, 411.7].slice(0, dimensions);
          let bounces = 0;
          for (let step = 0; step < 3000; step++) if (moveAndBounce(space, body, velocity, {})) bounces++;
          expect(bounces).toBeGreaterThan(150);
          const slack = Math.abs(least) * 1e-6 + 1e-3;
          for (const x of body.position) {
            expect(x).toBeGreaterThan(least - slack);
            expect(x + side).toBeLessThan(least + 1000 + slack);
          }
        }
      }
    });

    test('a walker falls along a wall, walks over tiles, and stops in the corner', () => {
      for (const least of origins) {
        for (const side of sizes) {
          const space = new BroadPhase({ dimensions });
          room(space, least, 100, 10, round);
          const third = (x: number) => (dimensions === 3 ? [x] : []);
          const body: Body = {
            position: array([least, least + 3, ...third(least + 40)]),
            size: array([side, side, ...third(side)]),
          };
          const slack = Math.abs(least) * 1e-6 + 1e-3;
          const say = `${least} ${side}`;
          let speed = 0;
          let landings = 0;
          for (let step = 0; step < 60; step++) {
            speed += 0.37;
            const met = moveAndSlide(space, body, [-0.37, speed, ...third(0)], {});
            expect(met[0], say).toBe(1);
            if (met[1] === 0) continue;
            landings++;
            speed = 0;
          }
          expect(Math.abs(body.position[1] + side - least - 100), say).toBeLessThan(slack);
          expect(landings, say).toBeGreaterThan(30); // once it stands, with every step
          let x = body.position[0];
          for (let step = 0; x + side + 0.37 < least + 100 - slack; step++) {
            const met = moveAndSlide(space, body, [0.37, 0.37, ...third(0)], {});
            expect([...met], `${say} step ${step}`).toEqual([0, -1, ...third(0)]);
            expect(Math.abs(body.position[0] - x - 0.37), say).toBeLessThan(slack);
            x = body.position[0];
          }
          for (let step = 0; step < 10; step++) moveAndSlide(space, body, [0.37, 0.37, ...third(0)], {});
          expect([...moveAndSlide(space, body, [1, 1, ...third(0)], {})]).toEqual([-1, -1, ...third(0)]);
          expect([...moveAndSlide(space, body, [-1, -1, ...third(0)], {})]).toEqual([0, 0, ...third(0)]);
        }
      }
    });
  });
});

test('a million steps of Pong', { tags: 'long' }, () => {
  const space = new BroadPhase();
  room(space, 0, 500, 50, (x) => x);
  const ask = space as unknown as Loose;
  const options = { out: { id: 0, time: 0, normal: [0, 0] } };
  let [x, y, vx, vy] = [100.1, 200.2, 7.7, 5.3];
  let bounces = 0;
  for (let step = 0; step < 1_000_000; step++) {
    const hit = ask.sweep(x, y, x + 0.7, y + 0.7, vx, vy, options) as typeof options.out | undefined;
    const time = hit ? hit.time : 1;
    x += vx * time;
    y += vy * time;
    if (!hit) continue;
    if (hit.normal[0] !== 0) vx = -vx;
    else if (hit.normal[1] !== 0) vy = -vy;
    else throw new Error(`stuck in step ${step}, at ${x}, ${y}`);
    bounces++;
  }
  expect(bounces).toBeGreaterThan(20_000);
});

test('the sweep of a point is a ray as long as its motion', () => {
  const space = new BroadPhase().set(0, 1, 1, 3, 2).set(1, 3, 1, 4, 5).set(2, 6, 0, 6, 3).set(3, 5, 5, 7, 7).update();
  const starts = Array.from({ length: 81 }, (_, k) => [k % 9, Math.floor(k / 9)] as const);
  for (const [x, y] of starts)
    for (const [right, down] of starts) {
      const [dx, dy] = [right - 4, down - 4];
      const length = Math.hypot(dx, dy);
      const ray = space.rayCast(x, y, dx, dy, { maxDistance: length });
      const hit = space.sweep(x, y, x, y, dx, dy);
      expect([hit?.id, hit?.normal]).toEqual([ray?.id, ray?.normal]);
      if (hit && ray) expect(hit.time * length).toBeCloseTo(ray.distance, 12);
    }
});

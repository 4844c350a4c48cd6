// The world: the order of a step, how long one is, and the loop.
import * as ro from 'broadphase/ro';
import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { FakeCanvas } from './fake-canvas.ts';
import { keys, squares } from './scene.ts';

const { BruteForce } = ro.coltech;

test('ro is the same by either way of importing it', () => {
  expect(ro.ro.World).toBe(ro.World);
  expect(Object.keys(ro.ro).sort()).toEqual(['Entity', 'Input', 'Screen', 'World', 'coltech', 'math', 'ov3']);
});

describe('a step', () => {
  test('does its eight stages in the order of the article', () => {
    const canvas = new FakeCanvas(100, 100);
    const log: string[] = [];
    class Logged extends ro.Entity {
      override accelerate(dt: number): void {
        log.push(`accelerate ${this._roId}`);
        super.accelerate(dt);
      }
      override inertia(dt: number): void {
        log.push(`inertia ${this._roId}`);
        super.inertia(dt);
      }
      override updateAABB(): void {
        if (this._roId >= 0) log.push(`AABB ${this._roId}`);
        super.updateAABB();
      }
    }
    class LoggedTechnique extends BruteForce<Logged> {
      override update(): void {
        log.push('broadPhase.update');
        super.update();
      }
      override queryForCollisionPairs() {
        log.push('queryForCollisionPairs');
        return super.queryForCollisionPairs();
      }
    }
    const world = new ro.World(canvas.asElement(), {
      coltech: new LoggedTechnique(),
      draw: () => log.push(`draw after ${canvas.drain().at(-2)}`),
      handleCollisions: (dt, pairs) => log.push(`handleCollisions ${dt} ${keys(pairs)}`),
      update: (dt) => log.push(`update ${dt}`),
    });
    world.addEntity(new Logged(0, 0, 10, 10));
    world.addEntity(new Logged(5, 5, 10, 10));
    log.length = 0;
    world.step(16);
    expect(log).toEqual([
      'draw after clearRect',
      'accelerate 0',
      'AABB 0',
      'accelerate 1',
      'AABB 1',
      'broadPhase.update',
      'queryForCollisionPairs',
      'handleCollisions 16 0:1',
      'inertia 0',
      'AABB 0',
      'inertia 1',
      'AABB 1',
      'update 16',
    ]);
  });

  test('collides entities where their acceleration has put them, and leaves their AABBs where inertia has', () => {
    let colliding = 0;
    const world = new ro.World(null, {
      handleCollisions: (_dt, pairs) => {
        colliding = pairs.length;
      },
    });
    const a = new ro.Entity(0, 0, 10, 10);
    const b = new ro.Entity(12, 0, 10, 10);
    a.accel.x = 3;
    world.addEntity(a);
    world.addEntity(b);
    world.step(1);
    expect(colliding).toBe(1);
    expect(a.getAABB()).toEqual({ min: [6, 0], max: [16, 10] });
  });

  test('calls init once, when the world is ready, and every function with the world as this', () => {
    const seen: unknown[] = [];
    const world = new ro.World(null, {
      init() {
        this.addEntity(new ro.Entity(0, 0, 1, 1));
        seen.push(this);
      },
      handleCollisions() {
        seen.push(this);
      },
      update() {
        seen.push(this);
      },
    });
    expect(world.entities).toHaveLength(1);
    world.step();
    expect(seen).toEqual([world, world, world]);
  });

  test('without a canvas there is no screen and no input, and nothing is drawn', () => {
    const draw = vi.fn();
    const world = new ro.World(null, { draw, debug: true });
    world.addEntity(new ro.Entity(0, 0, 10, 10));
    world.step();
    world.draw();
    world.entities[0].draw();
    expect([world.screen, world.input, draw.mock.calls.length]).toEqual([null, null, 0]);
  });
});

describe('the length of a step', () => {
  test('is a 60th of a second unless given', () => {
    const seen: number[] = [];
    const world = new ro.World(null, { update: (dt) => seen.push(dt) });
    world.step();
    world.step(5);
    expect(seen).toEqual([1000 / 60, 5]);
  });

  test('changes the effect of acceleration, not that of inertia: velocity is a distance per step', () => {
    const [short, long] = [1, 4].map((dt) => {
      const world = new ro.World(null);
      const entity = new ro.Entity(0, 0, 10, 10);
      entity.ppos.x = -1;
      world.addEntity(entity);
      for (let i = 0; i < 10; i++) world.step(dt);
      return entity.pos.x;
    });
    expect([short, long]).toEqual([10, 10]);
  });

  test('may be 0: collisions are found, and nothing moves', () => {
    const technique = new BruteForce();
    const world = squares(technique, 2, () => [0, 0]);
    const [entity] = world.entities;
    entity.ppos.x = -5;
    entity.accel.x = 1;
    world.step(0);
    expect(entity.pos).toEqual({ x: 0, y: 0 });
    expect(technique.collisionTests).toBe(1);
    entity.inertia(1);
    expect(entity.pos.x).toBe(5);
  });

  test.each([Number.NaN, -1, Infinity])('cannot be %d, and a refused step does nothing', (dt) => {
    const update = vi.fn();
    const world = new ro.World(null, { update });
    world.addEntity(new ro.Entity(0, 0, 1, 1));
    world.entities[0].ppos.x = -1;
    expect(() => world.step(dt)).toThrow(new RegExp(`dt is ${dt}, expected a finite number`));
    expect(world.entities[0].pos.x).toBe(0);
    expect(update).not.toHaveBeenCalled();
  });
});

describe('the loop', () => {
  let frames: ((now: number) => void)[];
  const frame = (now: number) => frames.splice(0).forEach((callback) => void callback(now));

  beforeEach(() => {
    frames = [];
    vi.stubGlobal('requestAnimationFrame', (callback: (now: number) => void) => frames.push(callback));
    vi.stubGlobal('cancelAnimationFrame', (handle: number) => frames.splice(handle - 1, 1));
  });
  afterEach(() => vi.unstubAllGlobals());

  /** The number of steps taken after each frame. */
  const run = (world: ro.World, times: number[], steps: () => number) => {
    world.start();
    return times.map((now) => {
      frame(now);
      return steps();
    });
  };
  const counting = (options: ro.WorldOptions = {}) => {
    let count = 0;
    const world = new ro.World(null, { timeStep: 10, update: () => count++, ...options });
    return { world, steps: () => count };
  };

  test('takes the steps that the time since the last frame is worth, all of one length', () => {
    const lengths = new Set<number>();
    const { world, steps } = counting({ handleCollisions: (dt) => lengths.add(dt) });
    expect(run(world, [100, 110, 115, 120, 145, 150], steps)).toEqual([1, 2, 2, 3, 5, 6]);
    expect([...lengths]).toEqual([10]);
  });

  test('takes one step per frame of a display that beats a little unevenly', () => {
    const { world, steps } = counting();
    expect(run(world, [100, 109.6, 120.3, 129.8, 140.1, 150], steps)).toEqual([1, 2, 3, 4, 5, 6]);
  });

  test('goes on from where it was after a long pause, with at most five steps at once', () => {
    const { world, steps } = counting();
    expect(run(world, [0, 10, 60_000, 60_010], steps)).toEqual([1, 2, 7, 8]);
  });

  test('start and stop say whether it runs, and saying it twice changes nothing', () => {
    const { world, steps } = counting();
    expect(world.isRunning).toBe(false);
    world.stop();
    world.start();
    world.start();
    expect([world.isRunning, frames.length]).toEqual([true, 1]);
    frame(0);
    world.stop();
    world.stop();
    expect([world.isRunning, frames.length]).toEqual([false, 0]);
    expect(steps()).toBe(1);
    world.start(); // time that passed while it stood still is not caught up with
    frame(90_000);
    expect(steps()).toBe(2);
  });

  test('can be stopped, and started again, from within a step', () => {
    const { world } = counting({
      handleCollisions() {
        this.stop();
      },
    });
    world.start();
    frame(0);
    expect([world.isRunning, frames.length]).toEqual([false, 0]);

    const again = counting({
      handleCollisions() {
        this.stop();
        this.start();
      },
    });
    again.world.start();
    frame(0);
    expect([again.world.isRunning, frames.length]).toEqual([true, 1]);
  });

  test('stops when a step throws', () => {
    const { world } = counting({
      handleCollisions: () => {
        throw new Error('mine');
      },
    });
    world.start();
    expect(() => frame(0)).toThrow('mine');
    expect([world.isRunning, frames.length]).toEqual([false, 0]);
  });

  test('runs on a timer where there is no display', async () => {
    vi.unstubAllGlobals();
    await new Promise<void>((resolve) => {
      const world = new ro.World(null, {
        update() {
          this.stop();
          resolve();
        },
      });
      world.start();
    });
    const world = new ro.World(null, { update: () => expect.unreachable() });
    world.start();
    world.stop();
    await new Promise((resolve) => setTimeout(resolve, 30));
  });
});

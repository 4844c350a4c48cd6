// That all contenders of a race are timed in the same frames, and that the motions they are timed in are what they say.
import { BroadPhase } from 'broadphase';
import { describe, expect, test, vi } from 'vitest';
import { framesFor, partOf, strideFor } from '../../bench/harness/frames.mjs';
import { difference } from '../../bench/harness/judge.mjs';
import { type Contender, Player } from '../../bench/harness/player.mjs';
import { createMotion, motionNames } from '../../bench/motions/index.ts';
import { createScene } from '../../src/scenes/index.ts';
import { keysOf, referencePairs } from '../support/reference.ts';

const plan = { warmUp: 24, timed: 64 };

function contender(): Contender {
  const space = new BroadPhase();
  return { update: (boxes) => space.setAll(boxes).update().pairCount, pairs: () => space.pairs };
}

/** Plays a scene to its end, `turn` frames per turn. */
function play(stride: number, turn: number, skipped = 0) {
  const scene = createScene('uniform2d', 200);
  for (let k = 0; k < skipped; k++) scene.step();
  const player = new Player(scene, contender(), plan, stride);
  while (!player.over) player.play(turn);
  return player.notes;
}

describe('the frames of a race', () => {
  test('a fast and a slow contender are timed in the same frames, whatever the turns', () => {
    const fast = play(1, 20);
    expect(fast.frames).toEqual(Array.from({ length: plan.timed }, (_, k) => plan.warmUp + k));
    for (const stride of [2, 4, 8]) {
      const slow = play(stride, 7);
      expect(slow.frames).toHaveLength(plan.timed / stride);
      expect(slow.frames.at(-1)).toBe(fast.frames.at(-1));
      expect(difference([slow], fast)).toBeUndefined();
      for (const [k, frame] of slow.frames.entries()) {
        expect(slow.seen[k]).toBe(fast.seen[fast.frames.indexOf(frame)]);
        expect(slow.found[k]).toBe(fast.found[fast.frames.indexOf(frame)]);
      }
    }
  });

  test('who saw other frames is found out, and who found other pairs', () => {
    const fast = play(1, 20);
    expect(difference([play(4, 20, 1)], fast)).toEqual({ frame: plan.warmUp + 3, saw: true });
    const wrong = play(2, 20);
    wrong.found[5] = '0 0 0';
    expect(difference([wrong], fast)).toMatchObject({ frame: wrong.frames[5], exact: fast.pairs[11] });
  });

  test('a slow contender plays the frame before each timed one, and few others', () => {
    const parts = Array.from({ length: 8 }, (_, k) => partOf(plan.warmUp + k, plan, 4));
    expect(parts).toEqual(['no', 'no', 'along', 'timed', 'no', 'no', 'along', 'timed']);
    expect(partOf(0, plan, 4)).toBe('along');
    expect(partOf(plan.warmUp, plan, 2)).toBe('along');
  });

  test('how many frames are played goes by the number of boxes and by what a frame took', () => {
    expect(framesFor(100).timed).toBeGreaterThan(framesFor(100_000).timed);
    expect(strideFor(1, plan, 88)).toBe(1);
    expect(strideFor(1, plan, 87)).toBe(2);
    expect(strideFor(1, plan, 30)).toBe(8);
    expect(strideFor(100, plan, 87)).toBeUndefined();
    expect(strideFor(100, plan, Infinity)).toBe(1);
  });

  test('how slow a contender is does not depend on how long the boxes take to move', () => {
    let now = 0;
    const clock = vi.spyOn(performance, 'now').mockImplementation(() => now);
    const step = () => {
      now += 100;
    };
    const scene = { boxes: new Float32Array(4), step };
    const idle = { update: () => 0, pairs: () => [] };
    expect(new Player(scene, idle, plan).probe(10, 1000)).toBeLessThan(100);
    clock.mockRestore();
  });
});

describe.each([...motionNames.tune, ...motionNames.check])('the motion %s', (name) => {
  test.each([2, 3] as const)('is the same each time, moves, and holds its density, in %dD', (dimensions) => {
    const count = 300;
    const [one, other] = [createMotion(name, dimensions, count, 5), createMotion(name, dimensions, count, 5)];
    const space = new BroadPhase({ dimensions });
    const first = one.boxes.slice();
    const pairs: number[] = [];
    for (let frame = 1; frame <= 1000; frame++) {
      one.step(frame);
      other.step(frame);
      if (frame % 10 === 0) pairs.push(space.setAll(one.boxes).update().pairCount);
    }
    expect(one.boxes).toEqual(other.boxes);
    expect(one.boxes).not.toEqual(first);
    expect(one.boxes.every(Number.isFinite)).toBe(true);
    expect(keysOf(space.pairs)).toEqual(referencePairs(one.boxes, dimensions));
    const mean = (of: number[]) => of.reduce((sum, value) => sum + value, 0) / of.length;
    const [early, late] = [mean(pairs.slice(0, 20)), mean(pairs.slice(-20))];
    expect(late).toBeGreaterThan(early / 2);
    expect(late).toBeLessThan(2 * early);
  });
});

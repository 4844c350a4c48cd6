// The narrow phases are exact: each is compared with a loop over everything, and all hits are among the pairs.
import { describe, expect, test } from 'vitest';
import { seeded } from '../force-d3/words.mjs';
import { installed } from './check.mjs';

describe.skipIf(!installed)('the narrow phase', () => {
  test('separating axes know what overlaps, how deep, and which way is out', async () => {
    const { boundsOf, circle, contactOf, polygon } = await import('../narrow-phase/separating-axes.mjs');
    const square = polygon([
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ]);
    const ball = circle(1);
    ball.pos.x = 1.5;
    expect(contactOf(square, ball).overlapV.x).toBeCloseTo(0.5);
    expect(contactOf(square, ball).overlapV.y).toBeCloseTo(0);
    ball.pos.y = 1.9; // its box overlaps the square's, but the ball is round at the corner
    expect(contactOf(square, ball)).toBeUndefined();
    square.setAngle(Math.PI / 4);
    expect(boundsOf(square).map((x) => x.toFixed(3))).toEqual(['-1.414', '-1.414', '1.414', '1.414']);
    expect(boundsOf(ball)).toEqual([0.5, 0.8999999999999999, 2.5, 2.9]);
    expect(contactOf(ball, circle(1))).toBeUndefined();
  });

  test('pixel masks touch where both have a pixel', async () => {
    const { maskOf, maskOfImage, masksTouch } = await import('../narrow-phase/pixel-masks.mjs');
    const corner = maskOf(['##', '# ']);
    expect(masksTouch(corner, 0, 0, corner, 1, 1)).toBe(false);
    expect(masksTouch(corner, 0, 0, corner, 0, 1)).toBe(true);
    expect(masksTouch(corner, 0, 0, corner, 5, 0)).toBe(false);
    const data = Uint8ClampedArray.from([0, 0, 0, 255, 0, 0, 0, 10]);
    expect(maskOfImage({ width: 2, height: 1, data }).solid).toEqual(Uint8Array.of(1, 0));
  });

  test('swept boxes meet when small steps say so', async () => {
    const { meeting } = await import('../narrow-phase/swept-boxes.mjs');
    const steps = 2000;
    const random = seeded(1);
    let met = 0;
    for (let round = 0; round < 600; round++) {
      const box = () => {
        const [x, y] = [20 * random(), 20 * random()];
        return [x, y, x + 3 * random(), y + 3 * random()];
      };
      const way = () => [40 * (random() - 0.5), 40 * (random() - 0.5)];
      const [a, wayA, b, wayB] = [box(), way(), box(), way()];
      const at = (t, from, moved) => from.map((x, k) => x + t * moved[k % 2]);
      const touch = (p, q) => p[0] <= q[2] && q[0] <= p[2] && p[1] <= q[3] && q[1] <= p[3];
      const first = Array.from({ length: steps + 1 }, (_, k) => k / steps).find((t) =>
        touch(at(t, a, wayA), at(t, b, wayB)),
      );
      const found = meeting(a, wayA, b, wayB);
      if (first === undefined) continue;
      met++;
      expect(found.time).toBeLessThanOrEqual(first);
      expect(found.time).toBeGreaterThan(first - 1.5 / steps);
    }
    expect(met).toBeGreaterThan(30);
    expect(meeting([0, 0, 1, 1], [0, 0], [2, 0, 3, 1], [0, 5])).toBeUndefined();
    expect(meeting([0, 0, 1, 1], [0, 0], [1, 0, 3, 1], [0, 0])).toEqual({ time: 0, axis: -1 });
  });
});

test.skipIf(!installed).each(['shapes', 'masks', 'fastBoxes'])(
  'the world of %s finds every hit that a look at all finds',
  async (name) => {
    const scenes = await import('../narrow-phase/scenes.mjs');
    const { masksTouch } = await import('../narrow-phase/pixel-masks.mjs');
    const { contactOf } = await import('../narrow-phase/separating-axes.mjs');
    const { meeting } = await import('../narrow-phase/swept-boxes.mjs');
    const exact = {
      shapes: (a, b) => contactOf(a.shape, b.shape) !== undefined,
      masks: (a, b) => masksTouch(a.mask, a.left, a.top, b.mask, b.left, b.top),
      fastBoxes: (a, b) => a.isBullet !== b.isBullet && meeting(a.box, a.way, b.box, b.way) !== undefined,
    }[name];
    const scene = scenes[name](80);
    let [pairs, hits] = [0, 0];
    for (let frame = 0; frame < 100; frame++) {
      const before = scene.space.get(1);
      scene.move();
      expect(scene.space.get(1)).toEqual(before); // so that the broad phase can be timed alone
      scene.broad();
      const all = [];
      for (let a = 0; a < 80; a++) {
        for (let b = a + 1; b < 80; b++) if (exact(scene.things[a], scene.things[b])) all.push(`${a} ${b}`);
      }
      scene.narrow();
      const found = all.map((_, k) => `${scene.hits[2 * k]} ${scene.hits[2 * k + 1]}`);
      expect(found.toSorted()).toEqual(all.toSorted());
      expect(scene.hits).toHaveLength(2 * all.length);
      pairs += scene.space.pairCount;
      hits += all.length;
      scene.react();
    }
    expect(hits).toBeGreaterThan(50);
    expect(hits).toBeLessThan(pairs);
  },
);

// Rectangles end up apart, pushed as by a loop over all pairs; labels are shown as if placed one by one.
import { describe, expect, test } from 'vitest';
import { firstScales } from '../force-d3/first-scales.mjs';
import { forceCollideRect } from '../force-d3/force-collide-rect.mjs';
import { placesOf, seeded } from '../force-d3/words.mjs';
import { installed } from './check.mjs';

const overlap = (a, b, padding = 0) =>
  Math.min(
    (a.width + b.width) / 2 + padding - Math.abs(a.x - b.x),
    (a.height + b.height) / 2 + padding - Math.abs(a.y - b.y),
  );

/** How many pairs overlap by more than half a pixel. */
function overlaps(nodes, padding = 0) {
  let count = 0;
  for (const [k, a] of nodes.entries())
    for (const b of nodes.slice(k + 1)) count += Number(overlap(a, b, padding) > 0.5);
  return count;
}

/** Rectangles of very mixed sizes, in a heap. */
function heap(count) {
  const random = seeded(5);
  return Array.from({ length: count }, () => ({
    x: 400 * random(),
    y: 300 * random(),
    vx: 0,
    vy: 0,
    width: 4 + 90 * random() ** 4,
    height: 4 + 50 * random() ** 3,
  }));
}
const width = (node) => node.width;
const height = (node) => node.height;

describe('forceCollideRect', () => {
  test('pushes two apart along the lesser axis, the smaller one more', () => {
    const nodes = [
      { x: 0, y: 0, vx: 0, vy: 0, width: 30, height: 10 },
      { x: 18, y: 1, vx: 0, vy: 0, width: 10, height: 10 },
    ];
    const force = forceCollideRect(width, height, 2);
    force.initialize(nodes);
    force();
    expect(nodes.map(({ vx, vy }) => [vx, vy])).toEqual([
      [-1, 0],
      [3, 0],
    ]);
  });

  test.each([1, 2, 30, 250])('has %i rectangles of mixed sizes apart in the end', (count) => {
    const nodes = heap(count);
    const force = forceCollideRect(width, height, 3).iterations(2);
    force.initialize(nodes);
    for (let tick = 0; tick < 3000; tick++) {
      force();
      for (const node of nodes) {
        node.x += node.vx;
        node.y += node.vy;
        node.vx = node.vy = 0;
      }
    }
    if (count > 2) expect(overlaps(heap(count))).toBeGreaterThan(count / 10);
    expect(overlaps(nodes, 3)).toBe(0);
    expect(nodes.every(({ x, y }) => Number.isFinite(x) && Number.isFinite(y))).toBe(true);
  });

  test('has the options of forceCollide: given they are set, else read', () => {
    const force = forceCollideRect(10, 20, 5);
    expect([force.width(), force.height(), force.padding(), force.strength(), force.iterations()]).toEqual([
      10, 20, 5, 1, 1,
    ]);
    const nodes = [
      { x: 0, y: 0, vx: 0, vy: 0 },
      { x: 8, y: 0, vx: 0, vy: 0 },
    ];
    force.initialize(nodes);
    force.strength(0.5).padding(0).width(12)();
    expect(nodes.map(({ vx }) => vx)).toEqual([-1, 1]);
  });
});

describe('firstScales', () => {
  const places = placesOf(1500).map((place) => ({ ...place, width: 6 * place.name.length, height: 1.3 * place.size }));
  const scales = Array.from({ length: 9 }, (_, k) => 0.5 * 2 ** (k / 2));

  /** The same by a loop over all labels that are shown. */
  function oneByOne(labels) {
    const first = labels.map(() => Number.POSITIVE_INFINITY);
    for (const scale of scales) {
      const boxes = labels.map((label) => ({ ...label, x: scale * label.x, y: scale * label.y }));
      const shown = boxes.filter((_, k) => first[k] < scale);
      for (const [k, box] of boxes.entries()) {
        if (first[k] < scale || shown.some((other) => overlap(box, other) >= 0)) continue;
        shown.push(box);
        first[k] = scale;
      }
    }
    return first;
  }

  test('places labels as one by one, by priority', () => {
    const labels = places.slice(0, 400);
    expect([...firstScales(labels, scales)]).toEqual(oneByOne(labels));
  });

  test('no two labels that are shown overlap, at scales in between too, and zooming in hides none', () => {
    const first = firstScales(places, scales);
    let before = 0;
    for (const scale of [...scales, 0.61, 1.1, 3.3, 7.9, 20].sort((a, b) => a - b)) {
      const shown = places.flatMap((place, k) =>
        first[k] <= scale ? [{ ...place, x: scale * place.x, y: scale * place.y }] : [],
      );
      expect(shown.length).toBeGreaterThanOrEqual(before);
      before = shown.length;
      for (const [k, a] of shown.entries())
        for (const b of shown.slice(k + 1)) if (overlap(a, b) > 1e-9) expect([a, b]).toBe(null);
    }
    expect(before).toBeGreaterThan(700);
    expect(before).toBeLessThan(1500);
  });

  test('shows any number of labels that have room', () => {
    const labels = Array.from({ length: 600_000 }, (_, k) => ({
      x: 20 * (k % 1000),
      y: 0.02 * k,
      width: 9,
      height: 9,
    }));
    expect(firstScales(labels, [1]).every((scale) => scale === 1)).toBe(true);
  });

  test('labels at one place are shown once, however far one zooms', () => {
    const label = { x: 3, y: 4, width: 20, height: 10 };
    expect([...firstScales([label, { ...label }], scales)]).toEqual([scales[0], Number.POSITIVE_INFINITY]);
    expect([...firstScales([], scales)]).toEqual([]);
  });
});

describe.skipIf(!installed)('with the packages of the examples', () => {
  test('the others find the same pushes and the same labels', async () => {
    const { labels, rectangles } = await import('../force-d3/rivals.mjs');
    const labelled = placesOf(6000).map((place) => ({ ...place, width: 6 * place.name.length, height: 14 }));
    const scales = [1, 2, 4, 8];
    const expected = firstScales(labelled, scales);
    for (const finder of Object.values(labels)) expect(finder(labelled, scales)).toEqual(expected);

    const { forceSimulation } = await import('d3-force');
    for (const make of [forceCollideRect, rectangles.rbush, rectangles.quadtree]) {
      const nodes = heap(120);
      forceSimulation(nodes)
        .velocityDecay(0.2)
        .force('collide', make(width, height, 1))
        .stop()
        .tick(600);
      expect(overlaps(nodes)).toBe(0);
    }
  });
});

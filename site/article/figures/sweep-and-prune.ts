// Fig. 21: sweep and prune: moving boxes above, and below them the order that the sweep keeps.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { crowd } from '../demos/crowd.ts';
import { SweepAndPrune } from '../demos/sweep-and-prune.ts';
import source from '../demos/sweep-and-prune.ts?raw';
import { createView, excerpt, listing } from '../kit/index.ts';
import { createStage } from '../stage.ts';

const width = 480;
const height = 240;

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);
  const sweep = new SweepAndPrune();
  const order = createView(root, {
    label: 'The boxes in order of their left edges.',
    height: (across) => across / 2.2,
    draw({ ctx, width: across, height: down, colors }) {
      const { sorted } = sweep;
      const scale = across / width;
      const row = (index: number) => ((index + 0.5) * down) / sorted.length;
      const thick = Math.min(7, (0.55 * down) / sorted.length);

      sorted.forEach((a, i) => {
        const box = a.getAABB();
        for (let j = i + 1; j < sorted.length; j++) {
          const start = sorted[j].getAABB().min[0];
          if (start > box.max[0]) break;
          const hits = sweep.aabb2DIntersection(a, sorted[j]);
          ctx.strokeStyle = hits ? colors.hit : colors.grid;
          ctx.lineWidth = hits ? 1.5 : 1;
          ctx.beginPath();
          ctx.moveTo(start * scale, row(i));
          ctx.lineTo(start * scale, row(j));
          ctx.stroke();
        }
      });
      const colliding = new Set(pairsNow().flat());
      sorted.forEach((entity, i) => {
        const { min, max } = entity.getAABB();
        ctx.fillStyle = colliding.has(entity) ? colors.hit : colors.box;
        ctx.fillRect(min[0] * scale, row(i) - thick / 2, (max[0] - min[0]) * scale, thick);
      });
    },
  });

  const stage = createStage(left, {
    width,
    height,
    build: (canvas, colors) => crowd(ro, canvas, sweep, { count: 22, sides: [16, 70], speed: 1.2 }, colors),
    frame() {
      sweep.update();
      order.redraw();
    },
    counters: { boxes: 'Boxes', tests: 'Pairs tested', pairs: 'Pairs found', swaps: 'Swaps to sort' },
    count: ({ world, pairCount }) => ({
      boxes: world.entities.length,
      tests: sweep.collisionTests,
      pairs: pairCount,
      swaps: sweep.swaps,
    }),
    inWords({ world, pairCount }) {
      const words =
        `${world.entities.length} boxes in order of their left edges: ${sweep.collisionTests} pairs overlap ` +
        `from left to right and are tested, ${pairCount} of them collide.`;
      order.describe(`${words} Each bar is as long as its box is wide; a line joins the two of each test.`);
      return words;
    },
  });
  stage.canvas.parentElement!.after(order.canvas);

  listing(right, 'site/article/demos/sweep-and-prune.ts', excerpt(source, 'override update(): void'));
  listing(right, 'site/article/demos/sweep-and-prune.ts', excerpt(source, 'queryForCollisionPairs()'));
  return stage.rest;

  function pairsNow() {
    const tests = sweep.collisionTests;
    const pairs = sweep.queryForCollisionPairs();
    sweep.collisionTests = tests;
    return pairs;
  }
}

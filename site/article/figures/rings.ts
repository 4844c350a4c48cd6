// Fig. 3: rings of squares on brute force, and how fast its comparisons grow with every ring.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { rings } from '../demos/rings.ts';
import source from '../demos/rings.ts?raw';
import { button, listing } from '../kit/index.ts';
import { createStage } from '../stage.ts';

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);
  const coltech = new ro.coltech.BruteForce();

  const stage = createStage(left, {
    width: 480,
    height: 360,
    build(canvas, colors) {
      const demo = rings(ro, canvas, coltech, colors);
      for (let i = 1; i < 4; i++) demo.addRing();
      return demo;
    },
    counters: { tests: 'Collision tests', entities: 'Entities', pairs: 'Colliding pairs', rate: 'Frames' },
    count: ({ world, pairCount }, rate) => ({
      tests: coltech.collisionTests,
      entities: world.entities.length,
      pairs: pairCount,
      rate: rate > 0 ? `${Math.round(rate)} /s` : '–',
    }),
    inWords: ({ world, ringCount, pairCount }) =>
      `${world.entities.length} squares on ${ringCount} ${ringCount === 1 ? 'ring' : 'rings'}, one of each moving. ` +
      `${pairCount} colliding pairs, found by ${coltech.collisionTests.toLocaleString('en')} collision tests.`,
  });
  const { demo, controls } = stage;
  button(controls, 'Add a ring', add(1));
  button(controls, 'Add ten', add(10));
  button(controls, 'Start over', () => {
    demo.startOver();
    stage.refresh();
  });
  stage.canvas.addEventListener('click', stage.refresh);

  listing(right, 'site/article/demos/rings.ts', source);
  return stage.rest;

  function add(count: number) {
    return () => {
      for (let i = 0; i < count; i++) demo.addRing();
      stage.refresh();
    };
  }
}

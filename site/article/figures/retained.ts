// Fig. 18: the retained grid, and how much of it a step has to change if few boxes move, or all.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { RetainedGrid } from '../demos/retained-grid.ts';
import source from '../demos/retained-grid.ts?raw';
import { stillAndMoving } from '../demos/still-and-moving.ts';
import { excerpt, listing, slider } from '../kit/index.ts';
import { createStage } from '../stage.ts';

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);
  const grid = new RetainedGrid(20);
  const first = 0.1;

  const stage = createStage(left, {
    width: 480,
    height: 360,
    build(canvas, colors) {
      const demo = stillAndMoving(ro, canvas, grid, colors);
      demo.move(first);
      demo.settle();
      return demo;
    },
    counters: { boxes: 'Boxes', moved: 'Boxes that changed cells', changed: 'Entries moved', rebuilt: 'If rebuilt' },
    count: ({ world, work }) => ({
      boxes: world.entities.length,
      moved: work.moved.toFixed(1),
      changed: work.changed.toFixed(1),
      rebuilt: grid.entries,
    }),
    inWords: ({ world, work }) =>
      `${world.entities.length} boxes on a retained grid. In a frame, ${work.moved.toFixed(1)} of them change cells ` +
      `on average, which moves ${work.changed.toFixed(1)} entries; a full rebuild would write ${grid.entries}.`,
  });
  slider(stage.controls, {
    label: 'Boxes that move',
    min: 0,
    max: 100,
    step: 5,
    value: 100 * first,
    format: (percent) => `${percent} %`,
    moved(percent) {
      const { move, settle, world } = stage.demo;
      move(percent / 100);
      if (!world.isRunning) settle(); // else the numbers follow by themselves
      stage.refresh();
    },
  });

  listing(right, 'site/article/demos/retained-grid.ts', excerpt(source, 'override update(): void'));
  return stage.rest;
}

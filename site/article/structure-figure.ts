// What the figures of the library's techniques have in common: a crowd of moving boxes, and over it the cells, strips
// or nodes of the technique.

import type { TechniqueName } from 'broadphase';
import { ro } from 'broadphase/ro';
import coltechSource from '../../src/ro/coltech/broad-phase.ts?raw';
import { demoColumns } from './demo.ts';
import { type Crowd, crowd } from './demos/crowd.ts';
import source from './demos/crowd.ts?raw';
import { choice, excerpt, listing, slider } from './kit/index.ts';
import { createStage } from './stage.ts';

export interface StructureFigure extends Crowd {
  /** The techniques to choose from; the first one is shown. */
  techniques: readonly TechniqueName[];
  /** What their structure is made of. */
  unit: string;
  /** The most boxes on the slider. */
  most: number;
}

const whole = (number: number) => number.toLocaleString('en');

/** @returns what stops it */
export function structureFigure(root: HTMLElement, { techniques, unit, most, ...boxes }: StructureFigure): () => void {
  const [left, right] = demoColumns(root);
  const coltech = new ro.coltech.BroadPhase({ technique: techniques[0] });

  const stage = createStage(left, {
    width: 480,
    height: 330,
    build: (canvas, colors) => crowd(ro, canvas, coltech, { ...boxes, structure: true }, colors),
    counters: { cells: unit, tests: 'Pairs tested', pairs: 'Pairs found', share: 'Of all pairs' },
    count: ({ world, pairCount }) => ({
      cells: coltech.allocatedCells,
      tests: coltech.collisionTests,
      pairs: pairCount,
      share: share(coltech.collisionTests, world.entities.length),
    }),
    inWords: ({ world, pairCount }) =>
      `${whole(world.entities.length)} moving boxes, and the ${whole(coltech.space.structure().length / 4)} boxes of ` +
      `what ${coltech.space.technique} has in memory. ${whole(coltech.collisionTests)} pairs are tested, ` +
      `${whole(pairCount)} found.`,
  });
  slider(stage.controls, {
    label: 'Boxes',
    min: 10,
    max: most,
    step: 10,
    value: boxes.count,
    format: whole,
    moved(count) {
      stage.demo.resize(count);
      stage.refresh();
    },
  });
  if (techniques.length > 1) {
    const options = techniques.map((name) => [name, name] as const);
    choice(left, 'Technique', options, techniques[0], (name) => {
      coltech.space.technique = name;
      stage.refresh();
    });
  }

  listing(right, 'src/ro/coltech/broad-phase.ts', excerpt(coltechSource, 'draw(ctx: CanvasRenderingContext2D)'));
  listing(right, 'site/article/demos/crowd.ts', excerpt(source, 'const world = new ro.World(canvas, {'));
  return stage.rest;
}

/** The share of all pairs of these boxes that was tested. */
function share(tests: number, boxes: number): string {
  const percent = (100 * tests) / ((boxes * (boxes - 1)) / 2);
  return `${percent < 10 ? percent.toFixed(1) : Math.round(percent)} %`;
}

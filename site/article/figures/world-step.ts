// The eight stages of a step: a real world of five boxes, recorded stage by stage and played back.
import {
  boxOn,
  columns,
  createStepper,
  createView,
  dot,
  element,
  fitWorld,
  gridOn,
  lookOf,
  type Sheet,
  sayer,
} from '../kit/index.ts';
import { recordStages, type Stage, type StageRecord } from '../record.ts';

const size = { width: 240, height: 160, cellSize: 40 };
const steps = 18;
const starts = [
  { box: [14, 20, 36, 26], velocity: [11, 1] },
  { box: [92, 66, 30, 30], velocity: [-3, -7] },
  { box: [150, 24, 44, 22], velocity: [-8, 3] },
  { box: [186, 96, 26, 34], velocity: [-6, -2] },
  { box: [40, 104, 40, 24], velocity: [7, -6] },
] as const;

const words: Readonly<Record<Stage, readonly [title: string, what: string]>> = {
  clear: ['Clear the screen', 'Everything that was drawn is wiped away. The world itself is as it was.'],
  draw: ['Draw', 'World.draw puts every box on the screen where it is now.'],
  accelerate: [
    'Accelerate all',
    'Pushes take effect, here gravity: each box is moved a little, and its AABB after it.',
  ],
  update: ['Update the technique', 'The technique reads where all AABBs are. The grid refills its cells.'],
  query: ['Query for pairs', 'The technique says which boxes overlap.'],
  handleCollisions: ['handleCollisions', 'Your code gets the pairs. Here it paints those boxes in another colour.'],
  inertia: ['Inertia for all', 'Each box goes on as far as it came in the last step, and its AABB after it.'],
  'user-update': ['update', 'Your code has the last word: here it turns boxes back at the walls.'],
};

export function mount(root: HTMLElement): () => void {
  let shown: StageRecord;
  const records = recordStages(starts, size, steps);
  const [left, right] = columns(root);

  const view = createView(left, {
    label: 'Five boxes in a world with a grid.',
    height: (width) => (width * size.height) / size.width,
    draw: (sheet) => draw(sheet, shown),
  });

  const list = element('ol', { class: 'stages' });
  const items = new Map<string, HTMLElement>();
  for (const [stage, [title]] of Object.entries(words)) {
    const item = element('li', {}, title);
    items.set(stage, item);
    list.append(item);
  }
  right.append(list);
  const say = sayer(right, true);

  const stepper = createStepper(root, {
    steps: records,
    label: 'Stage',
    pace: 700,
    loops: true,
    show(record) {
      shown = record;
      for (const [stage, item] of items) {
        if (stage === record.stage) item.setAttribute('aria-current', 'step');
        else item.removeAttribute('aria-current');
      }
      const [title, what] = words[record.stage];
      const pairs = record.pairs.map(([a, b]) => `${a} and ${b}`).join(', ');
      const found = record.stage === 'query' ? (pairs ? ` Now: ${pairs}.` : ' Now: none.') : '';
      say(what + found);
      view.describe(
        `Step ${record.step} of the world, stage “${title}”. ${record.drawn.length === 0 ? 'The screen is empty' : 'Five boxes are on the screen'}. ${pairs ? `Overlapping: ${pairs}.` : 'No pair is known.'}`,
      );
      view.redraw();
    },
  });
  return () => stepper.stop();
}

/** The cells and what is on the screen; over it, the AABB of each box and how far it came in the last step. */
function draw(sheet: Sheet, { cells, drawn, entities, pairs }: StageRecord): void {
  const { ctx, colors } = sheet;
  const fit = fitWorld(sheet, [0, 0, size.width, size.height], [6, 6, 6, 6]);
  for (const cell of cells) boxOn(ctx, fit, cell, { fill: colors.cell });
  const { cellSize } = size;
  const grid = { minX: 0, minY: 0, columns: size.width / cellSize, rows: size.height / cellSize, cellSize };
  gridOn(ctx, fit, grid, colors.grid);
  for (const { box, hit } of drawn) boxOn(ctx, fit, box, lookOf(colors, hit ? 'hit' : 'alone'));
  entities.forEach(({ pos: [x, y, w, h], ppos, aabb }, id) => {
    const met = pairs.some((pair) => pair.includes(id));
    const [minX, minY] = aabb.min;
    boxOn(ctx, fit, [minX, minY, aabb.max[0] - minX, aabb.max[1] - minY], {
      line: met ? colors.now : colors.muted,
      dash: [4, 3],
      lineWidth: met ? 2.5 : 1.25,
    });
    const [endX, endY] = [fit.x + (x + w / 2) * fit.scale, fit.y + (y + h / 2) * fit.scale];
    ctx.strokeStyle = colors.accent;
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(fit.x + (ppos[0] + w / 2) * fit.scale, fit.y + (ppos[1] + h / 2) * fit.scale);
    ctx.lineTo(endX, endY);
    ctx.stroke();
    dot(ctx, endX, endY, 2.5, colors.accent);
  });
}

// Fig. 11: the grid is filled, one operation at a time, beside the code that does it.
import gridSource from '../../../src/ro/coltech/spatial-grid.ts?raw';
import { boxes, drawGridScene, gridSize } from '../grid-scene.ts';
import {
  columns,
  counters,
  createStepper,
  createView,
  element,
  excerpt,
  listing,
  sayer,
  showArrays,
} from '../kit/index.ts';
import { type Place, type PopulationOperation, recordGrid } from '../record.ts';

const lights: Readonly<Record<PopulationOperation['kind'], string>> = {
  grid: 'this.grid = new Array',
  entity: 'for (const entity of',
  span: 'for (let col',
  column: 'this.grid[col] = []',
  cell: 'column[cell] = []',
  insert: 'column[cell].push',
};

function explain(operation: PopulationOperation): string {
  const { kind } = operation;
  if (kind === 'grid') return 'The previous frame’s grid is dropped. The new one is an empty array for four columns.';
  if (kind === 'entity') return `The next entity is ${operation.id}.`;
  if (kind === 'span') {
    const { id, first, last } = operation;
    const range = (from: number, to: number) => (from === to ? `${from}` : `${from} to ${to}`);
    return `Entity ${id} lies in columns ${range(first.col, last.col)}, cells ${range(first.cell, last.cell)}.`;
  }
  if (kind === 'column') return `Column ${operation.col} does not exist yet: an array is made for it.`;
  const where = `grid[${operation.col}][${operation.cell}]`;
  if (kind === 'cell') return `Nothing has been in ${where} so far: an array is made for it.`;
  return `Entity ${operation.id} goes into ${where}.`;
}

type Operations = readonly PopulationOperation[];

const places = (done: Operations, kind: 'cell' | 'insert') =>
  done.filter((each): each is Extract<PopulationOperation, Place> => each.kind === kind);

/** What is in each cell of each column after these operations. */
function arraysAfter(done: Operations): ((string | undefined)[] | undefined)[] {
  const made = (col: number) => done.some((each) => each.kind === 'column' && each.col === col);
  const held = (col: number, cell: number) => {
    const here = (each: Place) => each.col === col && each.cell === cell;
    if (!places(done, 'cell').some(here)) return undefined;
    const inserted = places(done, 'insert').filter(here);
    return `[${inserted.map(({ id }) => id).join(', ')}]`;
  };
  return [0, 1, 2, 3].map((col) => (made(col) ? [0, 1, 2].map((cell) => held(col, cell)) : undefined));
}

export function mount(root: HTMLElement): () => void {
  const { population } = recordGrid(boxes, gridSize);
  const [left, right] = columns(root);
  const source = listing(left, 'ro/coltech/spatial-grid.ts', excerpt(gridSource, 'override update()'));
  let at = 0;

  const view = createView(right, {
    label: 'Six boxes on a grid of four by three cells.',
    height: (width) => Math.min(270, width * 0.76),
    draw(sheet) {
      const now = population[at];
      const about: Place[] = [];
      if (now.kind === 'cell' || now.kind === 'insert') about.push(now);
      if (now.kind === 'column') for (let cell = 0; cell < 3; cell++) about.push({ col: now.col, cell });
      if (now.kind === 'span') {
        for (let { col } = now.first; col <= now.last.col; col++) {
          for (let { cell } = now.first; cell <= now.last.cell; cell++) about.push({ col, cell });
        }
      }
      const filled = places(population.slice(0, at + 1), 'cell');
      drawGridScene(sheet, { filled, at: about, now: now.kind === 'grid' ? [] : [now.id] });
    },
  });

  const arrays = element('div', { class: 'arrays' });
  right.append(arrays);
  const say = sayer(right, true);
  const count = counters(right, { arrays: 'Arrays made', cells: 'Cells filled', entries: 'Entries' });

  const stepper = createStepper(root, {
    steps: population,
    show(operation, index) {
      at = index;
      source.light(lights[operation.kind]);
      const words = explain(operation);
      say(words);
      const done = population.slice(0, at + 1);
      const cells = places(done, 'cell').length;
      count({
        arrays: 1 + done.filter(({ kind }) => kind === 'column').length + cells,
        cells,
        entries: places(done, 'insert').length,
      });
      showArrays(arrays, arraysAfter(done));
      view.describe(`Six boxes, numbered 0 to 5, on a grid of four by three cells. ${words}`);
      view.redraw();
    },
  });
  return () => stepper.stop();
}

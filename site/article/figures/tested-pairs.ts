// Fig. 14: the table of tested pairs, filled lookup by lookup, with cells of a size that the reader chooses.
import gridSource from '../../../src/ro/coltech/spatial-grid.ts?raw';
import { boxOn, cellBox, fitWorld, gridOn, lookOf } from '../kit/drawing.ts';
import {
  choice,
  columns,
  counters,
  createStepper,
  createView,
  element,
  listing,
  passage,
  type Sheet,
  sayer,
} from '../kit/index.ts';
import { type Box, type GridRecord, type QueryOperation, recordGrid } from '../record.ts';

const width = 240;
const height = 120;
const cellSizes = [
  [120, 'large'],
  [40, 'fitting'],
  [8, 'small'],
] as const;
const boxes: readonly Box[] = [
  [8, 10, 36, 30],
  [22, 20, 38, 30],
  [74, 8, 32, 38],
  [88, 22, 38, 32],
  [148, 12, 36, 32],
  [166, 26, 36, 34],
  [16, 76, 40, 28],
  [104, 78, 38, 30],
  [190, 84, 36, 24],
];
type LookUp = Extract<QueryOperation, { kind: 'lookup' }>;

const lookUps = ({ query }: GridRecord) => query.filter((each): each is LookUp => each.kind === 'lookup');

/** The pairs in the table after these lookups. */
const compared = (done: readonly LookUp[]) =>
  new Set(done.filter(({ known }) => !known).map(({ a, b }) => `${a}:${b}`));

function explain({ a, b, col, cell, known }: LookUp): string {
  return known
    ? `${a} and ${b} meet again, in cell grid[${col}][${cell}]. The table knows them: no comparison.`
    : `${a} and ${b} meet for the first time, in cell grid[${col}][${cell}]. Compared, and noted down.`;
}

export function mount(root: HTMLElement): () => void {
  const possible = (boxes.length * (boxes.length - 1)) / 2;
  let cellSize: number = cellSizes[1][0];
  let recorded = recordGrid(boxes, { width, height, cellSize });
  let run = lookUps(recorded);
  let at = 0;

  const [left, right] = columns(root);
  choice(left, 'Cells', cellSizes, cellSize, (value) => {
    cellSize = value;
    recorded = recordGrid(boxes, { width, height, cellSize });
    run = lookUps(recorded);
    stepper.load(run);
  });
  const view = createView(left, {
    label: 'Nine boxes on a grid.',
    height: (across) => across * 0.52,
    draw: (sheet) => draw(sheet, recorded, cellSize, run.slice(0, at + 1)),
  });
  const say = sayer(left, true);
  const count = counters(left, { lookups: 'Lookups', tests: 'Comparisons', saved: 'Saved' });

  const source = listing(
    right,
    'ro/coltech/spatial-grid.ts',
    passage(gridSource, 'const hashA', 'if (this.aabb2DIntersection'),
  );

  const table = element('ul', { class: 'keys', 'aria-label': 'The table of tested pairs' });
  right.append(table);

  const stepper = createStepper(root, {
    steps: run,
    label: 'Lookup',
    pace: 350,
    show(now, index) {
      at = index;
      source.light(now.known ? 'continue' : 'checked.add(hashA)');
      const keys = [...compared(run.slice(0, at + 1))];
      table.replaceChildren(
        ...keys.map((key) => {
          const [a, b] = key.split(':').map(Number);
          const isNow = (a === now.a && b === now.b) || (a === now.b && b === now.a);
          return element('li', isNow ? { 'data-now': true } : {}, element('code', {}, `${a}:${b}  ${b}:${a}`));
        }),
      );
      const words = explain(now);
      say(words);
      count({ lookups: at + 1, tests: keys.length, saved: at + 1 - keys.length });
      view.describe(
        `Nine boxes on a grid with cells of ${cellSize}. ${words} ${keys.length} of ${possible} pairs have been compared.`,
      );
      view.redraw();
    },
  });
  return () => stepper.stop();
}

/** The grid and its boxes after these lookups: those that collide, and those that the last lookup is about. */
function draw(sheet: Sheet, { cells, query }: GridRecord, cellSize: number, done: readonly LookUp[]): void {
  const { ctx, colors } = sheet;
  const fit = fitWorld(sheet, [0, 0, width, height]);
  for (const { col, cell } of cells) boxOn(ctx, fit, cellBox(col, cell, cellSize), { fill: colors.cell });
  const size = { minX: 0, minY: 0, columns: width / cellSize, rows: height / cellSize, cellSize };
  gridOn(ctx, fit, size, colors.grid);
  const now = done[done.length - 1];
  const known = compared(done);
  const hit = new Set<number>();
  for (const each of query) {
    if (each.kind === 'test' && each.hit && known.has(`${each.a}:${each.b}`)) hit.add(each.a).add(each.b);
  }
  boxes.forEach((box, id) => {
    const look = lookOf(colors, hit.has(id) ? 'hit' : 'alone', String(id));
    const isNow = id === now.a || id === now.b;
    boxOn(ctx, fit, box, isNow ? { ...look, line: colors.now, lineWidth: 3 } : look);
  });
  boxOn(ctx, fit, cellBox(now.col, now.cell, cellSize), { line: colors.now, lineWidth: 2 });
}

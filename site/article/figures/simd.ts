// Fig. 24: the test of one box against four at once, lane by lane, and what it gains, timed in the reader's browser.
import { ro } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { demoColumns } from '../demo.ts';
import { type Box, place } from '../demos/cells.ts';
import { timeStep } from '../demos/timing.ts';
import source from '../demos/timing.ts?raw';
import { boxOn, fitWorld, text } from '../kit/drawing.ts';
import {
  button,
  contains,
  createView,
  element,
  excerpt,
  listing,
  makeDraggable,
  row,
  type Sheet,
  sayer,
  slider,
} from '../kit/index.ts';

const width = 480;
const height = 300;
/** The four boxes, and the initial place of the one that is compared with them. */
const four: readonly Box[] = [
  [30, 26, 84, 60],
  [196, 40, 62, 74],
  [306, 20, 92, 50],
  [404, 64, 50, 50],
];
const first: Box = [92, 52, 120, 46];
/** Lest a reader credits four lanes with more than four. */
const lanesAlone =
  'Four lanes explain a factor of at most 4 in what brute force gains in the kernel; the rest is compiled code, and ' +
  'numbers that lie side by side in memory.';
/** Where the comparisons are written. */
const table = { left: 204, top: 160, across: 64, down: 30 };

const contenders: readonly (readonly [name: string, make: (extent: number) => ro.coltech.Technique])[] = [
  ['Brute force, one by one', () => new ro.coltech.BruteForce()],
  ['Brute force, four at a time', () => new ro.coltech.BroadPhase({ technique: 'brute-force' })],
  ['Spatial grid of this article', (extent) => new ro.coltech.SpatialGrid(0, 0, extent, extent, 15)],
  ['The library, its own choice', () => new ro.coltech.BroadPhase()],
];

export function mount(root: HTMLElement): void {
  const [left, right] = demoColumns(root);
  const one: [number, number, number, number] = [...first];
  let count = 800;
  let timer = 0;

  const view = createView(left, {
    label: 'One box compared with four.',
    height: (across) => (across * height) / width,
    draw: (sheet) => draw(sheet, one),
  });
  makeDraggable(view, {
    label: 'A box that can be moved',
    fit: () => ({ x: 0, y: 0, scale: view.width / width }),
    holds: (x, y) => contains(one, x, y),
    moved: move,
    stepped: (dx, dy) => move(4 * dx, 4 * dy),
  });
  const say = sayer(left);

  const controls = row(right);
  slider(controls, {
    label: 'Boxes',
    min: 100,
    max: 2000,
    step: 100,
    value: count,
    format: (value) => value.toLocaleString('en'),
    moved(value) {
      count = value;
      soon();
    },
  });
  button(controls, 'Time again', time);
  const setBars = timeBars(right);
  const sayTime = sayer(right);
  right.append(element('p', { class: 'bar-key' }, lanesAlone));
  listing(right, 'site/article/demos/timing.ts', excerpt(source, 'export function timeStep'));
  show();
  soon();

  function move(dx: number, dy: number): void {
    one[0] = Math.min(Math.max(one[0] + dx, 0), width - one[2]);
    one[1] = Math.min(Math.max(one[1] + dy, 0), 130 - one[3]);
    show();
  }

  function show(): void {
    const rows = lanes(one);
    const hits = four.map((_, lane) => `b${lane}`).filter((_, lane) => rows.every(({ answers }) => answers[lane]));
    const who = hits.join(' and ') || 'none';
    say(`Four instructions, one for each row, and four boxes are compared. Yes in every row: ${who}.`);
    const told = rows.map(({ question, answers }) => `${question}: ${answers.map(yesOrNo).join(', ')}.`);
    view.describe(`Box a is compared with four boxes at once. ${told.join(' ')}`);
    view.redraw();
  }

  /** Times it once the slider has stopped, since that takes a moment. */
  function soon(): void {
    clearTimeout(timer);
    timer = window.setTimeout(time, 200);
  }

  function time(): void {
    const results = race(count);
    setBars(results.map(({ milliseconds }) => milliseconds));
    sayTime(inWords(count, results));
  }
}

/** The four comparisons of a box, each with all four. */
function lanes([x, y, across, down]: Box) {
  const ask = (question: string, answer: (box: Box) => boolean) => ({ question, answers: four.map(answer) });
  return [
    ask('a.left ≤ b.right', (b) => x <= b[0] + b[2]),
    ask('a.right ≥ b.left', (b) => x + across >= b[0]),
    ask('a.top ≤ b.bottom', (b) => y <= b[1] + b[3]),
    ask('a.bottom ≥ b.top', (b) => y + down >= b[1]),
  ];
}

const yesOrNo = (yes: boolean) => (yes ? 'yes' : 'no');

/** The boxes, and below them the table of their comparisons. */
function draw(sheet: Sheet, one: Box): void {
  const { ctx, colors } = sheet;
  const fit = fitWorld(sheet, [0, 0, width, height], [0, 0, 0, 0]);
  const at = (x: number, y: number) => [fit.x + x * fit.scale, fit.y + y * fit.scale] as const;
  const rows = lanes(one);
  four.forEach((box, lane) => {
    const hit = rows.every(({ answers }) => answers[lane]);
    const look = hit ? { fill: colors.hit, labelColor: colors.surface } : { fill: colors.box, labelColor: colors.text };
    boxOn(ctx, fit, box, { ...look, label: `b${lane}` });
  });
  boxOn(ctx, fit, one, { line: colors.now, lineWidth: 3, label: 'a', labelColor: colors.now });

  four.forEach((_, lane) => {
    text(ctx, `b${lane}`, ...at(table.left + (lane + 0.5) * table.across, table.top - 12), colors.muted);
  });
  rows.forEach(({ question, answers }, i) => {
    const y = table.top + i * table.down;
    text(ctx, question, ...at(table.left - 10, y + table.down / 2), colors.text, 'right');
    answers.forEach((yes, lane) => {
      const cell = [table.left + lane * table.across + 2, y + 2, table.across - 4, table.down - 4] as const;
      const look = yes
        ? { fill: colors.hit, labelColor: colors.surface }
        : { line: colors.grid, labelColor: colors.muted };
      boxOn(ctx, fit, cell, { ...look, label: yesOrNo(yes) });
    });
  });
}

/** Times every contender on the same boxes. */
function race(count: number): ReturnType<typeof timeStep>[] {
  const extent = Math.sqrt(count * 500);
  const random = createRandom(count);
  const boxes = Array.from({ length: count }, (): Box => [random() * extent, random() * extent, 10, 10]);
  return contenders.map(([, make]) => timeStep(place(make(extent), boxes)));
}

/** A bar for every contender. Returns what sets them. */
function timeBars(root: HTMLElement): (milliseconds: readonly number[]) => void {
  const bars = contenders.map(([name]) => {
    const piece = element('span', { 'data-part': name.startsWith('Brute') ? 'tests' : 'visits' });
    const sum = element('b', {}, '–');
    const line = element('p', { class: 'bar' }, element('span', {}, name), element('span', {}, piece), sum);
    return { piece, sum, line };
  });
  root.append(element('div', { class: 'bars timed' }, ...bars.map(({ line }) => line)));
  return (milliseconds) => {
    const slowest = Math.max(...milliseconds);
    milliseconds.forEach((each, i) => {
      bars[i].piece.style.width = `${(100 * each) / slowest}%`;
      bars[i].sum.textContent = `${each.toFixed(each < 1 ? 3 : 2)} ms`;
    });
  };
}

function inWords(count: number, results: readonly ReturnType<typeof timeStep>[]): string {
  const [brute, lanesAtOnce, grid, own] = results.map(({ milliseconds }) => milliseconds);
  const times = (a: number, b: number) => (a / b < 10 ? (a / b).toFixed(1) : Math.round(a / b));
  return (
    `${count.toLocaleString('en')} boxes, ${results[0].pairs.toLocaleString('en')} pairs each time. Brute force is ` +
    `${times(brute, lanesAtOnce)} times as fast in the kernel; the library’s own choice is ${times(grid, own)} times ` +
    'as fast as the grid.'
  );
}

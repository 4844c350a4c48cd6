// Fig. 10: the JavaScript heap over time, while the rings run on the grid with three cell sizes, and on the library.
//
// One page has one heap, so the four take turns, and the chart's clock runs only meanwhile. If the browser does not
// report the size of its heap, the chart shows the number of arrays created instead.

import { demoColumns } from '../demo.ts';
import source from '../demos/heap.ts?raw';
import { inTurn, type Samples, Turns, tellsHeap, turn } from '../heap-turns.ts';
import { levelLine, text } from '../kit/drawing.ts';
import {
  button,
  choice,
  createView,
  element,
  everyFrame,
  excerpt,
  listing,
  row,
  runWhileAttended,
  type Sheet,
  sayer,
} from '../kit/index.ts';

/** Milliseconds of the width of the chart. */
const shownTime = 4 * turn;
/** Milliseconds between updates of the table. */
const refresh = 200;
const MB = 1e6;
/** A turn's name is written if its stretch of the chart is wider than this, in CSS pixels. */
const roomForName = 64;
const colorOf = ['now', 'accent', 'muted', 'text'] as const;
const dashOf = [[], [], [2, 3], [7, 4]] as const;

export function mount(root: HTMLElement): () => void {
  const turns = new Turns();
  const { worlds } = turns;
  const [left, right] = demoColumns(root);
  const place = element('div', { class: 'stage' });
  left.append(place);
  const view = createView(place, {
    label: '',
    height: (width) => Math.min(300, Math.max(220, width * 0.62)),
    draw: (sheet) => draw(sheet, turns),
  });
  place.append(element('p', { class: 'stage-hint', 'aria-hidden': true }));
  view.canvas.tabIndex = 0;

  const controls = row(left);
  button(controls, 'Step', () => {
    attended.stop();
    step(1000 / 60);
    tell();
  });
  const names = worlds.map(({ name }, i) => [i, name] as const);
  choice(left, 'Running', [[inTurn, 'All in turn'], ...names], turns.chosen, (value) => {
    turns.chosen = value;
  });
  const write = table(right, turns);
  const say = sayer(right, true);
  listing(right, 'site/article/demos/heap.ts', excerpt(source, 'function on<T'));

  const step = (milliseconds: number) => {
    turns.step(milliseconds);
    view.redraw();
  };
  const tell = () => {
    const known = write();
    say(
      tellsHeap
        ? `${worlds[0].world.entities.length} squares. Large cells make few arrays, but many keys for the table of tested ` +
            'pairs. The little garbage with the library comes from the demo and the chart.'
        : 'This browser does not report the size of its memory, so the chart counts the arrays that the grids make.',
    );
    view.describe(
      `A chart of ${tellsHeap ? 'the JavaScript heap' : 'the arrays made'} over time. ` +
        `${known.length > 0 ? `${known.join('; ')}.` : 'Nothing has run yet.'}`,
    );
  };
  let rest = () => {};
  const attended = runWhileAttended(
    place,
    () => {
      rest = everyFrame((milliseconds) => step(Math.min(milliseconds, 100)), refresh, tell);
    },
    () => {
      rest();
      tell();
    },
    left,
  );
  tell();
  return attended.stop;
}

/** A table with a line for each world. Returns what writes the numbers, and says the known ones in words. */
function table(root: HTMLElement, { worlds, totals }: Turns): () => string[] {
  const body = element('tbody');
  const cells = worlds.map(({ name }) => {
    const line = ['arrays', 'growth', 'tidied'].map((what) =>
      element('td', { 'data-counter': `${name} ${what}` }, '–'),
    );
    body.append(element('tr', {}, element('th', { scope: 'row' }, name), ...line));
    return line;
  });
  const headings = ['', 'Arrays a step', tellsHeap ? 'MB a second' : 'Arrays a second', 'Tidied up'];
  const head = element('tr', {}, ...headings.map((heading) => element('th', { scope: 'col' }, heading)));
  root.append(element('div', { class: 'table' }, element('table', {}, element('thead', {}, head), body)));

  return () => {
    const known: string[] = [];
    totals.forEach(({ milliseconds, grown, collections }, i) => {
      if (milliseconds === 0) return;
      const rate = grown / (milliseconds / 1000) / (tellsHeap ? MB : 1);
      const { name, coltech } = worlds[i];
      const texts = [
        coltech.arraysCreated.toLocaleString('en'),
        rate.toLocaleString('en', { maximumFractionDigits: tellsHeap ? 1 : 0 }),
        tellsHeap ? `${collections}×` : '–',
      ];
      texts.forEach((each, k) => {
        cells[i][k].textContent = each;
      });
      known.push(`${name}: ${texts[1]} ${tellsHeap ? 'megabytes' : 'arrays'} a second`);
    });
    return known;
  };
}

/** The last samples as a line in the colour of whose turn it was. */
function draw(sheet: Sheet, { samples, clock, worlds }: Turns): void {
  const { ctx, width, height, colors } = sheet;
  const [start, end, top, bottom] = [46, width - 10, 26, height - 14];
  const from = Math.max(0, clock - shownTime);
  let begun = samples.first;
  while (begun < samples.count && samples.time(begun) < from) begun++;
  const [least, most] = range(samples, begun);
  const x = (time: number) => start + ((time - from) / shownTime) * (end - start);
  const y = (value: number) => bottom - ((value - least) / (most - least)) * (bottom - top);

  for (const value of [least, (least + most) / 2, most]) {
    levelLine(sheet, [start, end], y(value), label(value));
  }
  text(ctx, tellsHeap ? 'MB' : 'arrays', start - 8, 10, colors.muted, 'right');

  ctx.lineWidth = 2;
  ctx.lineJoin = 'round';
  while (begun < samples.count) {
    const owner = samples.owner(begun);
    const color = colors[colorOf[owner]];
    ctx.strokeStyle = color;
    ctx.setLineDash([...dashOf[owner]]);
    ctx.beginPath();
    const left = x(samples.time(begun));
    let right = left;
    for (; begun < samples.count && samples.owner(begun) === owner; begun++) {
      right = x(samples.time(begun));
      ctx.lineTo(right, y(samples.value(begun)));
    }
    ctx.stroke();
    if (right - left > roomForName) text(ctx, worlds[owner].name, left + 4, 10, color, 'left');
  }
  ctx.setLineDash([]);
}

/** The minimum and maximum of the samples from the first one shown, rounded outward. */
function range(samples: Samples, first: number): [least: number, most: number] {
  const grain = tellsHeap ? 10 * MB : 1000;
  if (first === samples.count) return [0, tellsHeap ? 20 * MB : 1000];
  let least = Infinity;
  let most = -Infinity;
  for (let i = first; i < samples.count; i++) {
    least = Math.min(least, samples.value(i));
    most = Math.max(most, samples.value(i));
  }
  least = Math.floor(least / grain) * grain;
  return [least, Math.max(least + 2 * grain, Math.ceil(most / grain) * grain)];
}

function label(value: number): string {
  return tellsHeap ? String(Math.round(value / MB)) : Math.round(value).toLocaleString('en', { notation: 'compact' });
}

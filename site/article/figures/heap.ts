// Fig. 10: the JavaScript heap over time, while the rings run on the grid with three cell sizes, and on the library.
//
// One page has one heap, so the four take turns, and the chart's clock runs only meanwhile. If the browser does not
// report the size of its heap, the chart shows the number of arrays created instead, which is always known.

import { heapSize } from '../../shared/heap.ts';
import { demoColumns } from '../demo.ts';
import { makeWorlds } from '../demos/heap.ts';
import source from '../demos/heap.ts?raw';
import { text } from '../kit/drawing.ts';
import { button, choice, createView, element, excerpt, listing, row, runWhileAttended, sayer } from '../kit/index.ts';

/** Milliseconds of one turn, and of the width of the chart. */
const turn = 3000;
const shownTime = 4 * turn;
/** Samples kept: more than there are frames in the time shown. */
const kept = 4096;
const MB = 1e6;
/** A turn's name is written if its stretch of the chart is wider than this, in CSS pixels. */
const roomForName = 64;
const inTurn = -1;
const colorOf = ['now', 'accent', 'muted', 'text'] as const;
const dashOf = [[], [], [2, 3], [7, 4]] as const;

export function mount(root: HTMLElement): () => void {
  const worlds = makeWorlds();
  const tellsHeap = heapSize() !== undefined;
  /** A ring of samples: when, how much, and whose turn it was. */
  const times = new Float64Array(kept);
  const values = new Float64Array(kept);
  const owners = new Uint8Array(kept);
  let samples = 0;
  let clock = 0;
  let made = 0;
  let chosen = inTurn;
  let frame = 0;
  const totals = worlds.map(() => ({ milliseconds: 0, grown: 0, collections: 0 }));

  const [left, right] = demoColumns(root);
  const place = element('div', { class: 'stage' });
  left.append(place);
  const view = createView(place, {
    label: '',
    height: (width) => Math.min(300, Math.max(220, width * 0.62)),
    draw(ctx, width, height, colors) {
      const [start, end, top, bottom] = [46, width - 10, 26, height - 14];
      const from = Math.max(0, clock - shownTime);
      const first = Math.max(0, samples - kept);
      const [least, most] = range(from, first);
      const x = (time: number) => start + ((time - from) / shownTime) * (end - start);
      const y = (value: number) => bottom - ((value - least) / (most - least)) * (bottom - top);

      ctx.strokeStyle = colors.grid;
      ctx.lineWidth = 1;
      for (const value of [least, (least + most) / 2, most]) {
        ctx.beginPath();
        ctx.moveTo(start, Math.round(y(value)) + 0.5);
        ctx.lineTo(end, Math.round(y(value)) + 0.5);
        ctx.stroke();
        text(ctx, label(value), start - 8, y(value), colors.muted, 'right');
      }
      text(ctx, tellsHeap ? 'MB' : 'arrays', start - 8, 10, colors.muted, 'right');

      ctx.lineWidth = 2;
      ctx.lineJoin = 'round';
      let begun = first;
      while (begun < samples && times[begun % kept] < from) begun++;
      while (begun < samples) {
        const owner = owners[begun % kept];
        const color = colors[colorOf[owner]];
        ctx.strokeStyle = color;
        ctx.setLineDash([...dashOf[owner]]);
        ctx.beginPath();
        const left = x(times[begun % kept]);
        let right = left;
        let i = begun;
        for (; i < samples && owners[i % kept] === owner; i++) {
          right = x(times[i % kept]);
          ctx.lineTo(right, y(values[i % kept]));
        }
        ctx.stroke();
        if (right - left > roomForName) text(ctx, worlds[owner].name, left + 4, 10, color, 'left');
        begun = i;
      }
      ctx.setLineDash([]);
    },
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
  choice(left, 'Running', [[inTurn, 'All in turn'], ...names], chosen, (value) => {
    chosen = value;
  });

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
  right.append(element('div', { class: 'table' }, element('table', {}, element('thead', {}, head), body)));
  const say = sayer(right, true);
  listing(right, 'site/article/demos/heap.ts', excerpt(source, 'function on<T'));

  const attended = runWhileAttended(
    place,
    () => {
      let last = performance.now();
      let told = last;
      const each = (now: number) => {
        // The time of a frame is its beginning, which may be before this was started.
        step(Math.min(Math.max(now - last, 0), 100));
        last = now;
        if (now - told > 200) {
          told = now;
          tell();
        }
        frame = requestAnimationFrame(each);
      };
      frame = requestAnimationFrame(each);
    },
    () => {
      cancelAnimationFrame(frame);
      tell();
    },
    left,
  );
  tell();
  return attended.stop;

  function whoseTurn(): number {
    return chosen === inTurn ? Math.floor(clock / turn) % worlds.length : chosen;
  }

  /** One step of the world whose turn it is, and one sample. */
  function step(milliseconds: number): void {
    const owner = whoseTurn();
    const { world, coltech } = worlds[owner];
    const before = heapSize() ?? made;
    world.step();
    made += coltech.arraysCreated;
    const value = heapSize() ?? made;

    const last = (samples - 1 + kept) % kept;
    const total = totals[owner];
    if (samples > 0 && owners[last] === owner) {
      const grown = value - values[last];
      if (grown >= 0) total.grown += grown;
      else total.collections++;
      total.milliseconds += milliseconds;
    } else {
      total.grown += Math.max(0, value - before);
      total.milliseconds += milliseconds;
    }
    clock += milliseconds;
    times[samples % kept] = clock;
    values[samples % kept] = value;
    owners[samples % kept] = owner;
    samples++;
    view.redraw();
  }

  /** The minimum and maximum of the values shown, rounded outward. */
  function range(from: number, first: number): [least: number, most: number] {
    let least = Infinity;
    let most = -Infinity;
    for (let i = first; i < samples; i++) {
      if (times[i % kept] < from) continue;
      least = Math.min(least, values[i % kept]);
      most = Math.max(most, values[i % kept]);
    }
    if (least === Infinity) return [0, tellsHeap ? 20 * MB : 1000];
    const grain = tellsHeap ? 10 * MB : 1000;
    least = Math.floor(least / grain) * grain;
    return [least, Math.max(least + 2 * grain, Math.ceil(most / grain) * grain)];
  }

  function label(value: number): string {
    return tellsHeap ? String(Math.round(value / MB)) : Math.round(value).toLocaleString('en', { notation: 'compact' });
  }

  function tell(): void {
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
  }
}

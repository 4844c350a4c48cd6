// Table 1: the grid's two extremes and the range between them, counted by running it.

import { demoColumns } from '../demo.ts';
import { hundredBoxes, measure } from '../demos/closing-table.ts';
import source from '../demos/closing-table.ts?raw';
import { boxOn, fitWorld, gridOn } from '../kit/drawing.ts';
import { createView, element, excerpt, listing, slider } from '../kit/index.ts';

const headings = ['Boxes', 'Tests by the grid', 'Arrays it makes', 'Tests by brute force', 'Ordered comparisons'];

export function mount(root: HTMLElement): void {
  let heaped = 0.5;
  const table = element(
    'table',
    {},
    element('thead', {}, element('tr', {}, ...headings.map((heading) => element('th', { scope: 'col' }, heading)))),
  );
  const body = element('tbody');
  table.append(body);
  const line = (name: string, share: number) => {
    const { tests, arrays, bruteForce, ordered } = measure(hundredBoxes(share));
    const numbers = [tests, arrays, bruteForce, ordered];
    return element(
      'tr',
      {},
      element('th', { scope: 'row' }, name),
      ...numbers.map((number) => element('td', {}, number.toLocaleString('en'))),
    );
  };
  body.append(line('Each alone in a cell', 0), line('All in one cell', 1));
  const between = element('tr');
  body.append(between);
  root.append(element('div', { class: 'table' }, table));

  const [left, right] = demoColumns(root);
  const view = createView(left, {
    label: 'A hundred boxes on a grid of ten by ten cells.',
    height: (width) => Math.min(width, 300),
    draw(sheet) {
      const { ctx, colors } = sheet;
      const fit = fitWorld(sheet, [0, 0, 150, 150]);
      gridOn(ctx, fit, { minX: 0, minY: 0, columns: 10, rows: 10, cellSize: 15 }, colors.grid);
      for (const box of hundredBoxes(heaped)) {
        ctx.globalAlpha = 0.5;
        boxOn(ctx, fit, box, { fill: colors.box });
        ctx.globalAlpha = 1;
        boxOn(ctx, fit, box, { line: colors.hit, lineWidth: 1 });
      }
    },
  });
  slider(left, {
    label: 'Heap them up',
    min: 0,
    max: 100,
    value: 100 * heaped,
    format: (percent) => `${percent} %`,
    moved(percent) {
      heaped = percent / 100;
      show();
    },
  });
  listing(right, 'site/article/demos/closing-table.ts', excerpt(source, 'export function measure'));
  show();

  function show(): void {
    const { tests, arrays, cells } = measure(hundredBoxes(heaped));
    const name = `Heaped up by ${Math.round(100 * heaped)} %`;
    between.replaceChildren(...line(name, heaped).childNodes);
    view.describe(
      `A hundred boxes on a grid of ten by ten cells, heaped up by ${Math.round(100 * heaped)} %: they are in ${cells} ` +
        `cells, which takes ${arrays} arrays and ${tests.toLocaleString('en')} tests.`,
    );
    view.redraw();
  }
}

// Fig. 12: the query for the colliding pairs, one operation at a time, beside the code that runs.
import gridSource from '../../../src/ro/coltech/spatial-grid.ts?raw';
import { boxes, drawGridScene, gridSize } from '../grid-scene.ts';
import { columns, counters, createStepper, createView, excerpt, listing, sayer } from '../kit/index.ts';
import { type QueryOperation, recordGrid } from '../record.ts';

const lights: Readonly<Record<QueryOperation['kind'], string>> = {
  visit: 'this.#forEachCell',
  lookup: 'if (checked.has',
  mark: 'checked.add(hashA)',
  test: 'if (this.aabb2DIntersection',
};

function explain(operation: QueryOperation): string {
  if (operation.kind === 'visit') {
    const { ids, col, cell } = operation;
    const where = `Cell grid[${col}][${cell}]`;
    if (ids.length === 1) return `${where} holds ${ids[0]} alone: nothing to compare.`;
    return `${where} holds ${ids.slice(0, -1).join(', ')} and ${ids.at(-1)}.`;
  }
  const { a, b } = operation;
  if (operation.kind === 'lookup') {
    return operation.known
      ? `${a} and ${b} have met in another cell: “${a}:${b}” is in the table. On to the next.`
      : `Have ${a} and ${b} been compared? “${a}:${b}” is not in the table.`;
  }
  if (operation.kind === 'mark') return `Both names go into the table: “${a}:${b}” and “${b}:${a}”.`;
  return operation.hit ? `${a} and ${b} overlap: a pair.` : `${a} and ${b} share a cell, but do not overlap.`;
}

export function mount(root: HTMLElement): () => void {
  const { query, cells } = recordGrid(boxes, gridSize);
  const [left, right] = columns(root);
  const source = listing(left, 'ro/coltech/spatial-grid.ts', excerpt(gridSource, 'queryForCollisionPairs()'));
  let at = 0;

  const view = createView(right, {
    label: 'Six boxes on a grid of four by three cells.',
    height: (width) => Math.min(300, width * 0.76),
    draw(sheet) {
      const now = query[at];
      const hit = new Set<number>();
      for (const each of query.slice(0, at + 1)) if (each.kind === 'test' && each.hit) hit.add(each.a).add(each.b);
      const about = now.kind === 'visit' ? [] : [now.a, now.b];
      drawGridScene(sheet, { filled: cells, at: [now], now: about, hit });
    },
  });
  const say = sayer(right, true);
  const count = counters(right, {
    visits: 'Cells visited',
    lookups: 'Lookups',
    tests: 'Comparisons',
    pairs: 'Pairs found',
  });

  const stepper = createStepper(root, {
    steps: query,
    show(operation, index) {
      at = index;
      source.light(lights[operation.kind]);
      const words = explain(operation);
      say(words);
      const done = query.slice(0, at + 1);
      const number = (kind: QueryOperation['kind']) => done.filter((each) => each.kind === kind).length;
      count({
        visits: number('visit'),
        lookups: number('lookup'),
        tests: number('test'),
        pairs: done.filter((each) => each.kind === 'test' && each.hit).length,
      });
      view.describe(`Six boxes, numbered 0 to 5, on a grid of four by three cells. ${words}`);
      view.redraw();
    },
  });
  return () => stepper.stop();
}

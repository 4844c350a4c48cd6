// Fig. 7: small boxes on a grid whose cells are so large that all of them are in one.
import { createRandom } from '../../../src/scenes/random.ts';
import { cellsFigure, world } from '../cells-figure.ts';

export function mount(root: HTMLElement): void {
  const random = createRandom(4);
  const side = 11;
  const boxes = Array.from(
    { length: 48 },
    () => [10 + random() * (world.width - 20 - side), 10 + random() * (world.height - 20 - side), side, side] as const,
  );
  cellsFigure(root, { what: '48 small boxes', cellSize: world.width, boxes });
}

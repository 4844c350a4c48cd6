// Fig. 6: large boxes on a grid whose cells are far too small for them.
import { cellsFigure } from '../cells-figure.ts';

export function mount(root: HTMLElement): void {
  cellsFigure(root, {
    what: 'Six large boxes',
    cellSize: 10,
    boxes: [
      [28, 24, 118, 96],
      [176, 52, 104, 112],
      [318, 20, 128, 88],
      [52, 158, 96, 116],
      [244, 136, 110, 128],
      [376, 150, 82, 120],
    ],
  });
}

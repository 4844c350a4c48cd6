// Fig. 8: giants and dwarfs on one grid, which no cell size suits.

import { cellsFigure } from '../cells-figure.ts';
import { mixedSizes } from '../demos/mixed-sizes.ts';

export function mount(root: HTMLElement): void {
  cellsFigure(root, { what: 'Four giants and 76 dwarfs', cellSize: 24, boxes: mixedSizes(80, 4) });
}

// Fig. 23: strips, live, with a number of boxes that the reader chooses.
import { structureFigure } from '../structure-figure.ts';

export function mount(root: HTMLElement): () => void {
  return structureFigure(root, {
    techniques: ['strip-sweep'],
    unit: 'Strips',
    count: 700,
    most: 2000,
    sides: [3, 16],
    speed: 0.8,
  });
}

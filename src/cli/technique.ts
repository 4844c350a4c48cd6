// Options that name techniques and the size of their cells, for `replay`, `compare` and `tune`.
import { BroadPhase } from 'broadphase';
import type { ReplayOptions } from 'broadphase/trace';
import { type Input, named, type Option, UsageError } from './arguments.ts';

export const techniqueHelp = BroadPhase.techniques.join(', ');

export const cellSizeOption: Record<string, Option> = {
  'cell-size': { value: 'size', help: 'the side of a cell, or one per axis, separated by commas; for grids' },
};

/** `--cell-size` as an option of BroadPhase. */
export function readCellSize(input: Input, dimensions: 2 | 3): Pick<ReplayOptions, 'cellSize'> {
  const text = input.text('cell-size');
  if (text === undefined) return {};
  const sizes = text.split(',').map(Number);
  if ((sizes.length !== 1 && sizes.length !== dimensions) || !sizes.every((size) => size > 0 && size < Infinity)) {
    throw new UsageError(
      `--cell-size is ${named(text)}, expected a number above 0, or ${dimensions} separated by commas`,
    );
  }
  return { cellSize: sizes.length === 1 ? sizes[0] : sizes };
}

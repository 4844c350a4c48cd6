// The boxes of figures 11 and 12, and the picture of them on their grid that both figures draw.
import { boxOn, cellBox, fitWorld, gridOn, lookOf, type Sheet } from './kit/index.ts';
import type { Box, GridSize, Place } from './record.ts';

export const gridSize: GridSize = { width: 200, height: 150, cellSize: 50 };
const columns = gridSize.width / gridSize.cellSize;
const rows = gridSize.height / gridSize.cellSize;

/** Two that overlap and share two cells, two that overlap in one cell, two that only share a cell, and one alone. */
export const boxes: readonly Box[] = [
  [6, 6, 20, 18],
  [30, 30, 34, 36],
  [56, 56, 38, 32],
  [116, 12, 52, 26],
  [142, 28, 44, 36],
  [62, 110, 26, 28],
];

export interface GridPicture {
  /** The cells filled so far. */
  filled: readonly Place[];
  /** The cells of the current step. */
  at?: readonly Place[];
  /** The boxes of the current step. */
  now?: readonly number[];
  /** The boxes known to collide. */
  hit?: ReadonlySet<number>;
}

export function drawGridScene(sheet: Sheet, { filled, at = [], now = [], hit = new Set() }: GridPicture): void {
  const { ctx, colors } = sheet;
  const { cellSize } = gridSize;
  const fit = fitWorld(sheet, [0, 0, gridSize.width, gridSize.height]);
  const boxOf = ({ col, cell }: Place) => cellBox(col, cell, cellSize);
  for (const place of filled) boxOn(ctx, fit, boxOf(place), { fill: colors.cell });
  gridOn(ctx, fit, { minX: 0, minY: 0, columns, rows, cellSize }, colors.grid);
  boxes.forEach((box, id) => {
    const look = lookOf(colors, hit.has(id) ? 'hit' : 'alone', String(id));
    boxOn(ctx, fit, box, now.includes(id) ? { ...look, line: colors.now, lineWidth: 3 } : look);
  });
  for (const place of at) boxOn(ctx, fit, boxOf(place), { line: colors.now, lineWidth: 2 });
}

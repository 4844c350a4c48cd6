// What all figures draw: a grid, shaded cells, boxes with their numbers; in world units, on a view in pixels.
import type { Colors } from './theme.ts';
import type { Sheet } from './view.ts';

/** Where a part of the world is in a view: world units times `scale`, plus the offset, are CSS pixels. */
export interface Fit {
  scale: number;
  x: number;
  y: number;
}

/** A world from (minX, minY), `across` by `down`, as large as a view has room for with a margin, in its middle. */
export function fitWorld(
  view: { width: number; height: number },
  [minX, minY, across, down]: readonly [number, number, number, number],
  margin: readonly [left: number, top: number, right: number, bottom: number] = [8, 8, 8, 8],
): Fit {
  const [left, top, right, bottom] = margin;
  const width = view.width - left - right;
  const height = view.height - top - bottom;
  const scale = Math.min(width / across, height / down);
  return {
    scale,
    x: left + (width - across * scale) / 2 - minX * scale,
    y: top + (height - down * scale) / 2 - minY * scale,
  };
}

/** A line of one sharp pixel. */
const sharp = (at: number) => Math.round(at) + 0.5;

/** The lines of a grid from (minX, minY), with these numbers of columns and rows. */
export function gridOn(
  ctx: CanvasRenderingContext2D,
  { scale, x, y }: Fit,
  grid: { minX: number; minY: number; columns: number; rows: number; cellSize: number },
  color: string,
): void {
  const { minX, minY, columns, rows, cellSize } = grid;
  const left = x + minX * scale;
  const top = y + minY * scale;
  const size = cellSize * scale;
  ctx.strokeStyle = color;
  ctx.lineWidth = 1;
  ctx.beginPath();
  for (let col = 0; col <= columns; col++) {
    ctx.moveTo(sharp(left + col * size), sharp(top));
    ctx.lineTo(sharp(left + col * size), sharp(top + rows * size));
  }
  for (let row = 0; row <= rows; row++) {
    ctx.moveTo(sharp(left), sharp(top + row * size));
    ctx.lineTo(sharp(left + columns * size), sharp(top + row * size));
  }
  ctx.stroke();
}

/** The box of a cell in a grid that begins at 0. */
export const cellBox = (column: number, row: number, cellSize: number) =>
  [column * cellSize, row * cellSize, cellSize, cellSize] as const;

/** How a box is drawn. */
export interface BoxLook {
  fill?: string | undefined;
  line?: string | undefined;
  dash?: readonly number[] | undefined;
  lineWidth?: number | undefined;
  /** Written in the middle. */
  label?: string | undefined;
  /** Writes it in the upper left corner instead, which another box rarely covers. */
  corner?: boolean | undefined;
  labelColor?: string | undefined;
}

export function boxOn(
  ctx: CanvasRenderingContext2D,
  { scale, x, y }: Fit,
  [boxX, boxY, width, height]: readonly [number, number, number, number],
  { fill, line, dash = [], lineWidth = 1.5, label, labelColor, corner = false }: BoxLook,
): void {
  const left = x + boxX * scale;
  const top = y + boxY * scale;
  const across = width * scale;
  const down = height * scale;
  if (fill) {
    ctx.fillStyle = fill;
    ctx.fillRect(left, top, across, down);
  }
  if (line) {
    ctx.strokeStyle = line;
    ctx.lineWidth = lineWidth;
    ctx.setLineDash([...dash]);
    ctx.strokeRect(left, top, across, down);
    ctx.setLineDash([]);
  }
  if (label) {
    const inset = corner ? 12 : Number.POSITIVE_INFINITY;
    const color = labelColor ?? line ?? '#000';
    text(ctx, label, left + Math.min(inset, across / 2), top + Math.min(inset, down / 2), color);
  }
}

/** A filled circle, in pixels. */
export function dot(ctx: CanvasRenderingContext2D, x: number, y: number, radius: number, color: string): void {
  ctx.fillStyle = color;
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 7);
  ctx.fill();
}

/** A sharp line across a plot at a height, in pixels, with its value before it. */
export function levelLine(
  { ctx, colors }: Sheet,
  [left, right]: readonly [number, number],
  y: number,
  value: string,
  color = colors.grid,
): void {
  ctx.strokeStyle = color;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(left, sharp(y));
  ctx.lineTo(right, sharp(y));
  ctx.stroke();
  text(ctx, value, left - 8, y, colors.muted, 'right');
}

export function text(
  ctx: CanvasRenderingContext2D,
  words: string,
  x: number,
  y: number,
  color: string,
  align: CanvasTextAlign = 'center',
): void {
  ctx.fillStyle = color;
  ctx.font = '600 13px system-ui, sans-serif';
  ctx.textAlign = align;
  ctx.textBaseline = 'middle';
  ctx.fillText(words, x, y + 0.5);
}

/** The look of a box, alone or colliding, with its number in a corner. */
export function lookOf(colors: Colors, state: 'alone' | 'hit', label?: string): BoxLook {
  return {
    fill: state === 'hit' ? colors.hit : colors.box,
    line: colors.page,
    lineWidth: 1,
    label,
    labelColor: state === 'hit' ? colors.surface : colors.text,
    corner: true,
  };
}

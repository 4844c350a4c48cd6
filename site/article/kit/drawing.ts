// What figures draw over and over: a grid, shaded cells, boxes with their numbers; in world units on a view of pixels.
import type { Colors } from './theme.ts';

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

/** How a box is drawn. */
export interface BoxLook {
  fill?: string | undefined;
  line?: string | undefined;
  dash?: readonly number[] | undefined;
  lineWidth?: number | undefined;
  /** Written in the middle. */
  label?: string | undefined;
  labelColor?: string | undefined;
}

export function boxOn(
  ctx: CanvasRenderingContext2D,
  { scale, x, y }: Fit,
  [boxX, boxY, width, height]: readonly [number, number, number, number],
  { fill, line, dash = [], lineWidth = 1.5, label, labelColor }: BoxLook,
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
  if (label) text(ctx, label, left + across / 2, top + down / 2, labelColor ?? line ?? '#000');
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

/** What a box is drawn in: alone, colliding, or what the step at hand is about. */
export function lookOf(colors: Colors, state: 'alone' | 'hit' | 'now', label?: string): BoxLook {
  if (state === 'now') return { fill: colors.box, line: colors.now, lineWidth: 2.5, label, labelColor: colors.text };
  return {
    fill: state === 'hit' ? colors.hit : colors.box,
    label,
    labelColor: state === 'hit' ? colors.surface : colors.text,
  };
}

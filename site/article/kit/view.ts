// A canvas to draw a figure on, in CSS pixels at the density of the display.
//
// It is drawn again when its width, the density or the colour scheme changes. Figures describe it in words with
// describe(), since a canvas alone says nothing to people who cannot see it.
import { element } from './dom.ts';
import { type Colors, onThemeChange, themeColors } from './theme.ts';

export interface View {
  readonly canvas: HTMLCanvasElement;
  /** In CSS pixels. */
  readonly width: number;
  readonly height: number;
  /** Draws once before the next frame, however often it is called. */
  redraw(): void;
  /** The text alternative. */
  describe(text: string): void;
}

/** What a figure is drawn on: an empty canvas, in CSS pixels, and the colours of the theme. */
export interface Sheet {
  readonly ctx: CanvasRenderingContext2D;
  readonly width: number;
  readonly height: number;
  readonly colors: Colors;
}

export interface ViewOptions {
  /** The height in CSS pixels for a width in CSS pixels. */
  height(width: number): number;
  /** Draws all of it. */
  draw(sheet: Sheet): void;
  /** The initial text alternative. */
  label: string;
}

const sharpest = 3;

export function createView(root: HTMLElement, { height: heightOf, draw, label }: ViewOptions): View {
  const canvas = element('canvas', { role: 'img', 'aria-label': label, class: 'view' });
  root.append(canvas);
  const ctx = canvas.getContext('2d')!;
  let width = 0;
  let height = 0;
  let awaited = false;

  const paint = () => {
    awaited = false;
    if (width === 0) return;
    const density = Math.min(sharpest, devicePixelRatio || 1);
    const columns = Math.round(width * density);
    const rows = Math.round(height * density);
    if (canvas.width !== columns) canvas.width = columns;
    if (canvas.height !== rows) canvas.height = rows;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, columns, rows);
    ctx.setTransform(columns / width, 0, 0, rows / height, 0, 0);
    draw({ ctx, width, height, colors: themeColors() });
  };
  const redraw = () => {
    if (awaited) return;
    awaited = true;
    requestAnimationFrame(paint);
  };
  const resize = () => {
    const now = canvas.clientWidth;
    if (now !== width && now > 0) {
      width = now;
      height = Math.round(heightOf(width));
      canvas.style.aspectRatio = `${width} / ${height}`;
    }
    redraw();
  };

  new ResizeObserver(resize).observe(canvas);
  onThemeChange(paint);
  resize();

  return {
    canvas,
    get width() {
      return width;
    },
    get height() {
      return height;
    },
    redraw,
    describe(text) {
      if (canvas.getAttribute('aria-label') !== text) canvas.setAttribute('aria-label', text);
    },
  };
}

/**
 * A canvas for a world of `ro`, which draws on it itself: `width` by `height` world units, as wide as there is room.
 * It takes the keyboard focus.
 */
export function worldCanvas(root: HTMLElement, width: number, height: number, label: string): HTMLCanvasElement {
  const canvas = element('canvas', { role: 'img', 'aria-label': label, class: 'view', width, height, tabindex: 0 });
  canvas.style.aspectRatio = `${width} / ${height}`;
  root.append(canvas);
  return canvas;
}

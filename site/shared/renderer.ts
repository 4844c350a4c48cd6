// Draws boxes in the colours of their slots: WebGL2 where there is one, else a 2D canvas.
import type { Camera } from './camera.ts';
import type { Palette } from './palette.ts';
import { createCanvasRenderer } from './renderer-canvas.ts';
import { createWebglRenderer } from './renderer-webgl.ts';

export interface BoxRenderer {
  readonly kind: 'webgl2' | 'canvas-2d';
  setPalette(palette: Palette): void;
  /** boxes: minX, minY, maxX, maxY of each; slots: the palette slot of each. */
  draw(boxes: Float32Array, slots: Uint8Array, count: number, camera: Camera): void;
}

/** redraw is called when what was drawn is lost and has to be drawn again. */
export function createRenderer(canvas: HTMLCanvasElement, redraw: () => void, only2d = false): BoxRenderer {
  return (only2d ? undefined : createWebglRenderer(canvas, redraw)) ?? createCanvasRenderer(canvas);
}

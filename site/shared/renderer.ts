// Draws boxes in the colours of their slots: with WebGL2 on a GPU, otherwise in software on a 2D canvas.
import type { Camera } from './camera.ts';
import type { Palette } from './palette.ts';
import { CanvasRenderer } from './renderer-canvas.ts';
import { createWebglRenderer, hasFastWebgl } from './renderer-webgl.ts';

export interface BoxRenderer {
  readonly kind: 'webgl2' | 'canvas-2d';
  setPalette(palette: Palette): void;
  /** boxes: minX, minY, maxX, maxY of each; slots: the palette slot of each. */
  draw(boxes: Float32Array, slots: Uint8Array, count: number, camera: Camera): void;
}

export type RendererKind = BoxRenderer['kind'];

/**
 * @param redraw called when the picture is lost and has to be drawn again
 * @param kind by default WebGL2 if it runs on a GPU, otherwise the 2D canvas
 */
export function createRenderer(canvas: HTMLCanvasElement, redraw: () => void, kind?: RendererKind): BoxRenderer {
  const wanted = kind ?? (hasFastWebgl() ? 'webgl2' : 'canvas-2d');
  const webgl = wanted === 'webgl2' ? createWebglRenderer(canvas, redraw) : undefined;
  return webgl ?? new CanvasRenderer(canvas);
}

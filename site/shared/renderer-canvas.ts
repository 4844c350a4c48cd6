// The fallback without WebGL2: rectangles on a 2D canvas, sorted by colour so that the style changes once per colour.
import { slotCount } from './groups.ts';
import type { BoxRenderer } from './renderer.ts';

/** From this many pixels on a box is drawn as an outline with a light fill. */
const outlineFrom = 9;

export function createCanvasRenderer(canvas: HTMLCanvasElement): BoxRenderer {
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) throw new Error('this browser gives neither a WebGL2 nor a 2D canvas');
  const styles: string[] = [];
  let background = '';
  let order = new Uint32Array();
  const next = new Uint32Array(slotCount + 1);

  const style = (r: number, g: number, b: number, a: number) =>
    `rgb(${Math.round(r * 255)} ${Math.round(g * 255)} ${Math.round(b * 255)} / ${a})`;

  return {
    kind: 'canvas-2d',
    setPalette(palette) {
      const c = palette.slots;
      for (let slot = 0; slot < slotCount; slot++) {
        styles[slot] = style(c[4 * slot], c[4 * slot + 1], c[4 * slot + 2], c[4 * slot + 3]);
      }
      background = style(...palette.background, 1);
    },
    draw(boxes, slots, count, camera) {
      const { width, height, scale } = camera;
      const left = width / 2 - camera.x * scale;
      const top = height / 2 + camera.y * scale;
      context.fillStyle = background;
      context.fillRect(0, 0, width, height);
      context.lineWidth = 1.25 * devicePixelRatio;

      // Counting sort: next[slot] ends as the place after the last box of that slot.
      if (order.length < count) order = new Uint32Array(count);
      next.fill(0);
      for (let id = 0; id < count; id++) next[slots[id] + 1]++;
      for (let slot = 1; slot <= slotCount; slot++) next[slot] += next[slot - 1];
      for (let id = 0; id < count; id++) order[next[slots[id]]++] = id;

      let k = 0;
      for (let slot = 0; slot < slotCount; slot++) {
        context.fillStyle = styles[slot];
        context.strokeStyle = styles[slot];
        for (; k < next[slot]; k++) {
          const i = 4 * order[k];
          const minX = Math.max(-9, left + boxes[i] * scale);
          const maxX = Math.min(width + 9, left + boxes[i + 2] * scale);
          const minY = Math.max(-9, top - boxes[i + 3] * scale);
          const maxY = Math.min(height + 9, top - boxes[i + 1] * scale);
          const w = maxX - minX;
          const h = maxY - minY;
          if (w < 0 || h < 0) continue;
          if (Math.min(w, h) < outlineFrom * devicePixelRatio) {
            context.fillRect(minX, minY, Math.max(1, w), Math.max(1, h));
          } else {
            context.globalAlpha = 0.3;
            context.fillRect(minX, minY, w, h);
            context.globalAlpha = 1;
            context.strokeRect(minX, minY, w, h);
          }
        }
      }
    },
  };
}

// Without a GPU: paints boxes into an array of pixels, in one pass, with the same look as the shaders. This is far
// faster than the rectangles of a 2D canvas, or WebGL in software.
import type { Camera } from './camera.ts';
import { density } from './density.ts';
import { cellSlot, slotCount } from './groups.ts';
import { light, lightFrom, outlineFrom, outlineWidth, overhang, solid } from './look.ts';
import type { Palette } from './palette.ts';
import type { BoxRenderer } from './renderer.ts';

const opaque = 256;

/** A colour over another, with alpha from 0 to 256. Red and blue are mixed at once: there is a byte between them. */
function mix(under: number, over: number, alpha: number): number {
  const rest = opaque - alpha;
  const redBlue = (Math.imul(under & 0xff00ff, rest) + Math.imul(over & 0xff00ff, alpha)) >>> 8;
  const green = (Math.imul(under & 0xff00, rest) + Math.imul(over & 0xff00, alpha)) >>> 8;
  return 0xff000000 | (redBlue & 0xff00ff) | (green & 0xff00);
}

const clamp = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

const pack = (red: number, green: number, blue: number) =>
  (0xff000000 | (Math.round(blue * 255) << 16) | (Math.round(green * 255) << 8) | Math.round(red * 255)) >>> 0;

export class CanvasRenderer implements BoxRenderer {
  readonly kind = 'canvas-2d';
  readonly #context: CanvasRenderingContext2D;
  readonly #colours = new Uint32Array(slotCount);
  readonly #alphas = new Float32Array(slotCount);
  #background = 0;
  #image = new ImageData(1, 1);
  #pixels = new Uint32Array(this.#image.data.buffer);
  /**
   * A box to paint, in pixels, y down. It is passed here because numbers with fractions that go in as arguments would
   * each be put on the heap.
   */
  readonly #edges = new Float64Array(4);

  constructor(canvas: HTMLCanvasElement) {
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('this browser supports neither WebGL2 nor a 2D canvas');
    this.#context = context;
  }

  setPalette({ slots, background }: Palette): void {
    for (let slot = 0; slot < slotCount; slot++) {
      this.#colours[slot] = pack(slots[4 * slot], slots[4 * slot + 1], slots[4 * slot + 2]);
      this.#alphas[slot] = slots[4 * slot + 3];
    }
    this.#background = pack(...background);
  }

  draw(boxes: Float32Array, slots: Uint8Array, count: number, { x, y, width, height, scale }: Camera): void {
    if (this.#image.width !== width || this.#image.height !== height) {
      this.#image = new ImageData(width, height);
      this.#pixels = new Uint32Array(this.#image.data.buffer);
    }
    this.#pixels.fill(this.#background);
    const edges = this.#edges;
    const originX = width / 2 - x * scale;
    const originY = height / 2 + y * scale;
    const pixels = density();
    for (let id = 0; id < count; id++) {
      const i = 4 * id;
      const minX = clamp(originX + boxes[i] * scale, -overhang, width + overhang);
      const maxX = clamp(originX + boxes[i + 2] * scale, -overhang, width + overhang);
      const minY = clamp(originY - boxes[i + 3] * scale, -overhang, height + overhang);
      const maxY = clamp(originY - boxes[i + 1] * scale, -overhang, height + overhang);
      // The smallest box is still a pixel wide.
      const padX = Math.max(0, 1 - (maxX - minX)) / 2;
      const padY = Math.max(0, 1 - (maxY - minY)) / 2;
      edges[0] = minX - padX;
      edges[1] = minY - padY;
      edges[2] = maxX + padX;
      edges[3] = maxY + padY;
      this.#paint(slots[id], pixels);
    }
    this.#context.putImageData(this.#image, 0, 0);
  }

  /** @param density how many pixels of the canvas a CSS pixel has */
  #paint(slot: number, density: number): void {
    const pixels = this.#pixels;
    const { width, height } = this.#image;
    const left = this.#edges[0];
    const top = this.#edges[1];
    const right = this.#edges[2];
    const bottom = this.#edges[3];
    const x0 = Math.max(0, Math.floor(left));
    const x1 = Math.min(width, Math.ceil(right));
    const y0 = Math.max(0, Math.floor(top));
    const y1 = Math.min(height, Math.ceil(bottom));
    const colour = this.#colours[slot];
    const strength = this.#alphas[slot] * opaque;
    const extent = Math.min(right - left, bottom - top) / density;

    if (extent < outlineFrom) {
      for (let y = y0; y < y1; y++) {
        const row = strength * solid * (Math.min(bottom, y + 1) - Math.max(top, y));
        for (let x = x0, at = y * width + x0; x < x1; x++, at++) {
          const covered = Math.min(right, x + 1) - Math.max(left, x);
          pixels[at] = mix(pixels[at], colour, (row * covered) | 0);
        }
      }
      return;
    }

    const ease = Math.min(1, (extent - outlineFrom) / (lightFrom - outlineFrom));
    const least = slot === cellSlot ? 0 : light;
    const fill = solid - (solid - least) * ease * ease * (3 - 2 * ease);
    const reach = outlineWidth * density + 0.5;
    const band = Math.ceil(reach + 1);
    for (let y = y0; y < y1; y++) {
      const row = strength * (Math.min(bottom, y + 1) - Math.max(top, y));
      const insideY = Math.min(y + 0.5 - top, bottom - y - 0.5);
      const plain = (row * (fill + (1 - fill) * clamp(reach - insideY, 0, 1))) | 0;
      const at = y * width;
      for (let x = x0; x < x1; x++) {
        if (x === x0 + band) {
          // Between the two sides a row has one alpha.
          const end = x1 - band;
          if (plain === 0) x = Math.max(x, end);
          for (; x < end; x++) pixels[at + x] = mix(pixels[at + x], colour, plain);
        }
        const inside = Math.min(insideY, x + 0.5 - left, right - x - 0.5);
        const covered = Math.min(right, x + 1) - Math.max(left, x);
        const alpha = (row * covered * (fill + (1 - fill) * clamp(reach - inside, 0, 1))) | 0;
        pixels[at + x] = mix(pixels[at + x], colour, alpha);
      }
    }
  }
}

// The canvas: a drawing context in world units, and nothing about the world's state.
//
// The canvas' width and height attributes, as they are when the screen is made, say how much of the world is seen.
// How large that is shown is up to CSS (say `width: 100%`), and the number of pixels behind it follows from both
// and the display's density, so lines stay sharp on any display, at any size, at any zoom.
import { checkFinite } from './checks.ts';
import type { Vector } from './vector.ts';

/**
 * A canvas to draw on in world units. The width and height attributes of the canvas, as they are when the screen is
 * made, say how much of the world is seen; how large it is shown is up to CSS. A world with a canvas has one.
 *
 * @example
 * new World(null).screen; // → null
 */
export class Screen {
  /** What is drawn on. */
  readonly canvas: HTMLCanvasElement;
  /** Draws in world units. */
  readonly ctx: CanvasRenderingContext2D;
  /** How many of the canvas's own pixels a world unit is. */
  readonly scale: number;
  /** The part of the world that is seen, from { x: 0, y: 0 }, in world units. */
  readonly size: Readonly<Vector>;

  /**
   * @param scale pixels of the canvas for each world unit: above 0, finite
   * @throws RangeError for another scale, Error when the canvas has no 2D context to give.
   */
  constructor(canvas: HTMLCanvasElement, scale = 1) {
    checkFinite('ro.Screen: scale', scale);
    const ctx = canvas.getContext('2d');
    if (!ctx)
      throw new Error('ro.Screen: the canvas has no 2D context; expected one without a context of another kind');
    this.canvas = canvas;
    this.ctx = ctx;
    this.scale = scale;
    this.size = { x: canvas.width / scale, y: canvas.height / scale };
    // The shape on the page must not follow the number of pixels, which is rounded.
    canvas.style.aspectRatio ||= `${canvas.width} / ${canvas.height}`;
    this.clear();
  }

  /**
   * Empties the canvas, and fits it first to the size and density it is now shown at. The world does so in each step.
   *
   * @example
   * new World(null).screen?.clear(); // → undefined
   */
  clear(): void {
    const { canvas, ctx, size } = this;
    this.#fit();
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, canvas.width, canvas.height);
    ctx.setTransform(canvas.width / size.x, 0, 0, canvas.height / size.y, 0, 0);
  }

  /**
   * The world position of a place on the canvas, given in CSS pixels from its upper left corner.
   * @param target filled and returned, if given
   *
   * @example
   * new World(null).screen?.toWorld(10, 10); // → undefined
   */
  toWorld(offsetX: number, offsetY: number, target: Vector = { x: 0, y: 0 }): Vector {
    const { canvas, scale, size } = this;
    target.x = (offsetX * size.x) / (canvas.clientWidth || size.x * scale);
    target.y = (offsetY * size.y) / (canvas.clientHeight || size.y * scale);
    return target;
  }

  #fit(): void {
    const { canvas } = this;
    const { clientWidth, clientHeight } = canvas;
    if (clientWidth === 0 || clientHeight === 0) return; // not on the page, or hidden
    const density = globalThis.devicePixelRatio || 1;
    const width = Math.round(clientWidth * density);
    const height = Math.round(clientHeight * density);
    if (canvas.width === width && canvas.height === height) return;
    canvas.width = width;
    canvas.height = height;
    // Where no style sheet sets the width, the canvas has just grown: hold it where it was.
    if (canvas.clientWidth !== clientWidth) canvas.style.width = `${clientWidth}px`;
  }
}

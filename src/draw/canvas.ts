// A space on a 2D canvas. Paths are made in units of the world, under the transform that the context has, and stroked
// without it: so lines are as thin at every zoom.
import type { BroadPhase } from 'broadphase';
import { bad, checkRay, checkSpace } from './checks.ts';
import { Shapes, type Sink } from './shapes.ts';

/** The colours of what is drawn, as CSS has them. */
export interface Colors {
  /** Boxes without a partner. Default `'#8893a5'`. */
  boxes: string;
  /** Boxes that are in a pair, and their pairs. Default `'#e0457b'`. */
  pairs: string;
  /** Cells, strips or nodes. Default `'#3f8fdc'`. */
  cells: string;
  /** Full cells. Default `'#f08c1a'`. */
  hot: string;
  /** Rays and what they hit. Default `'#2ba24c'`. */
  rays: string;
}

/** Options of {@link drawSpace}, all optional. */
export interface DrawOptions {
  /** Whether boxes are drawn. Default true. */
  boxes?: boolean | undefined;
  /** Whether boxes in a pair get a colour, and a line to their partner. Default true. */
  pairs?: boolean | undefined;
  /** Whether the cells, strips or nodes of the technique are drawn. Default false. */
  cells?: boolean | undefined;
  /** Whether the fullest cells are filled, the fuller the stronger. Default false. */
  hot?: boolean | undefined;
  /** Rays to cast and draw: for each its origin, its direction, and optionally the maximum distance, 4 or 5 numbers. */
  rays?: readonly (readonly number[])[] | undefined;
  /** Some other colours. */
  colors?: Partial<Colors> | undefined;
  /** The width of lines, in pixels of the canvas. Default 1. */
  lineWidth?: number | undefined;
}

const defaultColors: Colors = {
  boxes: '#8893a5',
  pairs: '#e0457b',
  cells: '#3f8fdc',
  hot: '#f08c1a',
  rays: '#2ba24c',
};
const colorNames = Object.keys(defaultColors) as (keyof Colors)[];
const switchNames = ['boxes', 'pairs', 'cells', 'hot'] as const;
const optionNames = [...switchNames, 'rays', 'colors', 'lineWidth'];
/** How much the insides of boxes cover. */
const inside = 0.15;
const hotInside = 0.5;

/**
 * Draws a 2D space: its boxes, those in a pair in another colour, and whatever the options add. Coordinates are those
 * of the world, under the context's current transform. The context is left as it was.
 *
 * @throws RangeError for a 3D space, or a ray out of range, TypeError for any other wrong argument or option; nothing is
 * drawn then
 * @throws as `rayCast` does, such as for a ray too long for a world that wraps around: what comes before it is drawn
 *
 * @example
 * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
 * const frame = (context: CanvasRenderingContext2D) => {
 *   context.clearRect(0, 0, 300, 150);
 *   drawSpace(context, space, { cells: true, rays: [[-5, 5, 1, 0]] });
 * };
 * typeof frame; // → 'function'
 */
export function drawSpace(
  context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D,
  space: BroadPhase<2 | 3>,
  options: DrawOptions = {},
): void {
  check(context, space, options);
  const { boxes = true, pairs = true, cells = false, hot = false, rays = [], lineWidth = 1 } = options;
  const colors = { ...defaultColors };
  for (const name of colorNames) colors[name] = options.colors?.[name] ?? defaultColors[name];
  const shapes = new Shapes(space);
  const sink: Sink = {
    box(numbers, at) {
      const [minX, minY] = [numbers[at], numbers[at + 1]];
      context.rect(minX, minY, numbers[at + 2] - minX, numbers[at + 3] - minY);
    },
    line(from, to) {
      context.moveTo(from[0], from[1]);
      context.lineTo(to[0], to[1]);
    },
  };
  const world = context.getTransform();
  const paint = (color: string, fill: number, line: boolean) => {
    context.strokeStyle = context.fillStyle = color;
    context.globalAlpha = fill;
    if (fill > 0) context.fill();
    context.globalAlpha = 1;
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (line) context.stroke();
    context.setTransform(world);
    context.beginPath();
  };

  context.save();
  try {
    context.lineWidth = lineWidth;
    context.setLineDash([]);
    context.beginPath();
    if (hot) {
      let share = 0;
      const one: Sink = {
        ...sink,
        box(numbers, at) {
          sink.box(numbers, at);
          paint(colors.hot, hotInside * share, false);
        },
      };
      shapes.hotCells(one, (full) => {
        share = full;
      });
    }
    if (cells) {
      shapes.cells(sink);
      paint(colors.cells, 0, true);
    }
    if (boxes) {
      shapes.boxes(sink);
      paint(colors.boxes, inside, true);
    }
    if (pairs) {
      shapes.touching(sink);
      paint(colors.pairs, inside, true);
      shapes.pairs(sink);
      paint(colors.pairs, 0, true);
    }
    for (const ray of rays) shapes.ray(sink, ray);
    paint(colors.rays, rays.length > 0 ? inside : 0, true);
  } finally {
    context.restore();
  }
}

function check(context: { getTransform?: unknown }, space: BroadPhase<2 | 3>, options: DrawOptions): void {
  if (typeof context?.getTransform !== 'function') bad('drawSpace', context, 'a 2D context');
  checkSpace('drawSpace', space, 2);
  checkNames('drawSpace: options', options, optionNames);
  const { rays = [], colors = {}, lineWidth = 1 } = options;
  checkNames('drawSpace: colors', colors, colorNames);
  for (const name of colorNames) {
    if (typeof (colors[name] ?? '') !== 'string') bad(`drawSpace: colors.${name}`, colors[name], 'a string');
  }
  for (const name of switchNames) {
    if (typeof (options[name] ?? true) !== 'boolean') bad(`drawSpace: ${name}`, options[name], 'true or false');
  }
  if (!(Number.isFinite(lineWidth) && lineWidth > 0)) bad('drawSpace: lineWidth', lineWidth, 'a number above 0');
  if (!Array.isArray(rays)) bad('drawSpace: rays', rays, 'an array');
  for (const ray of rays) checkRay('drawSpace: rays', ray, 2);
}

function checkNames(what: string, given: object, known: readonly string[]): void {
  if (!given || typeof given !== 'object') bad(what, given, 'an object');
  for (const name of Object.keys(given)) {
    if (!known.includes(name)) bad(what, name, `one of ${known.join(', ')}`);
  }
}

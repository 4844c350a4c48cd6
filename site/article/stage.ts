// The stage of a figure whose world moves: a canvas that runs while the reader attends to it, a Step button for readers
// who want no motion, live numbers, and a text alternative that is kept up to date.
import type { World } from 'broadphase/ro';
import {
  button,
  type Colors,
  counters,
  element,
  everyFrame,
  onThemeChange,
  row,
  runWhileAttended,
  themeColors,
  worldCanvas,
} from './kit/index.ts';

/** Milliseconds between updates of the numbers while it runs. */
const refresh = 100;

export interface StageOptions<D extends { readonly world: World }> {
  /** In world units. */
  width: number;
  height: number;
  /** Sets up the demo. The colours object stays the same, and is updated with the theme. */
  build(canvas: HTMLCanvasElement, colors: Colors): D;
  /** The counters below the canvas: the key of each, and its name on the page. */
  counters: Readonly<Record<string, string>>;
  /** Their current values. `rate` is the frames per second, 0 at rest. */
  count(demo: D, rate: number): Readonly<Record<string, string | number>>;
  /** Called for every frame that is shown: for a second picture beside the world's own. */
  frame?(demo: D): void;
  /** The picture in words. */
  inWords(demo: D): string;
}

export interface Stage<D> {
  readonly demo: D;
  readonly canvas: HTMLCanvasElement;
  /** The row of buttons below the canvas. */
  readonly controls: HTMLElement;
  /** Draws and counts again without a step, after a change. */
  refresh(): void;
  /** Stops it. */
  rest(): void;
}

export function createStage<D extends { readonly world: World }>(
  root: HTMLElement,
  options: StageOptions<D>,
): Stage<D> {
  const { width, height, build, count, inWords } = options;
  const place = element('div', { class: 'stage' });
  root.append(place);
  const canvas = worldCanvas(place, width, height, '');
  place.append(element('p', { class: 'stage-hint', 'aria-hidden': true }));
  const controls = row(root);
  const write = counters(root, options.counters);

  const colors = { ...themeColors() };
  const demo = build(canvas, colors);
  const { world } = demo;

  let rate = 0;
  let unwatch = () => {};
  const tell = () => {
    write(count(demo, rate));
    canvas.setAttribute('aria-label', `${inWords(demo)} ${world.isRunning ? 'Running.' : 'At rest.'}`);
  };
  const still = () => {
    if (world.isRunning) return;
    world.step(0);
    options.frame?.(demo);
    tell();
  };

  const attended = runWhileAttended(
    place,
    () => {
      world.start();
      unwatch = everyFrame(
        () => options.frame?.(demo),
        refresh,
        (measured) => {
          rate = measured;
          tell();
        },
      );
    },
    () => {
      world.stop();
      unwatch();
      rate = 0;
      tell();
    },
    root,
  );
  addEventListener('beforeprint', attended.stop); // what runs would take the colours of paper with its next frame only
  button(controls, 'Step', () => {
    attended.stop();
    world.step();
    still();
  });

  onThemeChange(() => {
    Object.assign(colors, themeColors());
    still();
  });
  new ResizeObserver(still).observe(canvas);
  still();

  return { demo, canvas, controls, refresh: () => (world.isRunning ? tell() : still()), rest: attended.stop };
}

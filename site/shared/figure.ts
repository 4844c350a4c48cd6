// One live figure: a scene, the space that finds its pairs, and the view it is drawn in.
// Each frame: step the scene, find the pairs (this alone is timed), colour, draw. Nothing is allocated.
import type { BroadPhase } from 'broadphase';
import { Camera } from './camera.ts';
import { density } from './density.ts';
import { Groups } from './groups.ts';
import { FrameLoop } from './loop.ts';
import { makePalette } from './palette.ts';
import { panZoom } from './pan-zoom.ts';
import { type BoxRenderer, createRenderer, type RendererKind } from './renderer.ts';
import type { LiveScene } from './scenes.ts';
import { Timings } from './timings.ts';

export class Figure {
  readonly camera = new Camera();
  readonly groups = new Groups();
  readonly timings = new Timings();
  readonly loop: FrameLoop;
  readonly renderer: BoxRenderer;
  scene: LiveScene | undefined;
  readonly #space: BroadPhase<2 | 3>;
  readonly #canvas: HTMLCanvasElement;
  #drawAgain = 0;

  /** @param view contains the canvas, and gets pointer and key events */
  constructor(view: HTMLElement, space: BroadPhase<2 | 3>, kind?: RendererKind) {
    this.#canvas = view.querySelector('canvas')!;
    this.#space = space;
    this.renderer = createRenderer(this.#canvas, this.redraw, kind);
    this.loop = new FrameLoop(() => this.step());
    this.loop.watch(view);
    panZoom(view, this.camera, this.redraw);

    const dark = matchMedia('(prefers-color-scheme: dark)');
    const dress = () => {
      const background = getComputedStyle(view).getPropertyValue('--page').trim();
      this.renderer.setPalette(makePalette(dark.matches, background));
      this.redraw();
    };
    dark.addEventListener('change', dress);
    dress();

    new ResizeObserver(() => this.#fitCanvas()).observe(this.#canvas);
    this.#fitCanvas();
  }

  /** Shows the whole of another scene. */
  show(scene: LiveScene): void {
    this.scene = scene;
    this.#space.clear();
    this.timings.clear();
    this.camera.fit(scene.world);
    this.solve();
  }

  /** One frame of the scene. */
  step(): void {
    if (!this.scene) return;
    this.scene.step();
    this.solve();
  }

  /** Finds the pairs of the current boxes, and draws them. */
  solve(): void {
    const { scene, groups } = this;
    if (!scene) return;
    const space = this.#space;
    space.boxes(scene.count).set(scene.boxes);
    const started = performance.now();
    space.update();
    const ended = performance.now();
    this.timings.add(ended, ended - started);
    groups.update(space.pairs, space.pairCount, scene.count);
    this.#draw();
  }

  /** Draws again before the next frame, without a step, after the view or the colours have changed. */
  readonly redraw = (): void => {
    cancelAnimationFrame(this.#drawAgain);
    this.#drawAgain = requestAnimationFrame(this.#draw);
  };

  readonly #draw = (): void => {
    const { scene, camera } = this;
    if (scene) this.renderer.draw(scene.boxes, this.groups.slots, scene.count, camera);
  };

  #fitCanvas(): void {
    const width = Math.round(this.#canvas.clientWidth * density());
    const height = Math.round(this.#canvas.clientHeight * density());
    if (width === this.camera.width && height === this.camera.height) return;
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.camera.resize(width, height);
    this.#draw();
  }
}

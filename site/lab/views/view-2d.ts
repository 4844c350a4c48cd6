// Flat scenes: cells and boxes by the renderer of the site, pairs as lines on a canvas above it.
import { Camera, type World } from '../../shared/camera.ts';
import { density } from '../../shared/density.ts';
import { outlineFrom } from '../../shared/look.ts';
import { locate, panZoom } from '../../shared/pan-zoom.ts';
import { createRenderer, type RendererKind } from '../../shared/renderer.ts';
import type { Picture } from '../worker/messages.ts';
import { type LabView, onPalette, onSize } from './view.ts';

/** A click this near to a box counts for it, in CSS pixels. */
const fingertip = 14;
const cellsLookedAt = 100;
const noBoxes = new Float32Array();
const noSlots = new Uint8Array();

/** Draws pairs as lines, or clears those of before. */
function drawLines(
  canvas: HTMLCanvasElement,
  ends: Float32Array | undefined,
  { x, y, scale, width, height }: Camera,
): void {
  const context = canvas.getContext('2d')!;
  context.clearRect(0, 0, width, height);
  if (!ends) return;
  const left = width / 2 - x * scale;
  const top = height / 2 + y * scale;
  context.strokeStyle = getComputedStyle(canvas).color;
  context.lineWidth = Math.max(1, density());
  context.globalAlpha = 0.7;
  context.beginPath();
  for (let k = 0; k < ends.length; k += 4) {
    context.moveTo(left + ends[k] * scale, top - ends[k + 1] * scale);
    context.lineTo(left + ends[k + 2] * scale, top - ends[k + 3] * scale);
  }
  context.stroke();
}

/** Whether most cells are smaller than a size, by a look at some of them. Those without an outline cannot be seen. */
function mostAreSmaller({ drawn, cells }: Picture, size: number): boolean {
  const every = Math.ceil(cells / cellsLookedAt);
  let [small, all] = [0, 0];
  for (let at = 0; at < 4 * cells; at += 4 * every) {
    all++;
    if (Math.max(drawn[at + 2] - drawn[at], drawn[at + 3] - drawn[at + 1]) < size) small++;
  }
  return 2 * small > all;
}

/** The element holds two canvases, the upper one for lines. */
export function createFlatView(element: HTMLElement, moved: () => void, kind?: RendererKind): LabView {
  const [canvas, upper] = element.querySelectorAll('canvas');
  const camera = new Camera();
  let picture: Picture | undefined;
  let world: World = [0, 0, 1, 1];
  let awaited = 0;

  /** The width of a CSS pixel in the world. */
  const pixel = () => camera.width / canvas.getBoundingClientRect().width / camera.scale;
  const draw = () => {
    if (!picture) return renderer.draw(noBoxes, noSlots, 0, camera); // the colour of the page, until the worker answers
    const { drawn, slots, cells, boxes, lines } = picture;
    renderer.draw(drawn, slots, cells + boxes, camera);
    drawLines(upper, lines, camera);
  };
  const redraw = () => {
    cancelAnimationFrame(awaited);
    awaited = requestAnimationFrame(draw);
  };
  const changed = () => {
    redraw();
    moved();
  };

  const renderer = createRenderer(canvas, redraw, kind);
  panZoom(element, camera, changed);
  onPalette(element, (palette) => {
    renderer.setPalette(palette);
    redraw();
  });
  onSize(element, (width, height) => {
    for (const each of [canvas, upper]) Object.assign(each, { width, height });
    camera.resize(width, height);
    draw();
  });

  return {
    element,
    fit(given) {
      world = given as World;
      camera.fit(world);
      redraw();
    },
    show(next) {
      picture = next;
      cancelAnimationFrame(awaited);
      draw();
    },
    zoom(factor) {
      camera.zoom(factor);
      changed();
    },
    get look() {
      if (camera.fitted) return undefined;
      const [minX, minY, maxX, maxY] = world;
      return [(camera.x - minX) / (maxX - minX), (camera.y - minY) / (maxY - minY), camera.zoomed];
    },
    set look(given) {
      camera.fit();
      if (given?.length === 3) {
        const [minX, minY, maxX, maxY] = world;
        camera.look(minX + given[0] * (maxX - minX), minY + given[1] * (maxY - minY), given[2]);
      }
      redraw();
    },
    get cellsTooSmall() {
      return picture ? mostAreSmaller(picture, outlineFrom * pixel()) : false;
    },
    place(clientX, clientY) {
      const at = locate(canvas, camera, clientX, clientY);
      const x = camera.x + (at.x - camera.width / 2) / camera.scale;
      const y = camera.y + (at.y - camera.height / 2) / camera.scale;
      return { place: [x, y], reach: fingertip * pixel() };
    },
  };
}

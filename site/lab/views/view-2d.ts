// Flat scenes: cells and boxes by the renderer of the site, pairs as lines on a canvas above it.
import { Camera, type World } from '../../shared/camera.ts';
import { makePalette } from '../../shared/palette.ts';
import { panZoom } from '../../shared/pan-zoom.ts';
import { createRenderer, type RendererKind } from '../../shared/renderer.ts';
import type { Picture } from '../worker/messages.ts';
import { type LabView, onSize } from './view.ts';

/** A click this near to a box counts for it, in CSS pixels. */
const fingertip = 14;
/** The renderer fills boxes smaller than this, in CSS pixels: cells are outlines, so there is nothing left of them. */
const leastCell = 4;
const cellsLookedAt = 100;

/** The element holds two canvases, the upper one for lines. */
export function createFlatView(element: HTMLElement, moved: () => void, kind?: RendererKind): LabView {
  const [canvas, upper] = element.querySelectorAll('canvas');
  const lines = upper.getContext('2d')!;
  const camera = new Camera();
  let picture: Picture | undefined;
  let world: World = [0, 0, 1, 1];
  let awaited = 0;

  const draw = () => {
    if (!picture) return;
    const { drawn, slots, cells, boxes } = picture;
    renderer.draw(drawn, slots, cells + boxes, camera);
    drawLines();
  };
  const drawLines = () => {
    lines.clearRect(0, 0, upper.width, upper.height);
    const ends = picture?.lines;
    if (!ends) return;
    const { scale, width, height } = camera;
    const left = width / 2 - camera.x * scale;
    const top = height / 2 + camera.y * scale;
    lines.strokeStyle = getComputedStyle(element).color;
    lines.lineWidth = Math.max(1, Math.min(2, devicePixelRatio));
    lines.globalAlpha = 0.7;
    lines.beginPath();
    for (let k = 0; k < ends.length; k += 4) {
      lines.moveTo(left + ends[k] * scale, top - ends[k + 1] * scale);
      lines.lineTo(left + ends[k + 2] * scale, top - ends[k + 3] * scale);
    }
    lines.stroke();
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
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const dress = () => {
    renderer.setPalette(makePalette(dark.matches, getComputedStyle(element).getPropertyValue('--page').trim()));
    redraw();
  };
  dark.addEventListener('change', dress);
  dress();
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
      if (!picture || picture.cells === 0) return false;
      const { drawn, cells } = picture;
      const least = (leastCell * camera.width) / canvas.clientWidth / camera.scale;
      const every = Math.ceil(cells / cellsLookedAt);
      let [small, all] = [0, 0];
      for (let at = 0; at < 4 * cells; at += 4 * every) {
        all++;
        if (Math.max(drawn[at + 2] - drawn[at], drawn[at + 3] - drawn[at + 1]) < least) small++;
      }
      return 2 * small > all;
    },
    place(clientX, clientY) {
      const frame = canvas.getBoundingClientRect();
      const density = camera.width / frame.width;
      const x = camera.x + ((clientX - frame.left) * density - camera.width / 2) / camera.scale;
      const y = camera.y + ((frame.bottom - clientY) * density - camera.height / 2) / camera.scale;
      return { place: [x, y], reach: (fingertip * density) / camera.scale };
    },
  };
}

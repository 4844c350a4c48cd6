// A showcase: a map with 20,000 labels. Each is shown from some scale on, so panning changes none, and zooming in only
// adds labels.

import { firstScales } from './first-scales.mjs';
import { canvasIn } from './page/canvas.mjs';
import { time } from './page/showcase.mjs';
import { moveView } from './page/view.mjs';
import { labels as rivals } from './rivals.mjs';
import { mapSize, placesOf } from './words.mjs';

const count = 20_000;
const deepest = 64;
/** Two scales per octave. */
const steps = 12;
/** How fast the flight zooms, in octaves per second. */
const speed = 0.7;

/** The showcase: see examples/page/showcase.mjs. */
export function mapDemo(stage, { wake, say }) {
  const labels = placesOf(count);
  const context = document.createElement('canvas').getContext('2d');
  for (const label of labels) {
    context.font = `${label.size}px system-ui, sans-serif`;
    label.width = context.measureText(label.name).width + 8;
    label.height = 1.3 * label.size;
  }
  const find = { broadphase: firstScales, ...rivals };
  let scales = [];
  let first = new Float64Array(count);
  let view;
  let flight;

  const fit = () => {
    const scale = Math.min(stage.clientWidth / mapSize[0], stage.clientHeight / mapSize[1]);
    return { scale, x: (stage.clientWidth - scale * mapSize[0]) / 2, y: (stage.clientHeight - scale * mapSize[1]) / 2 };
  };
  /** Places all labels again if the smallest scale has changed. */
  function place(finder) {
    const { scale } = fit();
    scales = Array.from({ length: steps + 1 }, (_, k) => scale * deepest ** (k / steps));
    first = finder(labels, scales);
  }
  const redraw = canvasIn(stage, (context, width, height, { dark, page, text }) => {
    const whole = fit();
    if (scales[0] !== whole.scale) {
      place(find.broadphase);
      view = undefined;
    }
    view ??= whole;
    const { scale, x, y } = view;
    let shown = 0;
    const hidden = new Path2D();
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineJoin = 'round';
    context.lineWidth = 3;
    context.strokeStyle = page;
    for (const [k, label] of labels.entries()) {
      const [atX, atY] = [x + scale * label.x, y + scale * label.y];
      if (atX < -60 || atY < -20 || atX > width + 60 || atY > height + 20) continue;
      if (first[k] > scale) hidden.rect(atX - 0.75, atY - 0.75, 1.5, 1.5);
      else shown++;
    }
    context.fillStyle = dark ? 'oklch(0.55 0.06 250 / 0.55)' : 'oklch(0.6 0.06 250 / 0.5)';
    context.fill(hidden);
    for (let k = count - 1; k >= 0; k--) {
      if (first[k] > scale) continue;
      const { name, x: labelX, y: labelY, size } = labels[k];
      const [atX, atY] = [x + scale * labelX, y + scale * labelY];
      if (atX < -60 || atY < -20 || atX > width + 60 || atY > height + 20) continue;
      // New labels fade in.
      context.globalAlpha = first[k] === scales[0] ? 1 : Math.min(1, 0.25 + 2 * Math.log2(scale / first[k]));
      context.font = `${k < 90 ? 600 : 450} ${size}px system-ui, sans-serif`;
      context.strokeText(name, atX, atY);
      context.fillStyle = text;
      context.fillText(name, atX, atY);
    }
    context.globalAlpha = 1;
    stage.style.touchAction = scale > 1.001 * whole.scale ? 'none' : 'pan-y';
    say(
      `${count.toLocaleString('en')} labels; ${shown.toLocaleString('en')} of them in view and shown, at ${(scale / whole.scale).toFixed(1)} times the size`,
    );
  });
  let request = 0;
  const redrawSoon = () => {
    cancelAnimationFrame(request);
    request = requestAnimationFrame(redraw);
  };
  function zoomTo(scale, x, y) {
    const whole = fit();
    const wanted = Math.min(deepest * whole.scale, Math.max(whole.scale, scale));
    const factor = wanted / view.scale;
    view = { scale: wanted, x: x - factor * (x - view.x), y: y - factor * (y - view.y) };
    if (wanted === whole.scale) view = whole;
    redrawSoon();
  }
  stage.tabIndex = 0;
  moveView(stage, {
    pan(dx, dy) {
      view = { ...view, x: view.x + dx, y: view.y + dy };
      redrawSoon();
    },
    zoom: (factor, x, y) => zoomTo(factor * view.scale, x, y),
    point() {},
  });
  const middle = () => [stage.clientWidth / 2, stage.clientHeight / 2];
  return {
    legend: `All 20,000 labels at ${steps + 1} scales, by`,
    contenders: { broadphase: 'broadphase', rbush: 'rbush, one by one' },
    use(key) {
      place(find[key]);
      redrawSoon();
    },
    race: (key) => time(() => find[key](labels, scales)),
    actions: {
      'Zoom in': () => zoomTo(view.scale * 1.6, ...middle()),
      'Zoom out': () => zoomTo(view.scale / 1.6, ...middle()),
      Fly() {
        flight = { from: performance.now(), x: stage.clientWidth * 0.46, y: stage.clientHeight * 0.42 };
        view = fit();
        wake();
      },
    },
    step() {
      if (!flight) return false;
      const octaves = speed * ((performance.now() - flight.from) / 1000);
      const top = Math.log2(deepest) - 1;
      const depth = Math.max(0, octaves < top ? octaves : 2 * top - octaves);
      zoomTo(fit().scale * 2 ** depth, flight.x, flight.y);
      if (octaves >= 2 * top) flight = undefined;
      return flight !== undefined;
    },
    settle() {
      flight = undefined;
      zoomTo(fit().scale * 8, ...middle());
    },
    stop() {
      flight = undefined;
    },
    get state() {
      return { labels, first, view, scales };
    },
  };
}

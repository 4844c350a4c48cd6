// A showcase: a map with 20,000 labels. Each is shown from some scale on, so panning changes none, and zooming in only
// adds labels.

import { firstScales } from './first-scales.mjs';
import { canvasIn } from './page/canvas.mjs';
import { inNextFrame, time } from './page/showcase.mjs';
import { moveView } from './page/view.mjs';
import { labels as rivals } from './rivals.mjs';
import { mapSize, placesOf } from './words.mjs';

const count = 20_000;
const deepest = 64;
/** Two scales per octave. */
const steps = 12;
/** How fast the flight zooms, in octaves per second. */
const speed = 0.7;

/** Labels with their sizes on the screen, which are the same at all scales. */
function makeLabels() {
  const context = document.createElement('canvas').getContext('2d');
  return placesOf(count).map((place) => {
    context.font = `${place.size}px system-ui, sans-serif`;
    return { ...place, width: context.measureText(place.name).width + 8, height: 1.3 * place.size };
  });
}

/** What the stage shows of the map, whose corner is at `x`, `y` on the stage. */
class View {
  #stage;
  #changed;

  constructor(stage, changed) {
    this.#stage = stage;
    this.#changed = changed;
    this.fit();
  }

  /** The scale that shows the whole map. */
  get smallest() {
    return Math.min(this.#stage.clientWidth / mapSize[0], this.#stage.clientHeight / mapSize[1]);
  }

  fit() {
    this.scale = this.smallest;
    this.x = (this.#stage.clientWidth - this.scale * mapSize[0]) / 2;
    this.y = (this.#stage.clientHeight - this.scale * mapSize[1]) / 2;
  }

  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
    this.#changed();
  }

  zoom(factor, x, y) {
    this.zoomTo(factor * this.scale, x, y);
  }

  /** The place on the map that is at `x`, `y` stays there. */
  zoomTo(scale, x = this.#stage.clientWidth / 2, y = this.#stage.clientHeight / 2) {
    const before = this.scale;
    this.scale = Math.min(deepest * this.smallest, Math.max(this.smallest, scale));
    const factor = this.scale / before;
    this.x = x - factor * (x - this.x);
    this.y = y - factor * (y - this.y);
    if (this.scale === this.smallest) this.fit();
    this.#changed();
  }

  point() {} // nothing is picked
}

/** Draws the labels in view: the names of those that are shown, dots for the others. Returns how many are shown. */
function draw(context, width, height, labels, { scales, first }, view, { dark, page, text }) {
  const hidden = new Path2D();
  const shown = [];
  for (const [k, label] of labels.entries()) {
    const [x, y] = [view.x + view.scale * label.x, view.y + view.scale * label.y];
    if (x < -60 || y < -20 || x > width + 60 || y > height + 20) continue;
    if (first[k] > view.scale) hidden.rect(x - 0.75, y - 0.75, 1.5, 1.5);
    else shown.push({ k, x, y });
  }
  context.fillStyle = dark ? 'oklch(0.55 0.06 250 / 0.55)' : 'oklch(0.6 0.06 250 / 0.5)';
  context.fill(hidden);
  Object.assign(context, { textAlign: 'center', textBaseline: 'middle', lineJoin: 'round', lineWidth: 3 });
  context.strokeStyle = page;
  context.fillStyle = text;
  for (const { k, x, y } of shown.reverse()) {
    // New labels fade in.
    context.globalAlpha = first[k] === scales[0] ? 1 : Math.min(1, 0.25 + 2 * Math.log2(view.scale / first[k]));
    context.font = `${k < 90 ? 600 : 450} ${labels[k].size}px system-ui, sans-serif`;
    context.strokeText(labels[k].name, x, y);
    context.fillText(labels[k].name, x, y);
  }
  context.globalAlpha = 1;
  return shown.length;
}

const write = (number) => number.toLocaleString('en');

/** The showcase: see examples/page/showcase.mjs. */
export function mapDemo(stage, { wake, say }) {
  const labels = makeLabels();
  const find = { broadphase: firstScales, ...rivals };
  let placed = { scales: [], first: [] };
  let flight;
  const redraw = canvasIn(stage, (context, width, height, colours) => {
    if (placed.scales[0] !== view.smallest) {
      place('broadphase');
      view.fit();
    }
    const shown = draw(context, width, height, labels, placed, view, colours);
    const zoomed = view.scale / view.smallest;
    stage.style.touchAction = zoomed > 1.001 ? 'none' : 'pan-y';
    say(`${write(count)} labels; ${write(shown)} of them in view and shown, at ${zoomed.toFixed(1)} times the size`);
  });
  const redrawSoon = inNextFrame(redraw);
  const view = new View(stage, redrawSoon);

  function place(key) {
    const scales = Array.from({ length: steps + 1 }, (_, k) => view.smallest * deepest ** (k / steps));
    placed = { scales, first: find[key](labels, scales) };
  }
  stage.tabIndex = 0;
  moveView(stage, view);
  return {
    legend: `All 20,000 labels at ${steps + 1} scales, by`,
    contenders: { broadphase: 'broadphase', rbush: 'rbush, one by one' },
    use(key) {
      place(key);
      redrawSoon();
    },
    race: (key) => time(() => find[key](labels, placed.scales)),
    actions: {
      'Zoom in': () => view.zoom(1.6),
      'Zoom out': () => view.zoom(1 / 1.6),
      Fly() {
        flight = { from: performance.now(), x: stage.clientWidth * 0.46, y: stage.clientHeight * 0.42 };
        view.fit();
        wake();
      },
    },
    step() {
      if (!flight) return false;
      const octaves = speed * ((performance.now() - flight.from) / 1000);
      const top = Math.log2(deepest) - 1;
      const depth = Math.max(0, octaves < top ? octaves : 2 * top - octaves);
      view.zoomTo(view.smallest * 2 ** depth, flight.x, flight.y);
      if (octaves >= 2 * top) flight = undefined;
      return flight !== undefined;
    },
    settle() {
      flight = undefined;
      view.zoomTo(8 * view.smallest);
    },
    stop() {
      flight = undefined;
    },
  };
}

// Draws the contents of a 2D space as lines over a PixiJS scene. Add it to the container that moves with the world, and
// call its update() after the space's. It is for debugging: it reads every box each time.
import { Lines } from 'broadphase/draw';
import { Graphics } from 'pixi.js';

const colors = { cells: 0x3f8fdc, boxes: 0x8893a5, pairs: 0xe0457b, rays: 0x2ba24c };

export class SpaceOverlay extends Graphics {
  #lines = new Lines();

  constructor(space) {
    super();
    this.space = space;
    /** Whether the cells of the technique are shown. */
    this.cells = false;
    /** Rays to cast and show: each has an origin, a direction, and optionally a maximum distance. */
    this.rays = [];
  }

  update() {
    const { space } = this;
    this.clear();
    if (this.cells) this.#add(colors.cells, (lines) => lines.addCells(space));
    this.#add(colors.boxes, (lines) => lines.addBoxes(space));
    this.#add(colors.pairs, (lines) => lines.addTouching(space).addPairs(space));
    this.#add(colors.rays, (lines) => {
      for (const ray of this.rays) lines.addRay(space, ray);
    });
  }

  #add(color, fill) {
    const lines = this.#lines.clear();
    fill(lines);
    const { data, length } = lines;
    for (let k = 0; k < length; k += 4) this.moveTo(data[k], data[k + 1]).lineTo(data[k + 2], data[k + 3]);
    if (length > 0) this.stroke({ color, pixelLine: true }); // one pixel wide at every zoom
  }
}

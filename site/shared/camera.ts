// The part of the world in view. The world's y axis points up. Pixels are device pixels, also with y up, as in WebGL.

/** minX, minY, maxX, maxY. */
export type World = readonly [number, number, number, number];

const fitMargin = 0.03;
const closest = 400;
const farthest = 0.5;

export class Camera {
  width = 1;
  height = 1;
  /** World point in the middle of the view. */
  x = 0;
  y = 0;
  /** Device pixels per world unit. */
  scale = 1;
  /** Called whenever the whole world begins or ceases to be shown. */
  fittedChanged: () => void = () => {};
  #fitted = true;
  #world: World = [0, 0, 1, 1];

  /** True while the whole world is shown; then a new size or world is fitted again. */
  get fitted(): boolean {
    return this.#fitted;
  }
  #setFitted(fitted: boolean): void {
    if (fitted === this.#fitted) return;
    this.#fitted = fitted;
    this.fittedChanged();
  }

  #fitScale(): number {
    const [minX, minY, maxX, maxY] = this.#world;
    return Math.min(this.width / (maxX - minX), this.height / (maxY - minY)) * (1 - fitMargin);
  }

  fit(world: World = this.#world): void {
    this.#world = world;
    this.x = (world[0] + world[2]) / 2;
    this.y = (world[1] + world[3]) / 2;
    this.scale = this.#fitScale();
    this.#setFitted(true);
  }

  /** The scale, relative to the one that shows the whole world. */
  get zoomed(): number {
    return this.scale / this.#fitScale();
  }

  /** Puts a world point into the middle, at a scale relative to the one that shows the whole world. */
  look(x: number, y: number, zoomed: number): void {
    this.fit();
    this.zoom(zoomed);
    this.x = x;
    this.y = y;
    this.#setFitted(false);
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    if (this.fitted) this.fit();
  }

  /** Moves the view by pixels, so that the world follows the pointer. */
  pan(dx: number, dy: number): void {
    const [minX, minY, maxX, maxY] = this.#world;
    this.x = Math.min(maxX, Math.max(minX, this.x - dx / this.scale));
    this.y = Math.min(maxY, Math.max(minY, this.y - dy / this.scale));
    this.#setFitted(false);
  }

  /** Zooms by a factor around a pixel, which keeps showing the same point of the world. */
  zoom(factor: number, px = this.width / 2, py = this.height / 2): void {
    const fit = this.#fitScale();
    const scale = Math.min(fit * closest, Math.max(fit * farthest, this.scale * factor));
    const dx = px - this.width / 2;
    const dy = py - this.height / 2;
    this.x += dx / this.scale - dx / scale;
    this.y += dy / this.scale - dy / scale;
    this.scale = scale;
    this.#setFitted(false);
  }
}

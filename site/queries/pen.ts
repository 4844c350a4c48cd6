// Draws the query and its answer on top of the boxes, in coordinates of the world, whose y axis points up.
import type { BroadPhase } from 'broadphase';
import { type DrawOptions, drawSpace } from 'broadphase/draw';
import type { Camera } from '../shared/camera.ts';

/** accent: the query; text: the answer; faint: what would be. */
export type Ink = 'accent' | 'text' | 'faint';

const tip = 9;

export class Pen {
  readonly #context: CanvasRenderingContext2D;
  readonly #camera: Camera;
  readonly #inks: Record<Ink, string> = { accent: '', text: '', faint: '' };
  #density = 1;

  constructor(canvas: HTMLCanvasElement, camera: Camera) {
    this.#context = canvas.getContext('2d')!;
    this.#camera = camera;
  }

  /** Takes the colours from the page's style. */
  dress(style: CSSStyleDeclaration): void {
    this.#inks.accent = style.getPropertyValue('--accent').trim();
    this.#inks.text = style.getPropertyValue('--text').trim();
    this.#inks.faint = style.getPropertyValue('--muted').trim();
  }

  /** @param density device pixels per CSS pixel */
  begin(density: number): void {
    this.#density = density;
    this.#context.clearRect(0, 0, this.#camera.width, this.#camera.height);
  }

  #use(ink: Ink, width: number, dashed: boolean): void {
    const context = this.#context;
    context.strokeStyle = context.fillStyle = this.#inks[ink];
    context.lineWidth = width * this.#density;
    context.setLineDash(dashed ? [6 * this.#density, 5 * this.#density] : []);
    context.beginPath();
  }

  #x(x: number): number {
    return this.#camera.width / 2 + (x - this.#camera.x) * this.#camera.scale;
  }
  #y(y: number): number {
    return this.#camera.height / 2 - (y - this.#camera.y) * this.#camera.scale;
  }

  box(minX: number, minY: number, maxX: number, maxY: number, ink: Ink, dashed = false): void {
    const context = this.#context;
    this.#use(ink, 2, dashed);
    context.rect(this.#x(minX), this.#y(maxY), (maxX - minX) * this.#camera.scale, (maxY - minY) * this.#camera.scale);
    context.globalAlpha = 0.1;
    context.fill();
    context.globalAlpha = 1;
    context.stroke();
  }

  /** Draws what broadphase/draw shows of a space. */
  space(space: BroadPhase<2 | 3>, options: DrawOptions): void {
    const context = this.#context;
    const { scale } = this.#camera;
    context.setTransform(scale, 0, 0, -scale, this.#x(0), this.#y(0));
    drawSpace(context, space, { ...options, lineWidth: this.#density });
    context.resetTransform();
  }

  circle(x: number, y: number, radius: number, ink: Ink): void {
    const context = this.#context;
    this.#use(ink, 2, false);
    context.arc(this.#x(x), this.#y(y), radius * this.#camera.scale, 0, 2 * Math.PI);
    context.globalAlpha = 0.1;
    context.fill();
    context.globalAlpha = 1;
    context.stroke();
  }

  /** A dot of this many pixels. */
  dot(x: number, y: number, size: number, ink: Ink): void {
    this.#use(ink, 1, false);
    this.#context.arc(this.#x(x), this.#y(y), size * this.#density, 0, 2 * Math.PI);
    this.#context.fill();
  }

  line(x: number, y: number, toX: number, toY: number, ink: Ink, dashed = false): void {
    this.#use(ink, 2, dashed);
    this.#context.moveTo(this.#x(x), this.#y(y));
    this.#context.lineTo(this.#x(toX), this.#y(toY));
    this.#context.stroke();
  }

  /** An arrow from a point, of this many pixels. */
  arrow(x: number, y: number, directionX: number, directionY: number, pixels: number, ink: Ink): void {
    const length = Math.hypot(directionX, directionY);
    if (length === 0) return;
    const context = this.#context;
    const [dx, dy] = [directionX / length, -directionY / length];
    const [fromX, fromY] = [this.#x(x), this.#y(y)];
    const reach = pixels * this.#density;
    const [toX, toY] = [fromX + dx * reach, fromY + dy * reach];
    const head = tip * this.#density;
    this.#use(ink, 2.5, false);
    context.moveTo(fromX, fromY);
    context.lineTo(toX, toY);
    context.moveTo(toX - head * (dx + dy * 0.6), toY - head * (dy - dx * 0.6));
    context.lineTo(toX, toY);
    context.lineTo(toX - head * (dx - dy * 0.6), toY - head * (dy + dx * 0.6));
    context.stroke();
  }
}

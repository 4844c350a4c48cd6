// A canvas for tests without a page: it records what is drawn on it, and is laid out as it is told.
export class FakeCanvas extends EventTarget {
  width: number;
  height: number;
  /** The width CSS gives it; undefined for a canvas that no style sheet sizes. */
  cssWidth: number | undefined;
  style: Record<string, string> = {};
  tabIndex = -1;
  ownerDocument = new EventTarget();
  /** Every call on the context, in order: its name and arguments. */
  calls: [name: string, ...args: unknown[]][] = [];
  context: Record<string, unknown> | null;

  constructor(width: number, height: number, cssWidth?: number) {
    super();
    this.width = width;
    this.height = height;
    this.cssWidth = cssWidth;
    this.context = { canvas: this };
    for (const name of ['setTransform', 'clearRect', 'fillRect', 'strokeRect']) {
      this.context[name] = (...args: unknown[]) => this.calls.push([name, ...args]);
    }
  }
  get clientWidth(): number {
    return this.cssWidth ?? (Number.parseFloat(this.style.width) || this.width);
  }
  get clientHeight(): number {
    const [w, h] = (this.style.aspectRatio ?? `${this.width} / ${this.height}`).split('/').map(Number);
    return Math.round((this.clientWidth * h) / w);
  }
  getContext(): unknown {
    return this.context;
  }
  hasAttribute(): boolean {
    return false;
  }
  /** The names of the calls since the last time, in order. */
  drain(): string[] {
    return this.calls.splice(0).map(([name]) => name);
  }
  /** Fires an event with these properties. */
  fire(type: string, properties: object = {}, on: EventTarget = this): void {
    on.dispatchEvent(Object.assign(new Event(type), { isPrimary: true }, properties));
  }
  asElement(): HTMLCanvasElement {
    return this as unknown as HTMLCanvasElement;
  }
}

// The pointer (mouse, pen or finger) and the keys, as they are now: state to read in `update`, not events to handle.
import type { Screen } from './screen.ts';
import type { Vector } from './vector.ts';

/** Where the pointer is, in world units, and what it does there. */
export interface Pointer extends Vector {
  /** Whether it is over the canvas; a finger is only while it touches. */
  isOver: boolean;
  /** Whether a button is held, or a finger is down, that was pressed on the canvas. */
  isDown: boolean;
}

/**
 * The pointer (mouse, pen or finger) and the keys, as they are now: state to read in `update`, not events to handle. A
 * world with a canvas has one.
 *
 * @example
 * new World(null).input; // → null
 */
export class Input {
  /** Where the pointer is, and what it does. */
  readonly pointer: Readonly<Pointer>;
  /** The keys now held while the canvas has the focus, by `KeyboardEvent.code`: 'ArrowLeft', 'KeyA', 'Space'. */
  readonly keys: ReadonlySet<string>;
  readonly #listening = new AbortController();

  /** Frameworks that wrap what they hold in proxies, such as Vue, leave alone objects whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'Input';
  }

  /** Listens on the screen's canvas, and lets it take the keyboard focus if it could not before. */
  constructor(screen: Screen) {
    const { canvas } = screen;
    const pointer: Pointer = { x: 0, y: 0, isOver: false, isDown: false };
    const keys = new Set<string>();
    this.pointer = pointer;
    this.keys = keys;
    if (!canvas.hasAttribute('tabindex')) canvas.tabIndex = 0;

    const { signal } = this.#listening;
    const onPointer = (type: keyof HTMLElementEventMap, state: Partial<Pointer>, from: EventTarget = canvas) => {
      const listener = (event: PointerEvent) => {
        if (!event.isPrimary) return; // a second finger
        if (from === canvas) screen.toWorld(event.offsetX, event.offsetY, pointer);
        Object.assign(pointer, state);
      };
      from.addEventListener(type, listener as EventListener, { signal });
    };
    onPointer('pointerenter', { isOver: true });
    onPointer('pointermove', { isOver: true });
    onPointer('pointerdown', { isOver: true, isDown: true });
    onPointer('pointerleave', { isOver: false });
    // The button may be released anywhere on the page.
    onPointer('pointerup', { isDown: false }, canvas.ownerDocument);
    onPointer('pointercancel', { isDown: false, isOver: false }, canvas.ownerDocument);

    canvas.addEventListener('keydown', (event) => keys.add(event.code), { signal });
    canvas.addEventListener('keyup', (event) => keys.delete(event.code), { signal });
    // The release of a key elsewhere is not reported.
    canvas.addEventListener('blur', () => keys.clear(), { signal });
  }

  /**
   * Whether a key is held, by its `KeyboardEvent.code`.
   *
   * @example
   * const world = new World(null, {
   *   update() {
   *     if (this.input?.isDown('ArrowLeft')) this.entities[0].accel.x = -0.001;
   *   },
   * });
   * world.step(); // → undefined
   */
  isDown(code: string): boolean {
    return this.keys.has(code);
  }

  /**
   * Stops listening.
   *
   * @example
   * new World(null).input?.dispose(); // → undefined
   */
  dispose(): void {
    this.#listening.abort();
  }
}

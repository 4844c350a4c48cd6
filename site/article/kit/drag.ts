// Lets a point in a view be dragged: by mouse, pen or finger, and by the arrow keys.
import type { Fit } from './drawing.ts';
import type { View } from './view.ts';

type Box = readonly [left: number, top: number, width: number, height: number];

export interface DragOptions {
  /** What is dragged, for the screen reader. */
  label: string;
  /** Where the world is in the view now. */
  fit(): Fit;
  /** Whether a drag may start at a place in the world. */
  holds(x: number, y: number): boolean;
  /** Moves it by this many world units. */
  moved(dx: number, dy: number): void;
  /** Moves it by this many keyboard steps: -1, 0 or 1 on each axis, ten times that with Shift. */
  stepped(x: number, y: number): void;
}

const arrows: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Puts a place that left a box back to the box's edge. */
export function confine(at: { x: number; y: number }, [left, top, width, height]: Box): void {
  at.x = Math.min(Math.max(at.x, left), left + width);
  at.y = Math.min(Math.max(at.y, top), top + height);
}

/** Whether a place is in a box or on its edge. */
export const contains = ([left, top, width, height]: Box, x: number, y: number): boolean =>
  x >= left && y >= top && x <= left + width && y <= top + height;

export function makeDraggable({ canvas }: View, options: DragOptions): void {
  const { label, fit, moved, stepped } = options;
  const holds = (x: number, y: number) => {
    const at = fit();
    return options.holds((x - at.x) / at.scale, (y - at.y) / at.scale);
  };
  canvas.tabIndex = 0;
  canvas.setAttribute('aria-roledescription', label);
  let last: { x: number; y: number } | undefined;

  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !holds(event.offsetX, event.offsetY)) return;
    last = { x: event.offsetX, y: event.offsetY };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    const { offsetX: x, offsetY: y } = event;
    canvas.style.cursor = last ? 'grabbing' : holds(x, y) ? 'grab' : '';
    if (!last) return;
    const { scale } = fit();
    moved((x - last.x) / scale, (y - last.y) / scale);
    last = { x, y };
  });
  const release = () => {
    last = undefined;
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  // A finger on something draggable drags it; anywhere else it scrolls the page.
  canvas.addEventListener(
    'touchstart',
    (event) => {
      const { left, top } = canvas.getBoundingClientRect();
      const { clientX, clientY } = event.touches[0];
      if (holds(clientX - left, clientY - top)) event.preventDefault();
    },
    { passive: false },
  );
  canvas.addEventListener('keydown', (event) => {
    const arrow = arrows[event.key];
    if (!arrow || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    stepped(arrow[0] * far, arrow[1] * far);
  });
}

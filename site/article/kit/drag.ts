// Lets a point in a view be dragged: by mouse, pen or finger, and by the arrow keys.
import type { View } from './view.ts';

export interface DragOptions {
  /** What is dragged, for the screen reader. */
  label: string;
  /** Whether a drag may start at a place in the view, in CSS pixels; by default anywhere. */
  holds?(x: number, y: number): boolean;
  /** Moves it by this many CSS pixels. */
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

export function makeDraggable({ canvas }: View, { label, holds = () => true, moved, stepped }: DragOptions): void {
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
    moved(x - last.x, y - last.y);
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

// Navigation in a view: wheel and drag, one and two fingers, arrows, + and -, and 0 for the whole world.
// The page still scrolls by a wheel over a view that was not clicked, and by a finger on one that shows the whole
// world.
import type { Camera } from './camera.ts';

const wheelSpeed = 0.0016;
const lineHeight = 16;
const keyStep = 80;
const keyZoom = 1.25;

/** Whether the page scrolls by this event, since the view was not clicked. */
export const scrollsPage = (event: WheelEvent, view: HTMLElement): boolean =>
  document.documentElement.scrollHeight > innerHeight && !event.ctrlKey && document.activeElement !== view;

/** A client position over a view in the camera's pixels. */
export function locate(view: HTMLElement, camera: Camera, clientX: number, clientY: number): { x: number; y: number } {
  const frame = view.getBoundingClientRect();
  const density = camera.width / frame.width;
  return { x: (clientX - frame.left) * density, y: (frame.bottom - clientY) * density };
}

export function panZoom(view: HTMLElement, camera: Camera, changed: () => void): void {
  // Told by the camera, since buttons and new scenes move it too.
  const letFingersScroll = () => {
    view.style.touchAction = camera.fitted ? 'pan-y' : 'none';
  };
  camera.fittedChanged = letFingersScroll;
  letFingersScroll();
  takeWheel(view, camera, changed);
  takeFingers(view, camera, changed);
  takeKeys(view, camera, changed);
  view.tabIndex = 0;
}

function takeWheel(view: HTMLElement, camera: Camera, changed: () => void): void {
  view.addEventListener(
    'wheel',
    (event) => {
      if (scrollsPage(event, view)) return;
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? lineHeight : 1;
      const at = locate(view, camera, event.clientX, event.clientY);
      // A pinch on a touchpad arrives as small deltas with the control key.
      camera.zoom(Math.exp(-event.deltaY * lines * wheelSpeed * (event.ctrlKey ? 6 : 1)), at.x, at.y);
      changed();
    },
    { passive: false },
  );
}

/** The mouse counts as one. */
function takeFingers(view: HTMLElement, camera: Camera, changed: () => void): void {
  const fingers = new Map<number, { x: number; y: number }>();
  view.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || (event.target as Element).closest('button')) return;
    fingers.set(event.pointerId, locate(view, camera, event.clientX, event.clientY));
    view.setPointerCapture(event.pointerId);
  });
  view.addEventListener('pointermove', (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = locate(view, camera, event.clientX, event.clientY);
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const spread = Math.hypot(now.x - other.x, now.y - other.y) / Math.hypot(before.x - other.x, before.y - other.y);
      if (Number.isFinite(spread) && spread > 0) camera.zoom(spread, (now.x + other.x) / 2, (now.y + other.y) / 2);
      camera.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
    } else if (event.pointerType === 'mouse' || !camera.fitted) {
      camera.pan(now.x - before.x, now.y - before.y);
    }
    fingers.set(event.pointerId, now);
    changed();
  });
  const lift = (event: PointerEvent) => fingers.delete(event.pointerId);
  view.addEventListener('pointerup', lift);
  view.addEventListener('pointercancel', lift);
  // Two fingers move the view even if one finger scrolls the page.
  view.addEventListener('touchstart', (event) => event.touches.length > 1 && event.preventDefault(), {
    passive: false,
  });
}

function takeKeys(view: HTMLElement, camera: Camera, changed: () => void): void {
  view.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== view) return;
    if (event.key === 'ArrowLeft') camera.pan(keyStep, 0);
    else if (event.key === 'ArrowRight') camera.pan(-keyStep, 0);
    else if (event.key === 'ArrowUp') camera.pan(0, -keyStep);
    else if (event.key === 'ArrowDown') camera.pan(0, keyStep);
    else if (event.key === '+' || event.key === '=') camera.zoom(keyZoom);
    else if (event.key === '-') camera.zoom(1 / keyZoom);
    else if (event.key === '0') camera.fit();
    else return;
    event.preventDefault();
    changed();
  });
}

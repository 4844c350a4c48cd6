// Moves a view by mouse, wheel, one or two fingers, the arrow keys, plus and minus.

const keyStep = 60;
const arrows = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** view has pan(dx, dy) in pixels; zoom(factor, x, y) around a pixel; point(x, y), the place of the pointer. */
export function moveView(element, view) {
  const fingers = new Map();
  const at = ({ clientX, clientY }) => {
    const { left, top } = element.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    view.point(...at(event));
  });
  element.addEventListener('pointermove', (event) => {
    const [x, y] = at(event);
    const before = fingers.get(event.pointerId);
    if (!before) return view.point(x, y);
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const distance = ([fromX, fromY]) => Math.hypot(fromX - other[0], fromY - other[1]);
      view.zoom(distance([x, y]) / Math.max(1, distance(before)), (x + other[0]) / 2, (y + other[1]) / 2);
    }
    const share = 1 / fingers.size;
    view.pan(share * (x - before[0]), share * (y - before[1]));
    fingers.set(event.pointerId, [x, y]);
  });
  for (const end of ['pointerup', 'pointercancel']) {
    element.addEventListener(end, ({ pointerId }) => fingers.delete(pointerId));
  }
  element.addEventListener(
    'wheel',
    (event) => {
      const pageScrolls = document.documentElement.scrollHeight > innerHeight;
      if (pageScrolls && !event.ctrlKey && document.activeElement !== element) return;
      event.preventDefault();
      view.zoom(Math.exp(-0.0015 * event.deltaY), ...at(event));
    },
    { passive: false },
  );
  element.addEventListener('keydown', (event) => {
    const { key } = event;
    if (key in arrows) event.preventDefault(); // so that the page does not scroll
    const middle = [element.clientWidth / 2, element.clientHeight / 2];
    if (arrows[key]) view.pan(keyStep * arrows[key][0], keyStep * arrows[key][1]);
    else if (key === '+' || key === '=') view.zoom(1.25, ...middle);
    else if (key === '-') view.zoom(0.8, ...middle);
    else if (key === 'Enter') view.point(...middle);
  });
}

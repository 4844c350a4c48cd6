// A selection of boxes, for React: by a rubber band drawn with mouse, pen or finger, and by keys as in a list. A
// queryBox finds the boxes that the band touches; a sweep finds where an arrow key leads.
import { useReducer, useRef } from 'react';
import { useBroadPhase } from './use-broad-phase.mjs';

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
/** Wider than any board. */
const far = 1e5;

const bandOf = ([fromX, fromY], [toX, toY]) => [
  Math.min(fromX, toX),
  Math.min(fromY, toY),
  Math.max(fromX, toX),
  Math.max(fromY, toY),
];

const unionOf = (a, b) => [
  ...a.slice(0, 2).map((n, k) => Math.min(n, b[k])),
  ...a.slice(2).map((n, k) => Math.max(n, b[k + 2])),
];

/** Ids in either of two sets. */
const both = (a, b) => new Set([...a, ...b]);

const nothing = { selected: new Set(), before: new Set(), band: undefined, active: 0, anchor: 0, took: undefined };

/**
 * boxes: [minX, minY, maxX, maxY] of each id, in pixels of the board; the same array while they do not move.
 * Returns the selected ids, the band to draw, the id that keys act on, and the handlers of the board.
 */
export function useSelection(boxes) {
  const [state, put] = useReducer((old, change) => ({ ...old, ...change }), nothing);
  const { space } = useBroadPhase(boxes);
  const start = useRef(undefined);
  /** What was selected before the band, if the page takes the finger to scroll. */
  const undo = useRef(undefined);

  const within = (box) => {
    const started = performance.now();
    const ids = space().queryBox(...box);
    return { ids, took: performance.now() - started };
  };
  const at = ({ clientX, clientY, currentTarget }) => {
    const { left, top } = currentTarget.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };

  const handlers = {
    onPointerDown(event) {
      if (event.button !== 0 || !event.isPrimary) return; // a second finger does nothing
      event.currentTarget.setPointerCapture(event.pointerId);
      start.current = at(event);
      undo.current = { selected: state.selected, active: state.active, anchor: state.anchor };
      const more = event.shiftKey || event.ctrlKey || event.metaKey;
      const { ids, took } = within(bandOf(start.current, start.current));
      const before = more ? state.selected : new Set();
      const active = ids[0] ?? state.active;
      put({ before, selected: both(before, ids), active, anchor: active, took });
    },
    onPointerMove(event) {
      if (!start.current || !event.isPrimary) return;
      const band = bandOf(start.current, at(event));
      const { ids, took } = within(band);
      put({ band, selected: both(state.before, ids), took });
    },
    onPointerUp: ({ isPrimary }) => isPrimary && end(),
    onPointerCancel: ({ isPrimary }) => isPrimary && end(undo.current),
    onKeyDown(event) {
      const { key, shiftKey } = event;
      if (arrows[key]) move(arrows[key], shiftKey);
      else if (key === ' ') toggle(state.active);
      else if (key === 'a' && (event.ctrlKey || event.metaKey)) put({ selected: new Set(boxes.keys()) });
      else if (key === 'Escape') put({ selected: new Set() });
      else return;
      event.preventDefault();
    },
  };

  function end(change) {
    start.current = undefined;
    put({ ...change, band: undefined });
  }

  /** Makes the next box in a direction the active one; with Shift, selects all between there and the anchor. */
  function move([dx, dy], extend) {
    const box = boxes[state.active];
    const hit = space().sweep(...box, dx * far, dy * far, { ignore: state.active });
    if (!hit) return;
    if (!extend) return put({ active: hit.id, anchor: hit.id, before: state.selected });
    const { ids, took } = within(unionOf(boxes[state.anchor], boxes[hit.id]));
    put({ active: hit.id, selected: both(state.before, ids), took });
  }

  function toggle(id) {
    const selected = new Set(state.selected);
    if (!selected.delete(id)) selected.add(id);
    put({ selected, before: selected, anchor: id });
  }

  return { ...state, handlers };
}

// Notes to drag around, or to move with the arrow keys. useBroadPhase finds which overlap, as they are drawn. A new
// note finds a free place by a query to the space.
import { useRef, useState } from 'react';
import { useBroadPhase } from './use-broad-phase.mjs';

const [width, height] = [96, 64];
const margin = 12;
const keyStep = 8;
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

const noteAt = (x, y) => [x, y, x + width, y + height];
const first = [noteAt(20, 20), noteAt(80, 60), noteAt(200, 30), noteAt(40, 180), noteAt(210, 220)];

export function Notes() {
  const desk = useRef(null);
  /** Where each pointer that holds a note was last: several fingers may. */
  const held = useRef(new Map());
  const [boxes, put] = useState(first);
  const { pairs, space } = useBroadPhase(boxes);
  const touching = new Set(pairs);

  const move = (id, dx, dy) => put((all) => all.map((box, k) => (k === id ? noteAt(box[0] + dx, box[1] + dy) : box)));

  /** Adds a note in the first free place, row by row, or below all others if the desk is full. */
  function add() {
    const { clientWidth, clientHeight } = desk.current;
    const free = (x, y) =>
      space().queryBox(x - margin, y - margin, x + width + margin, y + height + margin).length === 0;
    for (let y = margin; y + height < clientHeight; y += margin) {
      for (let x = margin; x + width < clientWidth; x += margin) {
        if (free(x, y)) return put([...boxes, noteAt(x, y)]);
      }
    }
    put([...boxes, noteAt(margin, Math.max(...boxes.map((box) => box[3])) + margin)]);
  }

  const handlersOf = (id) => ({
    onPointerDown({ currentTarget, pointerId, clientX, clientY }) {
      currentTarget.setPointerCapture(pointerId);
      held.current.set(pointerId, [clientX, clientY]);
    },
    onPointerMove({ pointerId, clientX, clientY }) {
      const last = held.current.get(pointerId);
      if (!last) return;
      move(id, clientX - last[0], clientY - last[1]);
      held.current.set(pointerId, [clientX, clientY]);
    },
    onPointerUp: release,
    onPointerCancel: release,
    onKeyDown(event) {
      const way = arrows[event.key];
      if (!way) return;
      event.preventDefault();
      move(id, keyStep * way[0], keyStep * way[1]);
    },
  });

  function release({ pointerId }) {
    held.current.delete(pointerId);
  }

  return (
    <>
      <div ref={desk} className="stage">
        {boxes.map(([x, y], id) => (
          <button
            // biome-ignore lint/suspicious/noArrayIndexKey: the place of a note is its id
            key={id}
            type="button"
            className={touching.has(id) ? 'note touching' : 'note'}
            style={{ left: x, top: y, width, height }}
            {...handlersOf(id)}
          >
            Note {id + 1}
          </button>
        ))}
      </div>
      <footer className="bar">
        <p role="status">
          <b>{pairs.length / 2}</b> {pairs.length === 2 ? 'pair overlaps' : 'pairs overlap'}
        </p>
        <button type="button" onClick={add}>
          Add a note
        </button>
        <a href="?">Tiles to select</a>
      </footer>
    </>
  );
}

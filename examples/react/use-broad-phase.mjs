// Which boxes overlap, for React. Rendering has to be pure, and a space is not: so pairs are a copy, and whoever asks the
// space first has it brought to the boxes that are on screen. That costs nothing where it has them already.
import { BroadPhase } from 'broadphase';
import { useCallback, useLayoutEffect, useMemo, useRef, useState } from 'react';

/** A space that is brought to one array of boxes or another. */
class Following {
  #boxes;

  constructor(options) {
    this.space = new BroadPhase(options);
  }

  /** Gives the space, updated, with exactly these boxes; the same array has the same boxes. */
  to(boxes) {
    const { space } = this;
    if (boxes === this.#boxes) return space;
    this.#boxes = undefined; // until all are in: a bad one throws
    boxes.forEach((box, id) => {
      if (box) space.set(id, ...box);
    });
    for (const id of [...space.keys()]) if (!boxes[id]) space.delete(id);
    space.update();
    this.#boxes = boxes;
    return space;
  }
}

/**
 * boxes: [minX, minY, maxX, maxY] of each id, undefined where there is none; a new array when one has moved.
 * options: those of a space, read once.
 * Gives pairs, [a, b, a, b, …], and space(), for queries in handlers and effects: it has the boxes on screen.
 */
export function useBroadPhase(boxes, options) {
  // Nothing is disposed of: strict mode takes a component away and back with what it holds. What nobody holds any more
  // is freed with it.
  const [following] = useState(() => new Following(options));
  const pairs = useMemo(() => following.to(boxes).pairs.slice(), [following, boxes]);
  const onScreen = useRef(boxes);
  useLayoutEffect(() => {
    onScreen.current = boxes;
  }, [boxes]);
  const space = useCallback(() => following.to(onScreen.current), [following]);
  return { pairs, space };
}

// Which boxes overlap, for React. Rendering has to be pure, and a space is not. So the pairs are a copy, and the first
// query updates the space to the boxes on screen. That costs nothing if it has them already.
import { BroadPhase } from 'broadphase';
import { useCallback, useLayoutEffect, useMemo, useRef, useState } from 'react';

/** A space that follows an array of boxes. */
class Following {
  #boxes;

  constructor(options) {
    this.space = new BroadPhase(options);
  }

  /** Returns the space, updated to exactly these boxes. The same array must have the same boxes. */
  to(boxes) {
    const { space } = this;
    if (boxes === this.#boxes) return space;
    this.#boxes = undefined; // until all are set: a bad one throws
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
 * boxes: [minX, minY, maxX, maxY] for each id, or undefined if it has no box; a new array when one has moved.
 * options: those of a space, read once.
 * Returns pairs, [a, b, a, b, …], and space(), for queries in handlers and effects: it has the boxes on screen.
 */
export function useBroadPhase(boxes, options) {
  // Nothing is disposed of: strict mode unmounts a component and mounts it again with the same state. The space is
  // garbage-collected with the component.
  const [following] = useState(() => new Following(options));
  const pairs = useMemo(() => following.to(boxes).pairs.slice(), [following, boxes]);
  const onScreen = useRef(boxes);
  useLayoutEffect(() => {
    onScreen.current = boxes;
  }, [boxes]);
  const space = useCallback(() => following.to(onScreen.current), [following]);
  return { pairs, space };
}

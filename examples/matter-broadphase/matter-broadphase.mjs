// A drop-in broad phase for Matter.js. Matter's detector sorts all bodies along one axis in every step, by insertion,
// and tests all that share a column. Here broadphase finds the pairs instead. Matter still decides which of them
// touch, and how.
//   const undo = useBroadPhase(Matter);
import { BroadPhase } from 'broadphase';

/** From now on every engine of this Matter finds its pairs here. Returns a function that undoes this. */
export function useBroadPhase({ Detector, Collision }) {
  const original = Detector.collisions;
  /** Per detector: its space, and the numbers of its bodies' boxes. */
  const spaces = new WeakMap();

  Detector.collisions = (detector) => {
    const { bodies, pairs: known, collisions } = detector;
    let kept = spaces.get(detector);
    if (!kept) {
      kept = { space: new BroadPhase(), boxes: new Float64Array() };
      spaces.set(detector, kept);
    }
    const { space } = kept;
    if (kept.boxes.length < 4 * bodies.length) kept.boxes = new Float64Array(8 * bodies.length);
    const { boxes } = kept;
    for (let k = 0, at = 0; k < bodies.length; k++) {
      const { min, max } = bodies[k].bounds;
      boxes[at++] = min.x;
      boxes[at++] = min.y;
      boxes[at++] = max.x;
      boxes[at++] = max.y;
    }
    const { pairs } = space.setAll(boxes, bodies.length).update();
    let count = 0;
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [bodies[pairs[k]], bodies[pairs[k + 1]]];
      if ((a.isStatic || a.isSleeping) && (b.isStatic || b.isSleeping)) continue;
      if (!Detector.canCollide(a.collisionFilter, b.collisionFilter)) continue;
      // A body of several parts is its own first part.
      for (let m = a.parts.length > 1 ? 1 : 0; m < a.parts.length; m++) {
        for (let n = b.parts.length > 1 ? 1 : 0; n < b.parts.length; n++) {
          const [partA, partB] = [a.parts[m], b.parts[n]];
          const collision = overlap(partA.bounds, partB.bounds) && Collision.collides(partA, partB, known);
          if (collision) collisions[count++] = collision;
        }
      }
    }
    collisions.length = count;
    return collisions;
  };
  return () => {
    Detector.collisions = original;
  };
}

const overlap = (a, b) => a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y;

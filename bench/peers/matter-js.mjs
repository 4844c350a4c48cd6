// matter-js: its Detector sorts bodies by their bounds, sweeps, and tests the polygons of each pair. Bodies are
// rectangles whose corners and bounds are written in place: part of what Body.setPosition does.
import Matter from 'matter-js';
import { PairList } from './kit/pair-list.mjs';

export const dimensions = [2];

export function create({ count, boxes }) {
  const bodies = Array.from({ length: count }, (_, k) => {
    const [minX, minY, maxX, maxY] = boxes.subarray(4 * k, 4 * k + 4);
    return Matter.Bodies.rectangle((minX + maxX) / 2, (minY + maxY) / 2, maxX - minX, maxY - minY, {
      plugin: { id: k },
    });
  });
  const detector = Matter.Detector.create({ bodies: bodies.slice() });
  const list = new PairList();
  return {
    update(frame) {
      for (let id = 0, k = 0; id < count; id++, k += 4) {
        const { bounds, vertices, position } = bodies[id];
        const minX = frame[k];
        const minY = frame[k + 1];
        const maxX = frame[k + 2];
        const maxY = frame[k + 3];
        bounds.min.x = vertices[0].x = vertices[3].x = minX;
        bounds.min.y = vertices[0].y = vertices[1].y = minY;
        bounds.max.x = vertices[1].x = vertices[2].x = maxX;
        bounds.max.y = vertices[2].y = vertices[3].y = maxY;
        position.x = (minX + maxX) / 2;
        position.y = (minY + maxY) / 2;
      }
      list.clear();
      for (const { bodyA, bodyB } of Matter.Detector.collisions(detector)) list.add(bodyA.plugin.id, bodyB.plugin.id);
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}

// A package in a frame of objects: its boxes are written from them, it finds the pairs, and they are walked over.
import { lookAt } from './objects.mjs';

export async function create({ things, variant: { peer, variant }, ...scene }) {
  const { create: createPeer } = await import(`../peers/${peer}.mjs`);
  const boxes = new Float64Array(4 * things.length);
  const give = () => {
    for (let i = 0, k = 0; i < things.length; i++) {
      const { x, y, width, height } = things[i];
      boxes[k++] = x;
      boxes[k++] = y;
      boxes[k++] = x + width;
      boxes[k++] = y + height;
    }
  };
  give();
  const found = await createPeer({ ...scene, boxes, variant });
  return {
    give,
    update: () => found.update(boxes),
    walk: () => lookAt(things, found.pairs()),
    pairs: () => found.pairs(),
  };
}

// Which boxes overlap, for Vue. Pairs are a computed value, so they are found again only when a box has moved. They
// are a copy, which does not change later.
import { BroadPhase } from 'broadphase';
import { computed, onScopeDispose, toValue } from 'vue';

/**
 * boxes: an array, or a ref or getter of one: [minX, minY, maxX, maxY] for each id, or undefined if it has no box.
 * options: those of a space.
 * Returns pairs, [a, b, a, b, …], and space(), for queries: it has the boxes as they are now.
 */
export function useBroadPhase(boxes, options) {
  const held = new BroadPhase(options);
  onScopeDispose(() => held.dispose());

  const pairs = computed(() => {
    const now = toValue(boxes);
    now.forEach((box, id) => {
      if (box) held.set(id, ...box);
    });
    for (const id of [...held.keys()]) if (!now[id]) held.delete(id);
    return held.update().pairs.slice();
  });
  const space = () => {
    void pairs.value; // updates it, if a box has changed
    return held;
  };
  return { pairs, space };
}

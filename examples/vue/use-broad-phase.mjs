// Which boxes overlap, for Vue. Pairs are computed, so they are found anew where a box has moved, and only then; they are
// a copy, which nothing changes later.
import { BroadPhase } from 'broadphase';
import { computed, onScopeDispose, toValue } from 'vue';

/**
 * boxes: an array, or a ref or getter of one: [minX, minY, maxX, maxY] of each id, undefined where there is none.
 * options: those of a space.
 * Gives pairs, [a, b, a, b, …], and space(), for queries: it has the boxes as they are now.
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
    void pairs.value; // brings it to the boxes, where one has changed
    return held;
  };
  return { pairs, space };
}

// `dispose` promises to let go of the memory. Views of the ids and of the counters kept it, as long as somebody held the
// space itself.
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

setFlagsFromString('--expose-gc');
const collect = runInNewContext('gc') as () => void;
const later = () => new Promise((resolve) => setTimeout(resolve, 10));

/** The memory of a space that has made every view there is. */
function used(space: BroadPhase): WeakRef<object> {
  for (const id of [5, 99, 4000, 5]) space.set(id, 0, 0, 1, 1);
  space.setAll([0, 0, 1, 1]).set(99, 0, 0, 2, 2).update().set(99, 0, 0, 1, 1);
  expect(space.has(99) && space.pairs.length > 0 && space.began.length > 0).toBe(true);
  expect(space.queryBox(0, 0, 1, 1).length).toBe(2);
  return new WeakRef(space.structure().buffer);
}

test('a disposed space releases its memory, although it is still referenced', async () => {
  const space = new BroadPhase({ events: true });
  const memory = used(space);
  space.dispose();
  for (let k = 0; k < 10 && memory.deref(); k++) {
    await later();
    collect();
  }
  expect(memory.deref()).toBe(undefined);
  expect(JSON.stringify(space)).toBe('{"disposed":true}');
});

// The order of pairs in a replay. With `auto` it depends on how boxes were given, which a recording does not tell. After
// a snapshot of each space, before its first update, it depends on the boxes alone.
import { BroadPhase } from 'broadphase';
import { applyFrame, openTrace, record } from 'broadphase/trace';
import { expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

test.each([1, 2, 3, 4])('after a snapshot, a replay has the order of the game, seed %i', (seed) => {
  const random = createRandom(seed);
  const any = (below: number) => Math.floor(random() * below);
  const space = new BroadPhase();
  space.snapshot();
  const recording = record(space);
  const count = 60 + any(400);
  const world = 10 * Math.sqrt(count);
  const put = (id: number) => {
    const [x, y] = [random() * world, random() * world];
    space.set(id, x, y, x + 12, y + 12);
  };
  for (let k = 0; k < count; k++) put(2 * k);
  const seen: number[][] = [];
  for (let frame = 0; frame < 40; frame++) {
    const isCalm = frame % 20 > 5;
    for (let k = 0; k < 9 && !isCalm; k++) if (!space.delete(any(2 * count))) put(any(2 * count));
    for (const [id, [a, b, c, d]] of space) if (random() < (isCalm ? 0.1 : 0.8)) space.set(id, a + 0.1, b, c + 0.1, d);
    if (random() < 0.1) space.setAll([...space].flatMap(([, box]) => [...box]));
    if (random() < 0.1) space.boxes(space.size)[0]! -= 0.5;
    if (random() < 0.2) space.setFilter([...space.keys()][3]!, 1, 2);
    seen.push([...space.update().pairs]);
  }
  const copy = new BroadPhase();
  copy.snapshot();
  let frame = 0;
  for (const each of openTrace(recording.bytes())) {
    applyFrame(copy, each);
    expect([...copy.update().pairs], `frame ${frame}`).toEqual(seen[frame++]);
  }
  expect(frame).toBe(40);
});

// Both ECS, through spawning, moving and despawning, against a loop over all pairs of entities.
import { describe, expect, test } from 'vitest';
import { installed, pairName } from './check.mjs';

const each = { bitecs: () => import('../ecs/bitecs.mjs'), koota: () => import('../ecs/koota.mjs') };

describe.skipIf(!installed).each(['bitecs', 'koota'])('%s', (name) => {
  test('finds the pairs of the entities there are', async () => {
    const ecs = await each[name]();
    const game = ecs.createGame();
    const boxes = new Map();
    const numberOf = (entity) => (typeof entity === 'number' && name === 'bitecs' ? entity : entity.id());
    let found = 0;
    for (let frame = 0; frame < 60; frame++) {
      for (let k = 0; k < 5; k++) {
        const [x, y, w, h] = [(frame * 31 + k * 17) % 100, (frame * 13 + k * 41) % 100, 2 + (k % 3), 2 + (frame % 4)];
        boxes.set(ecs.spawn(game, x, y, w, h, k, -k), [x, y, w, h, k, -k]);
      }
      if (frame % 2) {
        const [entity] = boxes.keys();
        ecs.despawn(game, entity);
        boxes.delete(entity);
      }
      ecs.moveSystem(game, 1);
      for (const box of boxes.values()) {
        box[0] += box[4];
        box[1] += box[5];
      }
      const exact = new Set();
      const all = [...boxes];
      for (const [k, [a, [ax, ay, aw, ah]]] of all.entries()) {
        for (const [b, [bx, by, bw, bh]] of all.slice(k + 1)) {
          if (Math.abs(ax - bx) <= aw + bw && Math.abs(ay - by) <= ah + bh)
            exact.add(pairName(numberOf(a), numberOf(b)));
        }
      }
      const pairs = ecs.collisionSystem(game);
      const names = Array.from({ length: pairs.length / 2 }, (_, k) => pairName(pairs[2 * k], pairs[2 * k + 1]));
      expect(names.sort()).toEqual([...exact].sort());
      found += exact.size;
    }
    expect(found).toBeGreaterThan(1000);
  });
});

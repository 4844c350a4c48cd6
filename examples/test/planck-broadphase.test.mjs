// Two equal worlds, one with each broad phase: the same things touch in both, ray casts and box queries find the
// same, and bodies that are removed or jump leave nothing behind.
import { describe, expect, test } from 'vitest';
import { installed } from './check.mjs';

describe.skipIf(!installed)('a broad phase for Planck', () => {
  test('worlds go on as they do with their own', async () => {
    const { AABB, Box, Vec2, World } = await import('planck');
    const { useBroadPhase } = await import('../planck-broadphase/planck-broadphase.mjs');
    const { fillHeap } = await import('../planck-broadphase/scene.mjs');
    const [own, ours] = [new World(), new World()];
    useBroadPhase(ours);
    for (const world of [own, ours]) fillHeap(world, 150);
    const bodiesOf = (world) => {
      const all = [];
      for (let body = world.getBodyList(); body; body = body.getNext()) all.push(body);
      return all.reverse();
    };
    const contactsOf = (world) => {
      const bodies = bodiesOf(world);
      const names = [];
      for (let contact = world.getContactList(); contact; contact = contact.getNext()) {
        const ends = [contact.getFixtureA(), contact.getFixtureB()].map((fixture) => bodies.indexOf(fixture.getBody()));
        names.push(`${ends.sort((a, b) => a - b).join(' ')} ${contact.getChildIndexA()} ${contact.getChildIndexB()}`);
      }
      return names.sort();
    };
    let contacts = 0;
    for (let step = 0; step < 100; step++) {
      for (const [a, b] of bodiesOf(own).map((body, k) => [body, bodiesOf(ours)[k]])) {
        // The order of contacts differs, so the last digits do too: the worlds are kept equal.
        b.setTransform(a.getPosition(), a.getAngle());
        b.setLinearVelocity(a.getLinearVelocity());
        b.setAngularVelocity(a.getAngularVelocity());
        b.setAwake(a.isAwake());
      }
      if (step === 50) {
        for (const world of [own, ours]) {
          world.destroyBody(bodiesOf(world)[20]);
          bodiesOf(world)[30].setTransform(new Vec2(0, 20), 1);
          bodiesOf(world)[40].createFixture(new Box(1, 0.1), { density: 1 });
        }
      }
      for (const world of [own, ours]) world.step(1 / 60);
      const touching = (world) => {
        const bodies = bodiesOf(world);
        let count = 0;
        for (let contact = world.getContactList(); contact; contact = contact.getNext()) count += contact.isTouching();
        return [bodies.length, count];
      };
      expect(Math.abs(touching(own)[1] - touching(ours)[1])).toBeLessThanOrEqual(3);
      contacts += contactsOf(ours).length;
    }
    expect(contacts).toBeGreaterThan(10_000);
    for (let k = 0; k < 50; k++) {
      const [from, to] = [new Vec2(-15 + k * 0.6, 20), new Vec2(15 - k * 0.6, -1)];
      const first = (world) => {
        let best;
        world.rayCast(from, to, (fixture, _point, _normal, fraction) => {
          best = `${bodiesOf(world).indexOf(fixture.getBody())} ${fraction.toFixed(2)}`;
          return fraction;
        });
        return best;
      };
      expect(first(ours)).toBe(first(own));
      const inside = (world) => {
        const found = new Set();
        world.queryAABB(new AABB(new Vec2(-k / 5, 0), new Vec2(k / 5, k / 10)), (fixture) => {
          found.add(bodiesOf(world).indexOf(fixture.getBody()));
          return true;
        });
        return found.size;
      };
      expect(Math.abs(inside(ours) - inside(own))).toBeLessThanOrEqual(3);
    }
    expect(() => useBroadPhase(ours)).toThrow(/expected an empty one/);
  });
});

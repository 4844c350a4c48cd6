// Every contact that touches in Planck is among the pairs of the recording, and the recording replays exactly.
import { describe, expect, test } from 'vitest';
import { bits, checkGroups, checkRecording, groupsInTime, installed, pairName, pairsOf } from './check.mjs';

describe.skipIf(!installed)('recording Planck', () => {
  test('has the boxes of all fixtures, and every contact among its pairs', async () => {
    const { recordPlanck } = await import('../record-planck/record-planck.mjs');
    const { createScene } = await import('../record-planck/scene.mjs');
    const world = createScene(100);
    world.setContinuousPhysics(false); // otherwise contacts begin within a step, at places that are never recorded
    const recorded = recordPlanck(world);
    let contacts = 0;
    for (let step = 0; step < 150; step++) {
      if (step === 100) world.destroyBody(world.getBodyList());
      recorded.frame();
      world.step(1 / 60);
      // Contacts are found where the bodies were when the step began.
      const pairs = pairsOf(recorded.space);
      for (let contact = world.getContactList(); contact; contact = contact.getNext()) {
        if (!contact.isTouching()) continue;
        // A body that touches the skin of a chain may be outside its box, which Planck makes without the skin.
        if (contact.getFixtureA().getType() === 'chain' || contact.getFixtureB().getType() === 'chain') continue;
        contacts++;
        const a = recorded.idOf(contact.getFixtureA()) + contact.getChildIndexA();
        const b = recorded.idOf(contact.getFixtureB()) + contact.getChildIndexB();
        expect(pairs).toContain(pairName(a, b));
      }
    }
    await recorded.stop();
    expect(contacts).toBeGreaterThan(1000);
    const frames = checkRecording(recorded.recording.bytes());
    expect(frames.map(({ count }) => count)).toEqual([...Array(100).fill(141), ...Array(50).fill(140)]);
    expect(frames[50].rules.filter((number, k) => k % 3 === 2 && number === 1)).toHaveLength(40);
  });

  test('has the pairs that may collide, by bits and by groups, which change', async () => {
    const { Box, World } = await import('planck');
    const { recordPlanck } = await import('../record-planck/record-planck.mjs');
    const world = new World();
    const fixtures = bits.map(() => world.createDynamicBody().createFixture(new Box(1, 1), { density: 1 }));
    const recorded = recordPlanck(world);
    for (const groups of groupsInTime) {
      for (const [k, fixture] of fixtures.entries()) {
        const [categoryBits, maskBits] = bits[k];
        fixture.setFilterData({ groupIndex: groups[k], categoryBits, maskBits });
      }
      recorded.frame();
      const mayMeet = (a, b) => fixtures[a].shouldCollide(fixtures[b]);
      checkGroups(recorded.space, groups, (k) => recorded.idOf(fixtures[k]), mayMeet);
    }
    await recorded.stop();
    checkRecording(recorded.recording.bytes());
  });
});

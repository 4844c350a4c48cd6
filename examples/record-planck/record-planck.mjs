// Records a Planck (Box2D) world: the boxes of its fixtures, as in its own broad phase but without the margin.
// In your game: `const recorded = recordPlanck(world)`, then `recorded.frame()` after each `world.step()`.
import { BroadPhase } from 'broadphase';
import { record } from 'broadphase/trace';

/** @param {import('planck').World} world */
export function recordPlanck(world) {
  const space = new BroadPhase();
  const recording = record(space);
  /** The id of the first child of each fixture. @type {Map<import('planck').Fixture, number>} */
  let known = new Map();
  let next = 0;
  return {
    space,
    recording,
    /** The id of a fixture in the recording. */
    idOf: (fixture) => known.get(fixture),
    frame() {
      const now = new Map();
      for (let body = world.getBodyList(); body; body = body.getNext()) {
        if (!body.isActive()) continue;
        for (let fixture = body.getFixtureList(); fixture; fixture = fixture.getNext()) {
          const children = fixture.getShape().getChildCount();
          const id = known.get(fixture) ?? next;
          if (id === next) next += children;
          now.set(fixture, id);
          for (let child = 0; child < children; child++) {
            const { lowerBound, upperBound } = fixture.getAABB(child);
            space.set(id + child, lowerBound.x, lowerBound.y, upperBound.x, upperBound.y);
            // Fixtures of a positive group always meet, whatever their bits. These may meet all: a few pairs more than
            // the engine has. Those of a negative group never do, and meet others by their bits.
            const group = fixture.getFilterGroupIndex();
            if (group > 0) space.setFilter(id + child, 0xffffffff, 0xffffffff);
            else space.setFilter(id + child, fixture.getFilterCategoryBits(), fixture.getFilterMaskBits());
            space.setGroup(id + child, Math.max(0, -group));
            space.setStatic(id + child, body.isStatic());
          }
        }
      }
      for (const [fixture, id] of known) {
        if (now.has(fixture)) continue;
        for (let child = 0; child < fixture.getShape().getChildCount(); child++) space.delete(id + child);
      }
      known = now;
      space.update();
    },
    stop: () => recording.stop(),
    download: (name = 'planck.trace') => recording.download(name),
  };
}

// Records a Matter.js engine: the boxes that its own broad phase uses, body by body, in every step.
// In your game: `const recorded = recordMatter(engine)`, play, then `await recorded.stop()` and `recorded.download()`.
import { BroadPhase } from 'broadphase';
import { record } from 'broadphase/trace';
import Matter from 'matter-js';

const { Composite, Events } = Matter;

/**
 * Records every step of the engine as a frame from now on.
 * @param {Matter.Engine} engine
 */
export function recordMatter(engine) {
  const space = new BroadPhase();
  const recording = record(space);
  let known = new Set();
  const frame = () => {
    const now = new Set();
    for (const body of Composite.allBodies(engine.world)) {
      const { id, bounds, collisionFilter, isStatic } = body;
      space.set(id, bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y);
      // Bodies of a positive group always meet, whatever their bits. These may meet all: a few pairs more than the engine
      // has. Those of a negative group never do, and meet others by their bits.
      const { group, category, mask } = collisionFilter;
      if (group > 0) space.setFilter(id, 0xffffffff, 0xffffffff);
      else space.setFilter(id, category >>> 0, mask >>> 0);
      space.setGroup(id, Math.max(0, -group));
      space.setStatic(id, isStatic);
      now.add(id);
    }
    for (const id of known) if (!now.has(id)) space.delete(id);
    known = now;
    space.update();
  };
  Events.on(engine, 'beforeSolve', frame); // bodies have moved, and their bounds are those of the broad phase
  return {
    space,
    recording,
    stop() {
      Events.off(engine, 'beforeSolve', frame);
      return recording.stop();
    },
    download: (name = 'matter.trace') => recording.download(name),
  };
}

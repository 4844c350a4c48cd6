// Records a Phaser scene with arcade physics: the box of every body, moving and static, in every step.
// In your scene's create(): `const recorded = recordPhaser(this)`, play, then `await recorded.stop()` and
// `recorded.download()`.
import { BroadPhase } from 'broadphase';
import { record } from 'broadphase/trace';

/** @param {Phaser.Scene} scene with `physics: { default: 'arcade' }` */
export function recordPhaser(scene) {
  const { world } = scene.physics;
  const space = new BroadPhase();
  const recording = record(space);
  /** @type {Map<object, number>} */
  let known = new Map();
  let next = 0;
  const frame = () => {
    const now = new Map();
    const put = (body, still) => {
      if (!body.enable) return;
      const id = known.get(body) ?? next++;
      now.set(body, id);
      space.set(id, body.x, body.y, body.x + body.width, body.y + body.height);
      space.setStatic(id, still);
      space.setFilter(id, body.collisionCategory >>> 0, body.collisionMask >>> 0);
    };
    for (const body of world.bodies) put(body, false);
    for (const body of world.staticBodies) put(body, true);
    for (const [body, id] of known) if (!now.has(body)) space.delete(id);
    known = now;
    space.update();
  };
  world.on('worldstep', frame);
  return {
    space,
    recording,
    stop() {
      world.off('worldstep', frame);
      return recording.stop();
    },
    download: (name = 'phaser.trace') => recording.download(name),
  };
}

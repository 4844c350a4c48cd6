// A cloud of boxes that orbit its centre, each on its own circle. Boxes that overlap another are hot.
import { BroadPhase } from 'broadphase';

/** The share of its heat that a box without overlaps keeps each frame. */
const cooling = 0.94;

export class Cloud {
  constructor(count) {
    this.count = count;
    this.space = new BroadPhase({ dimensions: 3 });
    /** The centre of each: x, y, z. */
    this.middles = new Float32Array(3 * count);
    /** Half the width, height and depth of each. */
    this.halves = new Float32Array(3 * count);
    /** How hot each is, 0 to 1. */
    this.heat = new Float32Array(count);
    this.orbits = new Float32Array(4 * count); // radius, height, angle, angle per frame
    /** The radius of the cloud. */
    this.reach = 2.2 * Math.cbrt(count);
    const { reach } = this;
    for (let id = 0; id < count; id++) {
      const radius = reach * (0.15 + 0.85 * Math.sqrt(Math.random()));
      const height = 0.45 * reach * (Math.random() + Math.random() - 1) * (1.2 - radius / reach);
      const speed = (0.12 / Math.sqrt(radius)) * (0.8 + 0.4 * Math.random());
      this.orbits.set([radius, height, 2 * Math.PI * Math.random(), speed / Math.sqrt(reach)], 4 * id);
      for (let axis = 0; axis < 3; axis++) this.halves[3 * id + axis] = 0.15 + 0.4 * Math.random();
    }
    this.move(0);
    this.find();
  }

  move(frames) {
    const { middles, orbits } = this;
    for (let id = 0; id < this.count; id++) {
      orbits[4 * id + 2] += frames * orbits[4 * id + 3];
      const [radius, height, angle] = [orbits[4 * id], orbits[4 * id + 1], orbits[4 * id + 2]];
      middles[3 * id] = radius * Math.cos(angle);
      middles[3 * id + 1] = height;
      middles[3 * id + 2] = radius * Math.sin(angle);
    }
  }

  find() {
    const { count, middles, halves, space } = this;
    const boxes = space.boxes(count); // minX, minY, minZ, maxX, maxY, maxZ
    for (let id = 0; id < count; id++) {
      for (let axis = 0; axis < 3; axis++) {
        const k = 3 * id + axis;
        boxes[6 * id + axis] = middles[k] - halves[k];
        boxes[6 * id + 3 + axis] = middles[k] + halves[k];
      }
    }
    space.update();
  }

  /** Heats boxes that overlap, cools the others. */
  glow() {
    const { heat } = this;
    const { pairs } = this.space;
    for (let id = 0; id < this.count; id++) heat[id] *= cooling;
    for (let k = 0; k < pairs.length; k++) heat[pairs[k]] = 1;
  }
}

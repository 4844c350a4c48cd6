// More motions for checking: in these, most boxes are at rest, or rest for a while.
import type { Motion } from './bodies.ts';

/** One box in five is a guard that walks between two places, and pauses at both; the others are tiles. */
const patrols: Motion = (bodies) => {
  const { count, dimensions, random, at } = bodies;
  const homes = at.slice();
  const ways = Float64Array.from({ length: at.length }, () => bodies.symmetric(1));
  const lengths = Float64Array.from({ length: count }, () => 40 + 100 * random());
  const pauses = Float64Array.from({ length: count }, () => 30 + 90 * random());
  const starts = Float64Array.from({ length: count }, () => 500 * random());
  return (frame) => {
    for (let id = 0; id < count; id += 5) {
      const round = 2 * (lengths[id] + pauses[id]);
      const time = (frame + starts[id]) % round;
      const back = time - lengths[id] - pauses[id];
      const done = back < 0 ? Math.min(lengths[id], time) : Math.max(0, lengths[id] - back);
      for (let k = id * dimensions; k < (id + 1) * dimensions; k++) at[k] = homes[k] + done * ways[k];
    }
  };
};

/** An editor: one box in fifty is dragged about with the pointer and jitters by half its side; all others rest. */
const selection: Motion = (bodies) => {
  const { count, dimensions, sides, at } = bodies;
  const homes = at.slice();
  return (frame) => {
    // Something else is selected every 150 frames.
    const first = Math.floor(frame / 150) % 50;
    for (let id = first; id < count; id += 50) {
      for (let axis = 0, k = id * dimensions; axis < dimensions; axis++, k++) {
        at[k] = homes[k] + 100 * Math.sin((frame % 150) / 50) + bodies.symmetric(sides[id] / 2);
      }
    }
  };
};

/** All rest, except boxes thrown by a blast, one every twenty frames. */
const blasts: Motion = (bodies) => {
  const { count, dimensions, random, world, at, velocity } = bodies;
  const reach = world / 8;
  const middle = new Float64Array(dimensions);
  return (frame) => {
    const blast = frame % 20 === 0;
    if (blast) for (let axis = 0; axis < dimensions; axis++) middle[axis] = random() * world;
    for (let id = 0; id < count; id++) {
      const from = id * dimensions;
      let distance = 1;
      if (blast)
        for (let axis = 0; axis < dimensions; axis++) distance = Math.hypot(distance, at[from + axis] - middle[axis]);
      const force = blast && distance < reach ? 4 / distance : 0;
      for (let axis = 0; axis < dimensions; axis++) {
        const k = from + axis;
        velocity[k] = 0.95 * velocity[k] + force * (at[k] - middle[axis]);
        if (Math.abs(velocity[k]) < 0.001) velocity[k] = 0;
        at[k] += velocity[k];
      }
    }
  };
};

/** A level of tiles side by side, over which one box in a hundred walks, turning at random. */
const tiles: Motion = (bodies) => {
  const { count, dimensions, random, world, at, sides, velocity } = bodies;
  const across = Math.ceil(count ** (1 / dimensions));
  const pitch = world / across;
  for (let id = 0; id < count; id++) {
    if (id % 100 === 0) continue;
    sides[id] = 0.95 * pitch;
    for (let axis = 0, left = id; axis < dimensions; axis++, left = Math.floor(left / across)) {
      at[id * dimensions + axis] = (left % across) * pitch;
    }
  }
  return () => {
    for (let id = 0; id < count; id += 100) {
      const turns = random() < 0.03;
      for (let k = id * dimensions; k < (id + 1) * dimensions; k++) {
        if (turns) velocity[k] = random() < 0.4 ? 0 : bodies.symmetric(2);
        bodies.bounce(k);
      }
    }
  };
};

/** A platformer: one box in twenty runs and leaps on a row of its own, the others are the ground. */
const leaping: Motion = (bodies) => {
  const { count, dimensions, random, at, velocity } = bodies;
  const ground = at.slice();
  return () => {
    for (let id = 0; id < count; id += 20) {
      const k = id * dimensions;
      if (random() < 0.01) velocity[k] = bodies.symmetric(1.5);
      bodies.bounce(k);
      const standing = at[k + 1] >= ground[k + 1];
      if (standing) at[k + 1] = ground[k + 1];
      if (standing && random() < 0.02) velocity[k + 1] = -3;
      else velocity[k + 1] = standing ? 0 : velocity[k + 1] + 0.15;
      at[k + 1] += velocity[k + 1];
    }
  };
};

/** Sand: all fall at one speed, each until it reaches what lies in its column; now and then one is lifted up again. */
const sand: Motion = (bodies) => {
  const { count, dimensions, random, world, at, sides } = bodies;
  const heights = new Map<number, number>();
  const lies = new Uint8Array(count);
  const column = (id: number) => Math.floor(at[id * dimensions] / sides[id]);
  for (let id = 0; id < count; id++) {
    at[id * dimensions] = column(id) * sides[id];
    at[id * dimensions + 1] += 0.3 * world;
  }
  return () => {
    for (let id = 0; id < count; id++) {
      const k = id * dimensions + 1;
      const height = heights.get(column(id)) ?? 0;
      if (lies[id]) {
        if (random() > 0.0005) continue;
        lies[id] = 0;
        heights.set(column(id), height - sides[id]);
        at[k] = 1.3 * world;
      } else if (at[k] - 2 > height) {
        at[k] -= 2;
      } else {
        at[k] = height;
        lies[id] = 1;
        heights.set(column(id), height + sides[id]);
      }
    }
  };
};

export const checkResting = { patrols, selection, blasts, tiles, leaping, sand } satisfies Record<string, Motion>;

// Motions other than those of tune.ts, for checking: nothing may be tuned on them. In these all boxes move; those in
// which most rest are in check-resting.ts.
import type { Bodies, Motion } from './bodies.ts';

/** Birds within this distance of each other see each other. */
const neighbourhood = 40;

/**
 * Steering: each bird turns to the mean direction of its neighbours, and to their centre, or away from it in a crowd.
 */
const flock: Motion = (bodies) => {
  const { count, dimensions, world, at, velocity } = bodies;
  const speed = 0.8;
  const across = Math.max(1, Math.floor(world / neighbourhood));
  const throng = (1.5 * count) / across ** dimensions;
  const cells = new Int32Array(count);
  const sums = new Float64Array(across ** dimensions * (2 * dimensions + 1));
  const width = 2 * dimensions + 1;
  bodies.push(speed);
  return () => {
    sums.fill(0);
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      cells[id] = width * cellOf(bodies, k, across);
      sums[cells[id]]++;
      for (let axis = 0; axis < dimensions; axis++) {
        sums[cells[id] + 1 + axis] += velocity[k + axis];
        sums[cells[id] + 1 + dimensions + axis] += at[k + axis];
      }
    }
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      const cell = cells[id];
      const pull = sums[cell] > throng ? -0.01 : 0.001;
      let length = 1e-9;
      for (let axis = 0; axis < dimensions; axis++) {
        const heading = sums[cell + 1 + axis] / sums[cell] - velocity[k + axis];
        const middle = sums[cell + 1 + dimensions + axis] / sums[cell] - at[k + axis];
        velocity[k + axis] += 0.05 * heading + pull * middle + bodies.symmetric(0.05);
        length = Math.hypot(length, velocity[k + axis]);
      }
      for (let axis = 0; axis < dimensions; axis++) {
        velocity[k + axis] *= speed / length;
        bodies.shift(k + axis, velocity[k + axis]);
      }
    }
  };
};

/** The cell, of `across` along each axis, in which the place at `k` is. */
function cellOf({ dimensions, world, at }: Bodies, k: number, across: number): number {
  let cell = 0;
  for (let axis = 0; axis < dimensions; axis++) {
    const place = Math.floor((at[k + axis] / world) * across);
    cell = cell * across + Math.min(across - 1, Math.max(0, place));
  }
  return cell;
}

/** Each hangs on a damped spring and is knocked now and then. */
const springs: Motion = (bodies) => {
  const { count, dimensions, random, at, velocity } = bodies;
  const homes = at.slice();
  return () => {
    for (let id = 0, k = 0; id < count; id++) {
      const knocked = random() < 0.01;
      for (let axis = 0; axis < dimensions; axis++, k++) {
        velocity[k] = 0.97 * velocity[k] - 0.01 * (at[k] - homes[k]) + (knocked ? bodies.symmetric(1) : 0);
        at[k] += velocity[k];
      }
    }
  };
};

/** Each swings around its place, in its own time. */
const breathing: Motion = (bodies) => {
  const { at, random } = bodies;
  const homes = at.slice();
  const phases = Float64Array.from({ length: at.length }, () => 2 * Math.PI * random());
  return (frame) => {
    for (let k = 0; k < at.length; k++) at[k] = homes[k] + 1.2 * Math.sin(phases[k] + frame / 10);
  };
};

/** Each moves in its own circle. */
const circles: Motion = (bodies) => {
  const { count, dimensions, at, random } = bodies;
  const homes = at.slice();
  const radii = Float64Array.from({ length: count }, () => 10 + 40 * random());
  const phases = Float64Array.from({ length: count }, () => 2 * Math.PI * random());
  return (frame) => {
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      const angle = phases[id] + ((id % 2 ? 0.7 : -0.7) * frame) / radii[id];
      at[k] = homes[k] + radii[id] * Math.cos(angle);
      at[k + 1] = homes[k + 1] + radii[id] * Math.sin(angle);
    }
  };
};

/** Groups of fifty turn around a common centre, which drifts. */
const groups: Motion = (bodies) => {
  const { count, dimensions, world, random, at } = bodies;
  const members = 50;
  const middles = Float64Array.from({ length: dimensions * Math.ceil(count / members) }, () => random() * world);
  const drifts = middles.map(() => bodies.symmetric(0.3));
  const reach = 60;
  const radii = Float64Array.from({ length: count }, () => reach * Math.sqrt(random()));
  const phases = Float64Array.from({ length: count }, () => 2 * Math.PI * random());
  return (frame) => {
    for (let k = 0; k < middles.length; k++) {
      middles[k] += drifts[k];
      if (middles[k] < 0 || middles[k] > world) drifts[k] *= -1;
    }
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      const group = Math.floor(id / members) * dimensions;
      const angle = phases[id] + (Math.floor(id / members) % 2 ? 0.012 : -0.012) * frame;
      at[k] = middles[group] + radii[id] * Math.cos(angle);
      at[k + 1] = middles[group + 1] + radii[id] * Math.sin(angle);
    }
  };
};

/** All drift in a field of whirls that slowly changes. */
const flow: Motion = (bodies) => {
  const { count, dimensions, at } = bodies;
  return (frame) => {
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      const [x, y] = [at[k], at[k + 1]];
      bodies.shift(k, 0.6 * Math.sin(y / 70 + frame / 200));
      bodies.shift(k + 1, 0.6 * Math.sin(x / 90 - frame / 150));
      if (dimensions === 3) bodies.shift(k + 2, 0.6 * Math.sin((x + y) / 110));
    }
  };
};

/** The view zooms in and out: places and sizes alike. */
const zoom: Motion = (bodies) => {
  const { at, world, sides } = bodies;
  const homes = at.slice();
  const full = sides.slice();
  return (frame) => {
    const scale = 1 + 0.25 * Math.sin(frame / 80);
    for (let k = 0; k < at.length; k++) at[k] = world / 2 + scale * (homes[k] - world / 2);
    for (let id = 0; id < sides.length; id++) sides[id] = scale * full[id];
  };
};

/** Straight ahead for seven frames, and then back. */
const reversing: Motion = (bodies) => {
  const { at, velocity } = bodies;
  bodies.push(0.5);
  return (frame) => {
    const way = Math.floor(frame / 7) % 2 === 0 ? 1 : -1;
    for (let k = 0; k < at.length; k++) at[k] += way * velocity[k];
  };
};

/** All fall fast, and start again at the top, anywhere. */
const hail: Motion = (bodies) => {
  const { count, dimensions, random, world, at } = bodies;
  const speeds = Float64Array.from({ length: count }, () => 5 + 5 * random());
  return () => {
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      at[k + 1] += speeds[id];
      if (at[k + 1] <= world) continue;
      for (let axis = 0; axis < dimensions; axis++) at[k + axis] = axis === 1 ? 0 : random() * world;
    }
  };
};

export const checkMoving = {
  flock,
  springs,
  breathing,
  circles,
  groups,
  flow,
  zoom,
  reversing,
  hail,
} satisfies Record<string, Motion>;

// Motions as in games, to tune on. The result of tuning is checked on those of check.ts.
import type { Motion } from './bodies.ts';

/** All fly straight, by up to a fiftieth of their side a frame. */
const straight: Motion = (bodies) => {
  bodies.push(0.2);
  return () => {
    for (let k = 0; k < bodies.at.length; k++) bodies.bounce(k);
  };
};

/** All tremble, and drift apart as a random walk does. */
const noise: Motion = (bodies) => () => {
  for (let k = 0; k < bodies.at.length; k++) bodies.at[k] += bodies.bell(0.15);
};

/** All walk at one speed and turn a little in each frame. */
const wander: Motion = (bodies) => {
  const { count, dimensions, random } = bodies;
  const turns = Float64Array.from({ length: count * (dimensions - 1) }, () => 2 * Math.PI * random());
  const speed = 0.6;
  return () => {
    for (let id = 0, k = 0, t = 0; id < count; id++, k += dimensions, t += dimensions - 1) {
      turns[t] += bodies.symmetric(0.15);
      let along = speed;
      if (dimensions === 3) {
        turns[t + 1] += bodies.symmetric(0.15);
        bodies.shift(k + 2, speed * Math.sin(turns[t + 1]));
        along *= Math.cos(turns[t + 1]);
      }
      bodies.shift(k, along * Math.cos(turns[t]));
      bodies.shift(k + 1, along * Math.sin(turns[t]));
    }
  };
};

/** All are thrown, fall and spring from the ground. */
const gravity: Motion = (bodies) => {
  const { dimensions, world, at, velocity } = bodies;
  bodies.push(1);
  return () => {
    for (let k = 0; k < at.length; k++) {
      if (k % dimensions !== 1) {
        bodies.bounce(k);
        continue;
      }
      velocity[k] += 0.02;
      at[k] += velocity[k];
      if (at[k] <= world) continue;
      at[k] = world;
      velocity[k] *= -0.98;
    }
  };
};

/** Half wait; the others walk to a place nearby, and wait there. */
const units: Motion = (bodies) => {
  const { count, dimensions, random, world, at } = bodies;
  const goals = Float64Array.from({ length: at.length }, () => random() * world);
  const waits = Float64Array.from({ length: count }, () => (random() < 0.5 ? Math.floor(random() * 300) : 0));
  const way = new Float64Array(dimensions);
  const reach = Math.min(200, world / 2);
  return () => {
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      if (waits[id] > 0) {
        waits[id]--;
        continue;
      }
      for (let axis = 0; axis < dimensions; axis++) way[axis] = goals[k + axis] - at[k + axis];
      const distance = Math.hypot(...way);
      if (distance >= 1) {
        for (let axis = 0; axis < dimensions; axis++) at[k + axis] += way[axis] / distance;
        continue;
      }
      for (let axis = 0; axis < dimensions; axis++) {
        const goal = Math.abs(at[k + axis] + bodies.symmetric(reach));
        goals[k + axis] = goal > world ? 2 * world - goal : goal;
      }
      waits[id] = Math.floor(random() * 200);
    }
  };
};

/** Small and fast bullets, fired again from forty guns when their time is over. */
const bullets: Motion = (bodies) => {
  const { count, dimensions, random, world, at, velocity, sides } = bodies;
  const [guns, speed, longest] = [40, 3, 300];
  const lives = new Float64Array(count);
  const places = Float64Array.from({ length: guns * dimensions }, () => random() * world);
  sides.fill(4);
  const fire = (id: number) => {
    const gun = Math.floor(random() * guns) * dimensions;
    let length = 0;
    for (let axis = 0, k = dimensions * id; axis < dimensions; axis++, k++) {
      at[k] = places[gun + axis];
      velocity[k] = bodies.bell(1);
      length = Math.hypot(length, velocity[k]);
    }
    for (let axis = 0, k = dimensions * id; axis < dimensions; axis++, k++) velocity[k] *= speed / length;
    lives[id] = Math.floor(longest * (0.2 + 0.8 * random()));
  };
  for (let id = 0; id < count; id++) {
    fire(id);
    const flown = Math.floor(random() * lives[id]);
    lives[id] -= flown;
    for (let k = dimensions * id; k < dimensions * (id + 1); k++) at[k] += flown * velocity[k];
  }
  return () => {
    for (let id = 0, k = 0; id < count; id++) {
      if (--lives[id] < 0) fire(id);
      for (let axis = 0; axis < dimensions; axis++, k++) at[k] += velocity[k];
    }
  };
};

/** The camera moves: all shift by the same amount, and one in twenty bobs as well. */
const scroll: Motion = (bodies) => {
  const { count, dimensions, at } = bodies;
  return () => {
    for (let id = 0, k = 0; id < count; id++, k += dimensions) {
      bodies.shift(k, -1.5);
      if (id % 20 === 0) at[k + 1] += Math.sin(at[k] / 20);
    }
  };
};

/** A heap at rest, as in a physics engine: all tremble slightly, and one in fifty moves. */
const pile: Motion = (bodies) => {
  const { count, dimensions, at } = bodies;
  return () => {
    for (let id = 0, k = 0; id < count; id++) {
      for (let axis = 0; axis < dimensions; axis++, k++) at[k] += bodies.bell(id % 50 === 0 ? 0.5 : 0.004);
    }
  };
};

/** A server tells where things are: in each frame, of a random thirtieth of them. They fly straight. */
const ticks: Motion = (bodies) => {
  const { count, dimensions, random } = bodies;
  const known = new Uint32Array(count);
  bodies.push(0.2);
  return (frame) => {
    for (let told = 0; told < count / 30; told++) {
      const id = Math.floor(random() * count);
      for (; known[id] < frame; known[id]++) {
        for (let axis = 0; axis < dimensions; axis++) bodies.bounce(id * dimensions + axis);
      }
    }
  };
};

export const tune = { straight, noise, wander, gravity, units, bullets, scroll, pile, ticks } satisfies Record<
  string,
  Motion
>;

// Run by heap.test.ts in a process of its own (node --expose-gc): how many bytes of JavaScript heap a frame takes.
// Prints, as JSON, for every technique, dimension and way to use a space: the bytes allocated per frame, collected
// later or not. The young generation is made so large that nothing is collected while a window is measured; and windows
// follow one another until one allocates nothing, for the engine may not have compiled everything before.
const { BroadPhase, createScene } = await import(process.argv[2]);

const count = 100;
const warmUp = 1000;
const mostWindows = 30;
const frames = 1000;
const nothing = Number(process.argv[3]);

const uses = {
  'set, update, pairCount and stats': (space, { objects }) => {
    setEach(space, objects);
    space.update();
    return space.pairCount + space.stats.tests;
  },
  'boxes, update and pairs': (space, { floats }) => {
    space.boxes(count).set(floats);
    space.update();
    const { pairs } = space;
    let sum = 0;
    for (let k = 0; k < pairs.length; k++) sum += pairs[k];
    return sum;
  },
  'setAll and update': (space, { floats }) => {
    space.setAll(floats);
    space.update();
    return space.pairCount;
  },
  'delete, has, set and update': (space, { objects }, frame) => {
    setEach(space, objects);
    for (let id = frame % 7; id < count; id += 7) if (space.has(id)) space.delete(id);
    space.update();
    return space.size;
  },
  'queries with out': (space, { objects }) => {
    setEach(space, objects);
    space.update();
    // Often enough that the engine finds it worth compiling.
    for (let k = 0; k < 10; k++) {
      if (space.dimensions === 2) askFlat(space, sizes[k % 2]);
      else askSolid(space, sizes[k % 2]);
    }
    return near.out[0];
  },
  'many queries in a call, with out': (space, { floats }) => {
    space.boxes(count).set(floats);
    space.update();
    askMany(space, floats);
    return many[space.dimensions].boxes.out.ids[0];
  },
  'pairs with another space': (space, { floats, objects }) => {
    const { level } = others[space.dimensions];
    if (level.size === 0) level.setAll(floats).update();
    setEach(space, objects);
    space.update();
    return space.pairsWith(level).length + level.pairsWith(space).length;
  },
  'events, rules and reading back': (space, { objects }, frame) => {
    const events = withEvents[space.dimensions];
    setEach(events, objects);
    events.setFilter(frame % count, 1 + (frame & 1), 3).setGroup(frame % count, frame & 1);
    events.setStatic(frame % 9, (frame & 1) === 0).setReach(frame % 7, frame & 1);
    events.setEnabled(frame % 5, (frame & 1) === 0);
    events.update();
    events.get(frame % count, box);
    return events.began.length + events.ended.length + events.groupOf(frame % count);
  },
  'set in three loops of a function': (space, { floats }) => {
    if (space.dimensions === 2) moveFlat(space, floats);
    else moveSolid(space, floats);
    space.update();
    return space.pairCount;
  },
};

const usesOfAuto = [
  'many queries in a call, with out',
  'pairs with another space',
  'events, rules and reading back',
  'set in three loops of a function',
];

const withEvents = { 2: new BroadPhase({ events: true }), 3: new BroadPhase({ events: true, dimensions: 3 }) };
const box = new Float64Array(6);
const others = { 2: { level: new BroadPhase() }, 3: { level: new BroadPhase({ dimensions: 3 }) } };

const options = () => ({ boxes: {}, points: {}, circles: {}, rays: {}, ways: {}, near: {}, all: {} });
const many = { 2: options(), 3: options() };
const firstTenth = { 2: new Float64Array(2 * 12), 3: new Float64Array(3 * 12) };

/** What is asked stands in the numbers of the boxes themselves: any numbers will do. */
function askMany(space, floats) {
  const { dimensions } = space;
  const points = firstTenth[dimensions];
  const { boxes, points: there, circles, rays, ways: way, near, all } = many[dimensions];
  for (let k = 0; k < points.length; k++) points[k] = floats[k];
  boxes.out = space.queryBoxes(floats, boxes);
  there.out = space.queryPoints(points, there);
  rays.out = space.rayCasts(points, rays);
  near.out = space.nearests(points, 5, near);
  all.out = space.nearestsOfAll(2, all);
  // A sphere is a point and a radius: 12 numbers are 4 circles or 3 spheres. A way is a box and how far it moves.
  circles.out = space.queryCircles(points, circles);
  way.out = space.sweeps(ways[dimensions], way);
}

const ways = {
  2: new Float64Array([0, 0, 9, 9, 900, 900, 50, 50, 60, 60, -90, 9]),
  3: new Float64Array([0, 0, 0, 9, 9, 9, 900, 900, 900]),
};

// What is asked, and where the answers go, is kept: only the asking is measured. Answers are many and few in turns, or
// none.
const sizes = [900, 1];
const [inBox, inCircle, there, near] = Array.from({ length: 4 }, () => ({ out: [] }));
const partners = [];
const seen = { last: 0 };
const atPoint = {
  visit: (id) => {
    seen.last = id;
  },
};
const ray = { out: { id: 0, distance: 0, normal: [] } };
const rays = { out: [] };
const view = { out: [] };
const planes = { 2: new Float32Array([1, 0, 1, -1, 0, 900]), 3: new Float64Array([1, 0, 0, 1, -1, 0, 0, 900]) };
const swept = { out: { id: 0, time: 0, normal: [] } };

function askFlat(space, size) {
  space.queryBox(0, 0, size, size, inBox);
  space.queryPoint(50, 50, there);
  space.queryPoint(50, 50, atPoint);
  space.queryCircle(50, 50, size, inCircle);
  space.nearest(50, 50, 10, near);
  space.rayCast(0, 0, 1, 1, ray);
  space.rayCastAll(size, size, 1, 1, rays);
  space.setSwept(7, 0, 0, 9, 9, 900, 900);
  space.setCentred(8, 50, 50, 9, 9);
  space.sweep(0, 0, 9, 9, 900, 900, swept);
  space.queryPlanes(planes[2], view);
  space.isColliding(7, 8);
  space.collisionsOf(7, partners);
}

function askSolid(space, size) {
  space.queryBox(0, 0, 0, size, size, size, inBox);
  space.queryPoint(50, 50, 50, there);
  space.queryPoint(50, 50, 50, atPoint);
  space.querySphere(50, 50, 50, size, inCircle);
  space.nearest(50, 50, 50, 10, near);
  space.queryPlanes(planes[3], view);
  space.rayCast(0, 0, 0, 1, 1, 1, ray);
  space.rayCastAll(size, size, size, 1, 1, 1, rays);
  space.setSwept(7, 0, 0, 0, 9, 9, 9, 900, 900, 900);
  space.setCentred(8, 50, 50, 50, 9, 9, 9);
  space.sweep(0, 0, 0, 9, 9, 9, 900, 900, 900, swept);
  space.isColliding(7, 8);
  space.collisionsOf(7, partners);
}

function setEach(space, boxes) {
  if (space.dimensions === 2) {
    for (let id = 0, k = 0; id < count; id++, k += 4) space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
  } else {
    for (let id = 0, k = 0; id < count; id++, k += 6) {
      space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], boxes[k + 4], boxes[k + 5]);
    }
  }
}

// What a game does with its enemies, bullets and players in one function. The sums are new numbers: the engine puts them
// on the heap unless it inlines all three calls.
const thirds = [0, 33, 66, 99];

function moveFlat(space, at) {
  let id = 0;
  for (; id < thirds[1]; id++) space.set(id, at[4 * id], at[4 * id + 1], at[4 * id] + 9, at[4 * id + 1] + 9);
  for (; id < thirds[2]; id++) space.set(id, at[4 * id] - 1, at[4 * id + 1], at[4 * id], at[4 * id + 1] + 1);
  for (; id < thirds[3]; id++) space.set(id, at[4 * id] - 5, at[4 * id + 1] - 5, at[4 * id] + 5, at[4 * id + 1] + 5);
}

function moveSolid(space, at) {
  let id = 0;
  for (; id < thirds[1]; id++) {
    const k = 6 * id;
    space.set(id, at[k], at[k + 1], at[k + 2], at[k] + 9, at[k + 1] + 9, at[k + 2] + 9);
  }
  for (; id < thirds[2]; id++) {
    const k = 6 * id;
    space.set(id, at[k] - 1, at[k + 1] - 1, at[k + 2] - 1, at[k], at[k + 1], at[k + 2]);
  }
  for (; id < thirds[3]; id++) {
    const k = 6 * id;
    space.set(id, at[k] - 5, at[k + 1], at[k + 2], at[k] + 5, at[k + 1] + 5, at[k + 2] + 5);
  }
}

/**
 * An array whose numbers are heap objects already, which the string in it enforces: a number read from a typed array
 * is made one by the engine when it is passed to a function that is not inlined, and that is the caller's.
 */
const asObjects = (floats) => [...floats, ''];

const used = () => process.memoryUsage().heapUsed;

function measure(technique, dimensions, use) {
  const space = new BroadPhase({ technique, dimensions });
  const scene = createScene(`uniform${dimensions}d`, count);
  const recorded = Array.from({ length: 16 }, () => {
    scene.step();
    return { floats: scene.boxes.slice(), objects: asObjects(scene.boxes) };
  });
  let sink = 0;
  const run = (number) => {
    for (let frame = 0; frame < number; frame++) sink += use(space, recorded[frame % 16], frame);
  };
  run(warmUp);
  globalThis.gc();
  let allocated = Infinity;
  let windows = 0;
  while (windows < mostWindows && allocated >= nothing) {
    const before = used();
    run(frames);
    allocated = Math.min(allocated, Math.abs(used() - before) / frames);
    globalThis.gc();
    windows++;
  }
  return { technique, dimensions, allocated, sink };
}

// Calls that throw come first, among others that go well: engines remember their way from then on, and what it needs
// must not be made in every call.
for (const dimensions of [2, 3]) {
  const space = new BroadPhase({ dimensions });
  for (let k = 0; k < 1000; k++) {
    const good = Array(2 * dimensions).fill(k);
    space.set(1, ...good).setSwept(1, ...good, ...good.slice(dimensions));
    const bad = Array(2 * dimensions).fill(k % 2 ? Number.NaN : '1');
    refused(() => space.set(1, ...bad));
    refused(() => space.setSwept(1, ...bad, ...bad.slice(dimensions)));
    refused(() => space.setCentred(1, ...bad));
  }
}

function refused(call) {
  try {
    call();
  } catch {
    return;
  }
  throw new Error('a bad box was taken');
}

const results = BroadPhase.techniques.flatMap((technique) =>
  [2, 3].flatMap((dimensions) =>
    Object.entries(uses)
      .filter(([use]) => technique === 'auto' || !usesOfAuto.includes(use))
      .map(([use, frame]) => ({ use, ...measure(technique, dimensions, frame) })),
  ),
);
console.log(JSON.stringify(results));

// Run by heap.test.ts in a process of its own (node --expose-gc): how many bytes of JavaScript heap a frame takes.
// Prints, as JSON, for every technique, dimension and way to use a space: the bytes allocated per
// frame, collected later or not. The young generation is made so large that nothing is collected while a window is measured; and
// windows follow one another until one allocates nothing, for the engine may not have compiled everything before.
const { BroadPhase, createScene } = await import(process.argv[2]);

const count = 100;
const warmUp = 1000;
const mostWindows = 10;
const frames = 1000;
const nothing = Number(process.argv[3]);

const uses = {
  'set, update, pairCount and stats': (space, boxes) => {
    setEach(space, boxes);
    space.update();
    return space.pairCount + space.stats.tests;
  },
  'boxes, update, pairCount and stats': (space, boxes) => {
    space.boxes(count).set(boxes);
    space.update();
    return space.pairCount + space.stats.tests;
  },
  'setAll, update and pairs': (space, boxes) => {
    space.setAll(boxes);
    space.update();
    const { pairs } = space;
    let sum = 0;
    for (let k = 0; k < pairs.length; k++) sum += pairs[k];
    return sum;
  },
  'delete, has, set and update': (space, boxes, frame) => {
    setEach(space, boxes);
    for (let id = frame % 7; id < count; id += 7) if (space.has(id)) space.delete(id);
    space.update();
    return space.size;
  },
};

function setEach(space, boxes) {
  if (space.dimensions === 2) {
    for (let id = 0, k = 0; id < count; id++, k += 4) space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
  } else {
    for (let id = 0, k = 0; id < count; id++, k += 6) {
      space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], boxes[k + 4], boxes[k + 5]);
    }
  }
}

const used = () => process.memoryUsage().heapUsed;

function measure(technique, dimensions, use) {
  const space = new BroadPhase({ technique, dimensions });
  const scene = createScene(`uniform${dimensions}d`, count);
  const recorded = Array.from({ length: 16 }, () => {
    scene.step();
    return scene.boxes.slice();
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

const results = BroadPhase.techniques.flatMap((technique) =>
  [2, 3].flatMap((dimensions) =>
    Object.entries(uses).map(([use, frame]) => ({ use, ...measure(technique, dimensions, frame) })),
  ),
);
console.log(JSON.stringify(results));

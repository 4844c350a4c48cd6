// Two showcases with rectangles in d3-force: a chart of grouped rectangles, and a word cloud. The pointer or the arrow
// keys move a rectangle through them.

import { findPairs } from 'broadphase';
import { forceSimulation, forceX, forceY } from 'd3-force';
import { forceCollideRect } from './force-collide-rect.mjs';
import { canvasIn } from './page/canvas.mjs';
import { time } from './page/showcase.mjs';
import { rectangles as rivals } from './rivals.mjs';
import { seeded, wordOf } from './words.mjs';

const padding = 2;
/** Iterations per tick. With fewer, words that are attracted to one point still overlap at the end. */
const iterations = 5;
const [few, many] = [300, 2000];
/** How long the stage keeps a new size before its rectangles are laid out again, in milliseconds. */
const settled = 150;
const hues = [262, 225, 190, 150, 310];
/** How far an arrow key moves the pointer's rectangle, in pixels. */
const keyStep = 24;
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/**
 * What each showcase draws: how large rectangles are before they are scaled to the stage, where they belong, and how much
 * they are pulled there, so that what results has about the shape of the stage.
 */
const kinds = {
  chart: {
    sizeOf(node, random) {
      const value = 0.1 / (0.05 + random());
      const aspect = 0.7 + 1.6 * random();
      node.width = 20 * Math.sqrt(value * aspect);
      node.height = 20 * Math.sqrt(value / aspect);
    },
    middleOf: ({ group }, width, height) => [
      width * (0.2 + 0.15 * group),
      height * (0.5 + ((group % 2 ? 0.13 : -0.13) * height) / width),
    ],
    pull: (width, height) => [0.075 * (height / width), 0.055],
    fill: 0.35,
    spread: [0.2, 0.7],
  },
  cloud: {
    sizeOf(node, random) {
      node.height = 6 + 30 * random() ** 7 + 8 * random();
      node.width = node.label.length * node.height * 0.56;
    },
    middleOf: (_, width, height) => [width / 2, height / 2],
    // Words are wide, and part upwards and downwards.
    pull: (width, height) => [0.04 * (height / width) ** 2, 0.3],
    fill: 0.2,
    spread: [0.9, 0.8],
  },
};

const paint = {
  chart(context, { x, y, width, height, group, label }, { dark }) {
    context.fillStyle = `oklch(${dark ? 0.42 : 0.88} 0.09 ${hues[group]})`;
    context.beginPath();
    context.roundRect(x - width / 2, y - height / 2, width, height, Math.min(5, width / 5, height / 5));
    context.fill();
    const size = Math.min(15, height * 0.5, (1.5 * width) / label.length);
    if (size < 7) return;
    context.font = `550 ${size}px system-ui, sans-serif`;
    context.fillStyle = `oklch(${dark ? 0.92 : 0.34} 0.09 ${hues[group]})`;
    context.fillText(label, x, y);
  },
  cloud(context, { x, y, height, group, label }, { dark }) {
    context.font = `620 ${height * 0.92}px system-ui, sans-serif`;
    context.fillStyle = `oklch(${dark ? 0.8 : 0.5} 0.15 ${hues[group]})`;
    context.fillText(label, x, y);
  },
};

const widthOf = ({ width }) => width;
const heightOf = ({ height }) => height;
/** A force that fades faster than the simulation cools, so that the last ticks only resolve overlaps. */
function fading(pull) {
  const force = (alpha) => pull(alpha ** 2);
  force.initialize = pull.initialize;
  return force;
}

/** Lets no rectangle leave the stage, where it would be cut off: what is pushed over the border stays at it. */
function keepWithin(nodes, width, height) {
  const within = (middle, size, whole) =>
    Math.min(Math.max(middle, size / 2 + padding), Math.max(whole - size / 2 - padding, size / 2 + padding));
  for (const node of nodes) {
    if (node.guest) continue;
    node.vx = within(node.x + node.vx, node.width, width) - node.x;
    node.vy = within(node.y + node.vy, node.height, height) - node.y;
  }
}

const contenders = {
  broadphase: 'broadphase',
  rbush: 'rbush',
  quadtree: 'a quadtree',
  circles: 'forceCollide, circles around',
};
const colliders = { broadphase: forceCollideRect, ...rivals };
const colliderOf = (key) => colliders[key](widthOf, heightOf, padding);

/** How many pairs of rectangles overlap by more than half a pixel. */
function overlapsOf(nodes) {
  const boxes = nodes.flatMap(({ x, y, width, height }) => [
    x - width / 2 + 0.25,
    y - height / 2 + 0.25,
    x + width / 2 - 0.25,
    y + height / 2 - 0.25,
  ]);
  return findPairs(boxes).length / 2;
}

/** Nodes sized to fill their share of the stage, each near its group. */
function makeNodes(kind, count, width, height, seed) {
  const random = seeded(seed);
  const { sizeOf, middleOf, fill, spread } = kinds[kind];
  const nodes = Array.from({ length: count }, (_, k) => ({
    group: k % 5,
    label: wordOf(k + seed),
  }));
  for (const node of nodes) sizeOf(node, random);
  const context = document.createElement('canvas').getContext('2d');
  context.font = '620 92px system-ui, sans-serif';
  if (kind === 'cloud')
    for (const node of nodes) node.width = (context.measureText(node.label).width * node.height) / 100;
  const area = nodes.reduce((sum, node) => sum + node.width * node.height, 0);
  const scale = Math.sqrt((fill * width * height) / area);
  for (const node of nodes) {
    node.width *= scale;
    node.height *= scale;
    const [x, y] = middleOf(node, width, height);
    node.x = x + (random() - 0.5) * width * spread[0];
    node.y = y + (random() - 0.5) * height * spread[1];
  }
  return nodes;
}

const sizeOf = (stage) => [stage.clientWidth, stage.clientHeight];

/** A simulation of rectangles, laid out for the size of a stage. One of them, the guest, is where the pointer is. */
class Layout {
  /** How long the force took in the last tick, in milliseconds. */
  took = 0;
  guest = { label: '', group: 0, width: 0, height: 0, guest: true };

  constructor(kind, count, seed, stage) {
    const [width, height] = sizeOf(stage);
    const { middleOf, pull } = kinds[kind];
    const to = (axis) => (node) => middleOf(node, width, height)[axis];
    const [acrossPull, downPull] = pull(width, height);
    Object.assign(this.guest, { x: width / 2, y: -1e4, fx: width / 2, fy: -1e4 });
    this.stage = stage;
    this.size = `${width} ${height}`;
    this.nodes = [...makeNodes(kind, count, width, height, seed), this.guest];
    this.nodesAtFirst = this.nodes.map((node) => ({ ...node, vx: 0, vy: 0 }));
    this.simulation = forceSimulation(this.nodes)
      .stop()
      .alphaDecay(0.025)
      .velocityDecay(0.1)
      .force('x', fading(forceX(to(0)).strength(acrossPull)))
      .force('y', fading(forceY(to(1)).strength(downPull)));
  }

  /** From now on a contender pushes the rectangles apart. */
  use(key) {
    const collide = colliderOf(key);
    const force = () => {
      this.took = 0;
      for (let turn = 0; turn < iterations; turn++) {
        const started = performance.now();
        collide();
        this.took += performance.now() - started;
        keepWithin(this.nodes, ...sizeOf(this.stage));
      }
    };
    force.initialize = collide.initialize;
    this.simulation.force('collide', force);
    this.#stir(0.3);
  }

  moveGuest(x, y) {
    const side = Math.min(110, this.stage.clientWidth / 5);
    Object.assign(this.guest, { fx: x, fy: y, width: side, height: side });
    this.simulation.force('collide').initialize(this.nodes); // it reads the sizes of all only then
    this.#stir(0.25);
  }

  #stir(alpha) {
    this.simulation.alpha(Math.max(alpha, this.simulation.alpha()));
  }

  get moves() {
    return this.simulation.alpha() > 0.005;
  }

  /** What the last tick took, and what overlaps once hardly anything moves. */
  get report() {
    const calm = this.simulation.alpha() < 0.01;
    const over = calm ? `; ${overlapsOf(this.nodes.filter((node) => node !== this.guest))} overlap` : '';
    return `this tick took ${this.took.toFixed(2)} ms${over}`;
  }

  /** Milliseconds of a contender for the rectangles as they were at first. */
  race(key) {
    const force = colliderOf(key);
    const copies = this.nodesAtFirst.map((node) => ({ ...node }));
    force.initialize(copies, Math.random);
    return time(force, () => {
      for (const node of copies) node.vx = node.vy = 0;
    });
  }
}

function draw(context, kind, { nodes, guest }, colours) {
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const node of nodes) if (node !== guest) paint[kind](context, node, colours);
  if (guest.width === 0) return;
  context.strokeStyle = colours.text;
  context.setLineDash([4, 4]);
  context.strokeRect(guest.x - guest.width / 2, guest.y - guest.height / 2, guest.width, guest.height);
}

/** Calls move(x, y) where the pointer goes; an arrow key moves on from the place that from() returns. */
function followPointer(stage, from, move) {
  const follow = ({ clientX, clientY }) => {
    const { left, top } = stage.getBoundingClientRect();
    move(clientX - left, clientY - top);
  };
  stage.addEventListener('pointermove', follow);
  stage.addEventListener('pointerdown', follow);
  stage.tabIndex = 0;
  stage.addEventListener('keydown', (event) => {
    const way = arrows[event.key];
    if (!way) return;
    event.preventDefault();
    const [x, y] = from();
    move(x + keyStep * way[0], y + keyStep * way[1]);
  });
}

/** Makes the showcase 'chart' or 'cloud': see examples/page/showcase.mjs. */
export const rectanglesDemo =
  (kind) =>
  (stage, { wake, say }) => {
    const things = kind === 'chart' ? 'rectangles' : 'words';
    let [count, seed, key] = [few, 1, 'broadphase'];
    let layout;
    const redraw = canvasIn(stage, (context, _width, _height, colours) => {
      if (layout) draw(context, kind, layout, colours);
    });

    function start(wantedCount, wantedSeed) {
      [count, seed] = [wantedCount, wantedSeed];
      layout = new Layout(kind, count, seed, stage);
      use(key);
    }
    function use(wantedKey) {
      key = wantedKey;
      layout.use(key);
      wake();
    }
    function show() {
      redraw();
      say(`${count} ${things}; ${layout.report}`);
    }
    const guestAt = () =>
      layout.guest.width > 0 ? [layout.guest.fx, layout.guest.fy] : sizeOf(stage).map((size) => size / 2);
    followPointer(stage, guestAt, (x, y) => {
      layout.moveGuest(x, y);
      wake();
    });
    let resized = 0;
    new ResizeObserver(() => {
      clearTimeout(resized);
      // Without a layout for the new size, much would be outside the stage.
      const look = () => layout.size !== sizeOf(stage).join(' ') && start(count, seed);
      if (layout) resized = setTimeout(look, settled);
    }).observe(stage);
    requestAnimationFrame(() => start(count, seed)); // then the stage has its size
    const toCount = (wanted) => ({ [`${wanted.toLocaleString('en')} ${things}`]: () => start(wanted, seed) });
    return {
      legend: 'The force, once, by',
      contenders,
      use,
      race: (name) => layout.race(name),
      actions: { Shuffle: () => start(count, seed + 1), ...toCount(few), ...toCount(many) },
      step() {
        if (!layout) return true;
        layout.simulation.tick();
        show();
        return layout.moves;
      },
      settle() {
        if (!layout) return;
        while (layout.moves) layout.simulation.tick();
        show();
      },
    };
  };

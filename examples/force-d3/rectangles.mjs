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

const colliders = { broadphase: forceCollideRect, ...rivals };

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

/** Makes the showcase 'chart' or 'cloud': see examples/page/showcase.mjs. */
export const rectanglesDemo =
  (kind) =>
  (stage, { wake, say }) => {
    const things = kind === 'chart' ? 'rectangles' : 'words';
    let count = few;
    let seed = 1;
    let nodes = [];
    let raceNodes = [];
    let key = 'broadphase';
    let simulation;
    let took = 0;
    /** The size of the stage for which there is a layout. */
    let size = '';
    let resized = 0;
    const guest = { label: '', group: 0, width: 0, height: 0, guest: true };
    const redraw = canvasIn(stage, (context, _width, _height, colours) => {
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      for (const node of nodes) if (!node.guest) paint[kind](context, node, colours);
      if (guest.width === 0) return;
      context.strokeStyle = colours.text;
      context.setLineDash([4, 4]);
      context.strokeRect(guest.x - guest.width / 2, guest.y - guest.height / 2, guest.width, guest.height);
    });
    const collider = (name) => colliders[name](widthOf, heightOf, padding);

    function start() {
      const [width, height] = [stage.clientWidth, stage.clientHeight];
      size = `${width} ${height}`;
      Object.assign(guest, { x: width / 2, y: -1e4, fx: width / 2, fy: -1e4, width: 0, height: 0 });
      nodes = [...makeNodes(kind, count, width, height, seed), guest];
      raceNodes = nodes.map((node) => ({ ...node, vx: 0, vy: 0 }));
      const to = (axis) => (node) => kinds[kind].middleOf(node, width, height)[axis];
      const [acrossPull, downPull] = kinds[kind].pull(width, height);
      simulation = forceSimulation(nodes)
        .stop()
        .alphaDecay(0.025)
        .velocityDecay(0.1)
        .force('x', fading(forceX(to(0)).strength(acrossPull)))
        .force('y', fading(forceY(to(1)).strength(downPull)));
      use(key);
    }
    function use(name) {
      key = name;
      const collide = collider(name);
      const timed = () => {
        took = 0;
        for (let turn = 0; turn < iterations; turn++) {
          const started = performance.now();
          collide();
          took += performance.now() - started;
          keepWithin(nodes, stage.clientWidth, stage.clientHeight);
        }
      };
      timed.initialize = collide.initialize;
      simulation.force('collide', timed).alpha(Math.max(0.3, simulation.alpha()));
      wake();
    }
    function tell() {
      const rest = simulation.alpha() < 0.01;
      const over = rest ? `; ${overlapsOf(nodes.filter((node) => !node.guest))} overlap` : '';
      say(`${count} ${things}; this tick took ${took.toFixed(2)} ms${over}`);
    }
    function move(x, y) {
      const side = Math.min(110, stage.clientWidth / 5);
      Object.assign(guest, { fx: x, fy: y, width: side, height: side });
      simulation.force('collide').initialize(nodes);
      simulation.alpha(Math.max(0.25, simulation.alpha()));
      wake();
    }
    const place = ({ clientX, clientY }) => {
      const { left, top } = stage.getBoundingClientRect();
      move(clientX - left, clientY - top);
    };
    stage.addEventListener('pointermove', place);
    stage.addEventListener('pointerdown', place);
    stage.tabIndex = 0;
    stage.addEventListener('keydown', (event) => {
      const way = arrows[event.key];
      if (!way) return;
      event.preventDefault();
      const [x, y] = guest.width > 0 ? [guest.fx, guest.fy] : [stage.clientWidth / 2, stage.clientHeight / 2];
      move(x + keyStep * way[0], y + keyStep * way[1]);
    });
    const again = (change) => () => {
      change();
      start();
    };
    const countTo = (wanted) => ({
      [`${wanted.toLocaleString('en')} ${things}`]: again(() => {
        count = wanted;
      }),
    });
    const shuffle = again(() => {
      seed++;
    });
    const actions = { Shuffle: shuffle, ...countTo(few), ...countTo(many) };
    new ResizeObserver(() => {
      clearTimeout(resized);
      // Without a layout for the new size, much would be outside the stage.
      const look = () => size !== `${stage.clientWidth} ${stage.clientHeight}` && start();
      if (simulation) resized = setTimeout(look, settled);
    }).observe(stage);
    requestAnimationFrame(start); // then the stage has its size
    return {
      legend: 'The force, once, by',
      contenders: {
        broadphase: 'broadphase',
        rbush: 'rbush',
        quadtree: 'a quadtree',
        circles: 'forceCollide, circles around',
      },
      use,
      race(name) {
        const force = collider(name);
        const copies = raceNodes.map((node) => ({ ...node }));
        force.initialize(copies, Math.random);
        return time(force, () => {
          for (const node of copies) node.vx = node.vy = 0;
        });
      },
      actions,
      step() {
        if (!simulation) return true;
        simulation.tick();
        redraw();
        tell();
        return simulation.alpha() > 0.005;
      },
      settle() {
        if (!simulation) return;
        while (simulation.alpha() > 0.005) simulation.tick();
        redraw();
        tell();
      },
      get nodes() {
        return nodes;
      },
    };
  };

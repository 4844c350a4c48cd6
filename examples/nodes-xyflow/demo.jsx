// A React Flow canvas whose nodes make room for each other: while one is dragged, or all at once.
import '@xyflow/react/dist/style.css';
import './demo.css';
import { applyNodeChanges, Background, Handle, Position, ReactFlow } from '@xyflow/react';
import { memo, useSyncExternalStore } from 'react';
import { createRoot } from 'react-dom/client';
import { seeded } from './datasets.mjs';
import { time } from './page/showcase.mjs';
import * as rivals from './rivals.mjs';
import { separate } from './separate.mjs';

const padding = 6;
const pasted = 500;
/** A heap may need a thousand iterations. */
const enough = 5000;
const words = [
  'Fetch',
  'Parse',
  'Join',
  'Filter',
  'Score',
  'Rank',
  'Notify',
  'Store',
  'Merge',
  'Sample',
  'Clean',
  'Plot',
];

const Card = memo(({ data: { label, hue } }) => (
  <div className="card" style={{ '--hue': hue }}>
    <Handle type="target" position={Position.Left} />
    {label}
    <Handle type="source" position={Position.Right} />
  </div>
));
const nodeTypes = { card: Card };

function cardAt(id, x, y, random) {
  const [width, height] = [Math.round(84 + 70 * random()), Math.round(34 + 26 * random())];
  const data = { label: `${words[id % words.length]} ${id + 1}`, hue: 200 + 160 * random() };
  return { id: String(id), type: 'card', position: { x: x - width / 2, y: y - height / 2 }, width, height, data };
}

/** A flow laid out in haste: a tree, with each level in a column too short for it. */
function firstFlow() {
  const random = seeded(3);
  const nodes = Array.from({ length: 40 }, (_, k) => {
    const level = k === 0 ? 0 : k < 4 ? 1 : k < 13 ? 2 : 3;
    const [from, to] = [[0, 1, 4, 13][level], [1, 4, 13, 40][level]];
    const height = 90 * Math.sqrt(to - from + 1);
    return cardAt(k, 230 * level + 30 * random(), ((k + 0.5 - from) / (to - from) - 0.5) * height * 1.6, random);
  });
  const edges = nodes.slice(1).map(({ id, data }) => {
    const source = String(Math.floor((Number(id) - 1) / 3));
    const ariaLabel = `From ${nodes[source].data.label} to ${data.label}`;
    return { id: `${source}-${id}`, source, target: id, ariaLabel };
  });
  return { nodes, edges };
}

/**
 * Where the page scrolls, which the stage's touch-action says, a finger beside the nodes is the page's, and two are the
 * canvas's. React Flow would take every finger.
 */
function shareFingers(stage) {
  const share = (event) => {
    if (getComputedStyle(stage).touchAction === 'none' || event.target.closest('.react-flow__node')) return;
    if (event.touches.length === 1) event.stopPropagation();
    else event.preventDefault();
  };
  stage.addEventListener('touchstart', share, { capture: true, passive: false });
}

/** Nodes that are shown again when others are given. */
class Nodes {
  #nodes;
  #listeners = new Set();

  constructor(nodes) {
    this.#nodes = nodes;
  }

  get = () => this.#nodes;

  show(nodes) {
    this.#nodes = nodes;
    for (const listener of this.#listeners) listener();
  }

  subscribe = (listener) => {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  };
}

function Canvas({ nodes, edges, changed, started }) {
  return (
    <ReactFlow
      nodes={useSyncExternalStore(nodes.subscribe, nodes.get)}
      edges={edges}
      nodeTypes={nodeTypes}
      edgesFocusable={false}
      onNodesChange={changed}
      onInit={started}
      aria-label="A canvas of nodes. Tab goes from node to node, Enter selects one, arrow keys move it."
      colorMode="system"
      minZoom={0.1}
      preventScrolling={false}
      fitView
    >
      <Background />
    </ReactFlow>
  );
}

const fixed = (node) => node.dragging === true;

/** Moves nodes apart, some iterations a frame, by the contender who is chosen. */
class Separation {
  work = separate;
  /** Until none overlap; then all of them are brought into view, which dragging a node does not do. */
  untangling = false;
  /** Nothing moves after other nodes were given, until someone moves one or asks for it. */
  resting = true;
  #nodes;
  #say;
  #fit;

  constructor(nodes, say, fit) {
    this.#nodes = nodes;
    this.#say = say;
    this.#fit = fit;
  }

  /** Returns whether there is more to come. */
  run(maxIterations) {
    if (this.resting) return false;
    const nodes = this.#nodes.get();
    const started = performance.now();
    const next = this.work(nodes, { padding, maxIterations, fixed });
    const taken = performance.now() - started;
    const apart = next === nodes;
    if (!apart) this.#nodes.show(next);
    if (this.untangling && (apart || maxIterations === enough)) {
      this.untangling = false;
      this.#fit();
    }
    this.#say(`${nodes.length} nodes; this step took ${taken.toFixed(2)} ms${apart ? '; none overlap' : ''}`);
    return !apart || nodes.some(fixed);
  }

  stop() {
    this.resting = true; // a frame of before may be on its way
    this.untangling = false;
  }
}

const by = { broadphase: separate, ...rivals };

/** The showcase: see examples/page/showcase.mjs. */
export function nodesDemo(stage, { wake, say }) {
  const first = firstFlow();
  const nodes = new Nodes(first.nodes);
  let heap = withHeap(first.nodes);
  let flow;
  const fit = () => requestAnimationFrame(() => flow?.fitView({ padding: 0.08 }));
  const separation = new Separation(nodes, say, fit);
  const run = () => {
    separation.resting = false;
    wake();
  };
  const changed = (changes) => {
    nodes.show(applyNodeChanges(changes, nodes.get()));
    if (changes.some(({ type }) => type === 'position')) run();
  };
  const started = (instance) => {
    flow = instance;
  };
  shareFingers(stage);
  createRoot(stage).render(<Canvas nodes={nodes} edges={first.edges} changed={changed} started={started} />);

  const start = (given) => {
    separation.stop();
    nodes.show(given);
    say(`${given.length} nodes`);
    fit();
  };
  say(`${first.nodes.length} nodes, some over others: drag one, or press Untangle`);
  return {
    legend: 'Ten iterations with 540 nodes, by',
    contenders: {
      broadphase: 'broadphase',
      rbush: 'rbush',
      flatbush: 'flatbush',
      quadtree: 'quadtree',
      naive: 'all pairs',
    },
    use(key) {
      separation.work = by[key];
    },
    race: (key) => time(() => by[key](heap, { padding, maxIterations: 10 })),
    actions: {
      Untangle: () => {
        separation.untangling = true;
        run();
      },
      'Paste 500': () => {
        heap = withHeap(nodes.get().slice(0, first.nodes.length));
        start(withHeap(nodes.get()));
      },
      'Start over': () => start(first.nodes),
    },
    step: () => separation.run(2),
    settle: () => separation.run(enough),
    stop: () => separation.stop(),
    get nodes() {
      return nodes.get();
    },
  };
}

/** The nodes and 500 more, in a heap below them. */
function withHeap(nodes) {
  const random = seeded(nodes.length);
  const side = 74 * Math.sqrt(pasted);
  const more = Array.from({ length: pasted }, (_, k) =>
    cardAt(nodes.length + k, 350 + side * (random() - 0.5) * 1.5, 300 + side * random(), random),
  );
  return [...nodes, ...more];
}

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
  const edges = nodes.slice(1).map(({ id }) => {
    const source = String(Math.floor((Number(id) - 1) / 3));
    return { id: `${source}-${id}`, source, target: id };
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

/** The showcase: see examples/page/showcase.mjs. */
export function nodesDemo(stage, { wake, say }) {
  const by = { broadphase: separate, ...rivals };
  const first = firstFlow();
  let { nodes } = first;
  let heap = withHeap(nodes);
  let work = separate;
  let relaxing = false;
  /** Nothing moves after other nodes were given, until someone moves one or asks for it. */
  let resting = true;
  /** Until none overlap; then all of them are brought into view, which dragging a node does not do. */
  let untangling = false;
  let flow;
  const listeners = new Set();
  const show = (next) => {
    nodes = next;
    for (const listener of listeners) listener();
  };
  const subscribe = (listener) => {
    listeners.add(listener);
    return () => listeners.delete(listener);
  };
  const fixed = (node) => node.dragging === true;
  const make = (maxIterations) => {
    const started = performance.now();
    const next = work(nodes, { padding, maxIterations, fixed });
    const taken = performance.now() - started;
    const apart = next === nodes;
    relaxing = !apart || nodes.some(fixed);
    if (!apart) show(next);
    if (untangling && (apart || maxIterations === enough)) {
      untangling = false;
      fit();
    }
    say(`${nodes.length} nodes; this step took ${taken.toFixed(2)} ms${apart ? '; none overlap' : ''}`);
  };
  const run = () => {
    resting = false;
    wake();
  };
  const changed = (changes) => {
    show(applyNodeChanges(changes, nodes));
    if (changes.some(({ type }) => type === 'position')) run();
  };

  function Canvas() {
    return (
      <ReactFlow
        nodes={useSyncExternalStore(subscribe, () => nodes)}
        edges={first.edges}
        nodeTypes={nodeTypes}
        edgesFocusable={false}
        onNodesChange={changed}
        onInit={(instance) => {
          flow = instance;
        }}
        colorMode="system"
        minZoom={0.1}
        preventScrolling={false}
        fitView
      >
        <Background />
      </ReactFlow>
    );
  }
  shareFingers(stage);
  createRoot(stage).render(<Canvas />);

  const fit = () => requestAnimationFrame(() => flow?.fitView({ padding: 0.08 }));
  const start = (given) => {
    relaxing = untangling = false;
    resting = true; // a frame of before may be on its way
    show(given);
    say(`${given.length} nodes`);
    fit();
  };
  say(`${nodes.length} nodes, some over others: drag one, or press Untangle`);
  return {
    legend: 'Ten iterations with 540 nodes, by',
    contenders: {
      broadphase: 'broadphase',
      rbush: 'rbush',
      flatbush: 'flatbush',
      quadtree: 'quadtree',
      naive: 'every two',
    },
    use(key) {
      work = by[key];
    },
    race: (key) => time(() => by[key](heap, { padding, maxIterations: 10 })),
    actions: {
      Untangle: () => {
        untangling = true;
        run();
      },
      'Paste 500': () => {
        heap = withHeap(nodes.slice(0, first.nodes.length));
        start(withHeap(nodes));
      },
      'Start over': () => start(first.nodes),
    },
    step() {
      if (resting) return false;
      make(2);
      return relaxing;
    },
    settle() {
      if (!resting) make(enough);
    },
    stop() {
      resting = true;
      untangling = false;
    },
    get nodes() {
      return nodes;
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

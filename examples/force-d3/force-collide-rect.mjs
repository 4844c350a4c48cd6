// A force for d3-force that keeps rectangles apart, as forceCollide does with circles. One file, to copy.
import { BroadPhase } from 'broadphase';

const constant = (value) => (typeof value === 'function' ? value : () => +value);

/**
 * Pushes nodes apart whose rectangles would overlap, along the axis of least overlap. The smaller one moves further:
 * each moves by the other's share of their areas. Rectangles are centred on the nodes' x and y, and may have any
 * size.
 *
 * @param width pixels, or (node, index, nodes) => pixels
 * @param height the same
 * @param padding pixels of free space between two rectangles
 */
export function forceCollideRect(width = 1, height = 1, padding = 0) {
  const options = { width, height, padding, strength: 1, iterations: 1 };
  const space = new BroadPhase();
  let nodes = [];
  let sizes = new Float64Array(0); // half the width and half the height of each node
  let boxes = new Float64Array(0);

  function force() {
    for (let turn = 0; turn < options.iterations; turn++) {
      for (let k = 0; k < nodes.length; k++) {
        const { x, y, vx, vy } = nodes[k];
        const [halfWidth, halfHeight] = [sizes[2 * k] + options.padding / 2, sizes[2 * k + 1] + options.padding / 2];
        boxes[4 * k] = x + vx - halfWidth; // where it will be after this tick
        boxes[4 * k + 1] = y + vy - halfHeight;
        boxes[4 * k + 2] = x + vx + halfWidth;
        boxes[4 * k + 3] = y + vy + halfHeight;
      }
      const { pairs } = space.setAll(boxes).update();
      for (let k = 0; k < pairs.length; k += 2) push(pairs[k], pairs[k + 1]);
    }
  }

  function push(i, j) {
    const [a, b] = [nodes[i], nodes[j]];
    const dx = a.x + a.vx - b.x - b.vx;
    const dy = a.y + a.vy - b.y - b.vy;
    const overX = sizes[2 * i] + sizes[2 * j] + options.padding - Math.abs(dx);
    const overY = sizes[2 * i + 1] + sizes[2 * j + 1] + options.padding - Math.abs(dy);
    if (overX <= 0 || overY <= 0) return; // an earlier push has parted them
    const [areaA, areaB] = [sizes[2 * i] * sizes[2 * i + 1], sizes[2 * j] * sizes[2 * j + 1]];
    const share = areaA + areaB > 0 ? areaB / (areaA + areaB) : 0.5;
    const [velocity, over] = overX < overY ? ['vx', dx < 0 ? -overX : overX] : ['vy', dy < 0 ? -overY : overY];
    a[velocity] += options.strength * over * share;
    b[velocity] -= options.strength * over * (1 - share);
  }

  force.initialize = (given) => {
    nodes = given;
    boxes = new Float64Array(4 * nodes.length);
    sizes = Float64Array.from({ length: 2 * nodes.length }, (_, k) => {
      const size = constant(k % 2 ? options.height : options.width);
      return size(nodes[k >> 1], k >> 1, nodes) / 2;
    });
  };
  for (const name of Object.keys(options)) {
    force[name] = (value) => {
      if (value === undefined) return options[name];
      options[name] = value;
      force.initialize(nodes);
      return force;
    };
  }
  return force;
}

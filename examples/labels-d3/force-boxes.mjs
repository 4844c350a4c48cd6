// A force for d3-force that keeps boxes from overlapping, as forceCollide does for circles: labels, cards, nodes with
// text. Pairs come from broadphase, so that thousands of labels are no burden.
import { BroadPhase } from 'broadphase';

/**
 * Each tick, nodes whose boxes overlap are pushed apart along the axis where that takes less.
 * @param size (node) => [width, height], around the node's x and y
 */
export function forceBoxes(size) {
  const space = new BroadPhase();
  let nodes = [];
  let sizes = [];
  let padding = 0;
  let strength = 1;

  function force() {
    for (const [id, { x, y, vx, vy }] of nodes.entries()) {
      const [width, height] = sizes[id];
      // Where it will be, as forceCollide has it.
      const [left, top] = [x + vx - width / 2 - padding, y + vy - height / 2 - padding];
      space.set(id, left, top, left + width + 2 * padding, top + height + 2 * padding);
    }
    const { pairs } = space.update();
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [nodes[pairs[k]], nodes[pairs[k + 1]]];
      const [sizeA, sizeB] = [sizes[pairs[k]], sizes[pairs[k + 1]]];
      const dx = a.x + a.vx - b.x - b.vx;
      const dy = a.y + a.vy - b.y - b.vy;
      const overX = (sizeA[0] + sizeB[0]) / 2 + 2 * padding - Math.abs(dx);
      const overY = (sizeA[1] + sizeB[1]) / 2 + 2 * padding - Math.abs(dy);
      if (overX <= 0 || overY <= 0) continue; // an earlier push has parted them
      if (overX < overY) {
        const push = (strength * overX * (dx < 0 ? -1 : 1)) / 2;
        a.vx += push;
        b.vx -= push;
      } else {
        const push = (strength * overY * (dy < 0 ? -1 : 1)) / 2;
        a.vy += push;
        b.vy -= push;
      }
    }
  }

  force.initialize = (given) => {
    nodes = given;
    sizes = nodes.map(size);
    space.clear();
  };
  /** Free space around each box. */
  force.padding = (value) => {
    padding = value;
    return force;
  };
  /** The share of an overlap that is undone in a tick, 0 to 1. */
  force.strength = (value) => {
    strength = value;
    return force;
  };
  return force;
}

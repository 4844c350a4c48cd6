// What people use instead. For rectangles in d3-force: a quadtree, rbush, or circles around them. For labels, one by
// one: a loop over all that are shown, or rbush.
import { forceCollide } from 'd3-force';
import { quadtree } from 'd3-quadtree';
import RBush from 'rbush';

/**
 * A force with the rule of forceCollideRect, made from a search: (nodes, boxes) => (index) => candidates. Boxes are
 * { minX, minY, maxX, maxY, index }.
 */
const forceBy = (find) => (width, height, padding) => {
  let nodes = [];
  let sizes = [];
  const push = (i, j) => {
    const [a, b] = [nodes[i], nodes[j]];
    const [widthA, heightA] = sizes[i];
    const [widthB, heightB] = sizes[j];
    const dx = a.x + a.vx - b.x - b.vx;
    const dy = a.y + a.vy - b.y - b.vy;
    const overX = (widthA + widthB) / 2 + padding - Math.abs(dx);
    const overY = (heightA + heightB) / 2 + padding - Math.abs(dy);
    if (overX <= 0 || overY <= 0) return;
    const share = (widthB * heightB) / (widthA * heightA + widthB * heightB);
    const [velocity, over] = overX < overY ? ['vx', dx < 0 ? -overX : overX] : ['vy', dy < 0 ? -overY : overY];
    a[velocity] += over * share;
    b[velocity] -= over * (1 - share);
  };
  const force = () => {
    const boxes = nodes.map(({ x, y, vx, vy }, index) => {
      const [halfWidth, halfHeight] = [(sizes[index][0] + padding) / 2, (sizes[index][1] + padding) / 2];
      const [midX, midY] = [x + vx, y + vy];
      return {
        minX: midX - halfWidth,
        minY: midY - halfHeight,
        maxX: midX + halfWidth,
        maxY: midY + halfHeight,
        index,
      };
    });
    const candidatesOf = find(boxes);
    for (const box of boxes) candidatesOf(box, (index) => index > box.index && push(box.index, index));
  };
  force.initialize = (given) => {
    nodes = given;
    sizes = nodes.map((node) => [width(node), height(node)]);
  };
  return force;
};

export const rectangles = {
  rbush: forceBy((boxes) => {
    const tree = new RBush().load(boxes);
    return (box, see) => {
      for (const { index } of tree.search(box)) see(index);
    };
  }),
  /** Centres in a quadtree, whose squares have the largest half sizes in them. */
  quadtree: forceBy((boxes) => {
    const middle = (low, high) => (box) => (box[low] + box[high]) / 2;
    const tree = quadtree(boxes, middle('minX', 'maxX'), middle('minY', 'maxY'));
    tree.visitAfter((square) => {
      const inside = square.length ? square.filter(Boolean) : [square];
      square.reachX = Math.max(...inside.map((part) => part.reachX ?? (part.data.maxX - part.data.minX) / 2));
      square.reachY = Math.max(...inside.map((part) => part.reachY ?? (part.data.maxY - part.data.minY) / 2));
    });
    return ({ minX, minY, maxX, maxY }, see) =>
      tree.visit((square, x0, y0, x1, y1) => {
        for (let leaf = square.length ? undefined : square; leaf; leaf = leaf.next) see(leaf.data.index);
        const { reachX, reachY } = square;
        return x0 - reachX > maxX || x1 + reachX < minX || y0 - reachY > maxY || y1 + reachY < minY;
      });
  }),
  /** d3's own force, with a circle around each rectangle. */
  circles: (width, height, padding) => forceCollide((node) => Math.hypot(width(node), height(node)) / 2 + padding / 2),
};

/** firstScales with a collection made for each scale: () => { add(box), meets(box) }. */
const firstScalesBy = (collect) => (labels, scales) => {
  const first = new Float64Array(labels.length).fill(Number.POSITIVE_INFINITY);
  for (const scale of scales) {
    const boxes = labels.map(({ x, y, width, height }) => {
      const [midX, midY] = [scale * x, scale * y];
      return { minX: midX - width / 2, minY: midY - height / 2, maxX: midX + width / 2, maxY: midY + height / 2 };
    });
    const shown = collect(boxes.filter((_, k) => first[k] < scale));
    for (const [k, box] of boxes.entries()) {
      if (first[k] < scale || shown.meets(box)) continue;
      shown.add(box);
      first[k] = scale;
    }
  }
  return first;
};

export const labels = {
  rbush: firstScalesBy((kept) => {
    const tree = new RBush().load(kept);
    return { add: (box) => tree.insert(box), meets: (box) => tree.collides(box) };
  }),
  'every shown': firstScalesBy((kept) => {
    const shown = [...kept];
    const meets = ({ minX, minY, maxX, maxY }) =>
      shown.some((box) => box.minX <= maxX && box.maxX >= minX && box.minY <= maxY && box.maxY >= minY);
    return { add: (box) => shown.push(box), meets };
  }),
};

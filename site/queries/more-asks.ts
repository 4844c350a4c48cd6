// More queries of the page: what a camera sees, many rays in one call, the pairs of two spaces, and the contents of
// one.
import { BroadPhase, type ManyRayHits } from 'broadphase';
import { type Ask, first, found, join, maskText, short } from './ask.ts';

/** Half of the angle that the camera sees, and its sine and cosine. */
const half = Math.PI / 7;
const [sine, cosine] = [Math.sin(half), Math.cos(half)];

/** Left, right and far side of the view: for each, a normal that points inside, and an offset. */
const planes = new Float64Array(9);
const cut: number[] = [];
const whole: number[] = [];

function look(x: number, y: number, toX: number, toY: number): void {
  const length = Math.hypot(toX - x, toY - y) || 1;
  const [dx, dy] = [(toX - x) / length, (toY - y) / length];
  const put = (at: number, nx: number, ny: number, inside: number) =>
    planes.set([nx, ny, inside - nx * x - ny * y], at);
  put(0, dx * sine + dy * cosine, dy * sine - dx * cosine, 0);
  put(3, dx * sine - dy * cosine, dy * sine + dx * cosine, 0);
  put(6, -dx, -dy, length);
}

const viewOptions = {
  mask: 7,
  visit: (id: number, inside: boolean) => {
    if (inside) whole.push(id);
    else cut.push(id);
  },
};

export const view: Ask = {
  name: 'view',
  label: 'View',
  hint: 'Drag from the camera to where it looks. Boxes wholly in view are blue, those cut by its sides are red.',
  counts: 'Boxes in view',
  options: ['mask'],
  prepare({ aim }) {
    look(aim[0], aim[1], aim[2], aim[3]);
  },
  ask({ space, mask }) {
    cut.length = whole.length = 0;
    viewOptions.mask = mask;
    space.queryPlanes(planes, viewOptions);
  },
  mark({ slots }) {
    for (let n = 0; n < cut.length; n++) slots[cut[n]] = first;
    for (let n = 0; n < whole.length; n++) slots[whole[n]] = found;
    return cut.length + whole.length;
  },
  draw({ pen, aim: [x, y, toX, toY] }) {
    const [dx, dy] = [toX - x, toY - y];
    const wide = sine / cosine;
    pen.line(x, y, toX - dy * wide, toY + dx * wide, 'accent');
    pen.line(x, y, toX + dy * wide, toY - dx * wide, 'accent');
    pen.line(toX - dy * wide, toY + dx * wide, toX + dy * wide, toY - dx * wide, 'accent');
    pen.dot(x, y, 5, 'accent');
  },
  text(desk) {
    const rows = [0, 3, 6].map(
      (k) => `  ${[planes[k], planes[k + 1]].map((n) => n.toFixed(2)).join(', ')}, ${short(planes[k + 2])},`,
    );
    return `const planes = [\n${rows.join('\n')}\n]; // left, right, far\nspace.queryPlanes(${join('planes', maskText(desk))});\n// ${cut.length + whole.length} boxes, ${whole.length} wholly inside`;
  },
};

const rayCount = 90;
/** How far each ray reaches, as a share of the world. */
const reach = 0.3;
const rays = new Float64Array(4 * rayCount);
let hits: ManyRayHits | undefined;
let met = 0;

export const fan: Ask = {
  name: 'fan',
  label: 'Many rays',
  hint: 'Move the point: 90 rays are cast from it, in one call. What a robot sees, or where light falls.',
  counts: 'Rays that hit a box',
  options: ['mask'],
  prepare({ aim }) {
    for (let k = 0; k < rayCount; k++) {
      const angle = (2 * Math.PI * k) / rayCount;
      rays[4 * k] = aim[2];
      rays[4 * k + 1] = aim[3];
      rays[4 * k + 2] = Math.cos(angle);
      rays[4 * k + 3] = Math.sin(angle);
    }
  },
  ask({ space, mask, world }) {
    hits = space.rayCasts(rays, { mask, maxDistance: reach * world, ...(hits && { out: hits }) });
  },
  mark({ slots }) {
    met = hits!.offsets[rayCount];
    for (let n = 0; n < met; n++) slots[hits!.ids[n]] = found;
    return met;
  },
  draw({ pen, aim, world }) {
    if (!hits) return;
    for (let k = 0; k < rayCount; k++) {
      const n = hits.offsets[k];
      const isHit = n < hits.offsets[k + 1];
      const far = isHit ? hits.distances[n] : reach * world;
      pen.line(
        aim[2],
        aim[3],
        aim[2] + far * rays[4 * k + 2],
        aim[3] + far * rays[4 * k + 3],
        isHit ? 'accent' : 'faint',
      );
    }
    pen.dot(aim[2], aim[3], 5, 'accent');
  },
  text(desk) {
    const options = `{ ${desk.mask === 7 ? '' : `mask: ${desk.mask}, `}maxDistance: ${short(reach * desk.world)} }`;
    const ids = hits ? [...hits.ids.subarray(0, Math.min(met, 12))] : [];
    return `space.rayCasts(rays, ${options});\n// ids: [${ids.join(', ')}${met > 12 ? ', …' : ''}], of ${met} of ${rayCount} rays`;
  },
};

const ringCount = 36;
const ring: BroadPhase<2 | 3> = new BroadPhase();
const ringBoxes = new Float32Array(4 * ringCount);
let pairs: Uint32Array = new Uint32Array();

export const spaces: Ask = {
  name: 'spaces',
  label: 'Two spaces',
  hint: 'The ring is a space of its own. Move it: its pairs with the boxes are retained, so only what moves costs time.',
  counts: 'Pairs of the two',
  options: ['radius'],
  prepare({ aim, radius, world }) {
    const side = world / 60;
    for (let k = 0; k < ringCount; k++) {
      const angle = (2 * Math.PI * k) / ringCount;
      const x = aim[2] + radius * Math.cos(angle);
      const y = aim[3] + radius * Math.sin(angle);
      ringBoxes.set([x - side / 2, y - side / 2, x + side / 2, y + side / 2], 4 * k);
    }
  },
  ask({ space }) {
    pairs = ring.setAll(ringBoxes).update().pairsWith(space);
  },
  mark({ slots }) {
    for (let k = 1; k < pairs.length; k += 2) slots[pairs[k]] = found;
    return pairs.length / 2;
  },
  draw({ pen }) {
    const touched = new Set<number>();
    for (let k = 0; k < pairs.length; k += 2) touched.add(pairs[k]);
    for (let k = 0; k < ringCount; k++) {
      const [x, y, toX, toY] = ringBoxes.subarray(4 * k, 4 * k + 4);
      pen.box(x, y, toX, toY, touched.has(k) ? 'text' : 'accent');
    }
  },
  text() {
    const some = [...pairs.subarray(0, 12)].join(', ');
    return `ring.setAll(boxes).update();\nring.pairsWith(space); // of each pair one of the ring, then one of the boxes\n// [${some}${pairs.length > 12 ? ', …' : ''}]`;
  },
};

export const debug: Ask = {
  name: 'debug',
  label: 'Debug drawing',
  hint: 'What broadphase/draw shows of a space: boxes, pairs, the nodes of a quadtree, and a ray. Drag the ray.',
  counts: 'Pairs',
  options: [],
  technique: 'quadtree',
  mark: ({ space }) => space.pairCount,
  draw({ pen, space, aim: [x, y, toX, toY] }) {
    pen.space(space, { cells: true, hot: true, rays: [[x, y, toX - x, toY - y]] });
  },
  text({ aim: [x, y, toX, toY] }) {
    const ray = [x, y, toX - x, toY - y].map(short).join(', ');
    return `drawSpace(context, space, {\n  cells: true,\n  hot: true, // the fullest\n  rays: [[${ray}]],\n});`;
  },
};

// The queries of the page. Each has the query to the space, the marks for the answer among the boxes, the drawing above
// them, and the text of the call. All aim with the same two points: where the pointer went down, and where it is now.
import type { BroadPhase, RayHit, SweepHit } from 'broadphase';
import { shades } from '../shared/groups.ts';
import { type Ask, type Desk, first, flash, found, fresh, gone, hueSlot, join, list, maskText, short } from './ask.ts';
import { debug, fan, spaces, view } from './more-asks.ts';

const ids: number[] = [];
const idsOptions = { out: ids, mask: 7 };
const boxOptions = { out: ids, mask: 7, within: false };
const rays: RayHit[] = [];
const raysOptions = { out: rays, mask: 7 };
const rayOptions = { out: { id: 0, distance: 0, normal: [0, 0] }, mask: 7 };
const sweepOptions = { out: { id: 0, time: 0, normal: [0, 0] }, mask: 7 };
let ray: RayHit | undefined;
let met: SweepHit | undefined;

function markIds({ slots }: Desk): number {
  for (let n = 0; n < ids.length; n++) slots[ids[n]] = found;
  return ids.length;
}

const box: Ask = {
  name: 'box',
  label: 'Box',
  hint: 'Drag across the view to find the boxes that touch yours, or lie wholly inside it.',
  counts: 'Boxes found',
  options: ['within', 'mask'],
  ask({ space, aim, mask, within }) {
    boxOptions.mask = mask;
    boxOptions.within = within;
    const [x, y, toX, toY] = aim;
    space.queryBox(Math.min(x, toX), Math.min(y, toY), Math.max(x, toX), Math.max(y, toY), boxOptions);
  },
  mark: markIds,
  draw({ pen, aim: [x, y, toX, toY] }) {
    pen.box(Math.min(x, toX), Math.min(y, toY), Math.max(x, toX), Math.max(y, toY), 'accent');
  },
  text(desk) {
    const [x, y, toX, toY] = desk.aim;
    const numbers = [Math.min(x, toX), Math.min(y, toY), Math.max(x, toX), Math.max(y, toY)].map(short).join(', ');
    const options = desk.within ? `{ within: true${desk.mask === 7 ? '' : `, mask: ${desk.mask}`} }` : maskText(desk);
    return `space.queryBox(${join(numbers, options)});\n// ${list(ids)}`;
  },
};

const point: Ask = {
  name: 'point',
  label: 'Point',
  hint: 'Put the point on a box, or where boxes overlap.',
  counts: 'Boxes that contain it',
  options: ['mask'],
  ask({ space, aim, mask }) {
    idsOptions.mask = mask;
    space.queryPoint(aim[2], aim[3], idsOptions);
  },
  mark: markIds,
  draw({ pen, aim }) {
    pen.dot(aim[2], aim[3], 5, 'accent');
  },
  text(desk) {
    const { aim } = desk;
    return `space.queryPoint(${join(short(aim[2]), short(aim[3]), maskText(desk))});\n// ${list(ids)}`;
  },
};

const circle: Ask = {
  name: 'circle',
  label: 'Circle',
  hint: 'Drag the circle: an explosion, or how far someone can hear.',
  counts: 'Boxes that it touches',
  options: ['radius', 'mask'],
  ask({ space, aim, radius, mask }) {
    idsOptions.mask = mask;
    space.queryCircle(aim[2], aim[3], radius, idsOptions);
  },
  mark: markIds,
  draw({ pen, aim, radius }) {
    pen.circle(aim[2], aim[3], radius, 'accent');
  },
  text(desk) {
    const { aim, radius } = desk;
    return `space.queryCircle(${join(short(aim[2]), short(aim[3]), short(radius), maskText(desk))});\n// ${list(ids)}`;
  },
};

const rayCast: Ask = {
  name: 'ray',
  label: 'Ray',
  hint: 'Drag from where the ray begins to where it aims.',
  counts: 'Boxes that it hits',
  options: ['all', 'mask'],
  ask({ space, aim, all, mask }) {
    const [x, y, toX, toY] = aim;
    ray = undefined;
    rays.length = 0;
    raysOptions.mask = rayOptions.mask = mask;
    if (all) space.rayCastAll(x, y, toX - x, toY - y, raysOptions);
    else ray = space.rayCast(x, y, toX - x, toY - y, rayOptions);
  },
  mark({ slots }) {
    for (let n = 0; n < rays.length; n++) slots[rays[n].id] = n === 0 ? first : found;
    if (ray) slots[ray.id] = first;
    return ray ? 1 : rays.length;
  },
  draw({ pen, aim: [x, y, toX, toY], all, world }) {
    const length = Math.hypot(toX - x, toY - y) || 1;
    const [dx, dy] = [(toX - x) / length, (toY - y) / length];
    const end = all || !ray ? 4 * world : ray.distance;
    pen.line(x, y, x + dx * end, y + dy * end, 'accent');
    if (!all && ray) pen.line(x + dx * end, y + dy * end, x + 4 * dx * world, y + 4 * dy * world, 'faint', true);
    const count = all ? rays.length : ray ? 1 : 0;
    for (let n = 0; n < count; n++) {
      const { distance, normal } = all ? rays[n] : ray!;
      pen.arrow(x + dx * distance, y + dy * distance, normal[0], normal[1], 26, 'text');
      pen.dot(x + dx * distance, y + dy * distance, 4, 'text');
    }
    pen.dot(x, y, 5, 'accent');
  },
  text(desk) {
    const [x, y, toX, toY] = desk.aim;
    const given = join([x, y, toX - x, toY - y].map(short).join(', '), maskText(desk));
    const one = ({ id, distance, normal }: RayHit) =>
      `{ id: ${id}, distance: ${short(distance)}, normal: [${normal.join(', ')}] }`;
    if (!desk.all) return `space.rayCast(${given});\n// ${ray ? one(ray) : 'undefined'}`;
    const rest = rays.length > 3 ? `,\n//   … ${rays.length - 3} more]` : ']';
    return `space.rayCastAll(${given});\n// [${rays.slice(0, 3).map(one).join(',\n//  ')}${rest}`;
  },
};

/** The side of the swept box, as a share of the world. */
const sweptSide = 0.05;

const sweep: Ask = {
  name: 'sweep',
  label: 'Sweep',
  hint: 'Drag from where the box is to where it goes within one frame: it stops at the first box it hits.',
  counts: 'Boxes met first',
  options: ['mask'],
  ask({ space, aim, mask, world }) {
    const [x, y, toX, toY] = aim;
    const half = (sweptSide * world) / 2;
    sweepOptions.mask = mask;
    met = space.sweep(x - half, y - half, x + half, y + half, toX - x, toY - y, sweepOptions);
  },
  mark({ slots }) {
    if (met) slots[met.id] = first;
    return met ? 1 : 0;
  },
  draw({ pen, aim: [x, y, toX, toY], world }) {
    const half = (sweptSide * world) / 2;
    pen.line(x, y, toX, toY, 'accent', true);
    pen.box(x - half, y - half, x + half, y + half, 'accent');
    pen.box(toX - half, toY - half, toX + half, toY + half, 'faint', true);
    if (!met) return;
    const atX = x + met.time * (toX - x);
    const atY = y + met.time * (toY - y);
    pen.box(atX - half, atY - half, atX + half, atY + half, 'text');
    const [nx, ny] = met.normal;
    pen.arrow(atX - nx * half, atY - ny * half, nx, ny, 30, 'text');
  },
  text(desk) {
    const [x, y, toX, toY] = desk.aim;
    const half = (sweptSide * desk.world) / 2;
    const given = [x - half, y - half, x + half, y + half, toX - x, toY - y].map(short).join(', ');
    const answer = met
      ? `{ id: ${met.id}, time: ${met.time.toFixed(3)}, normal: [${met.normal.join(', ')}] }`
      : 'undefined';
    return `space.sweep(${join(given, maskText(desk))});\n// ${answer}`;
  },
};

const nearestOptions = { out: ids, mask: 7 };

const nearest: Ask = {
  name: 'nearest',
  label: 'Nearest',
  hint: 'Move the point: the boxes nearest to it, by their edges, are found in order.',
  counts: 'Boxes found',
  options: ['k', 'mask'],
  ask({ space, aim, k, mask }) {
    nearestOptions.mask = mask;
    space.nearest(aim[2], aim[3], k, nearestOptions);
  },
  mark(desk) {
    markIds(desk);
    if (ids.length > 0) desk.slots[ids[0]] = first;
    return ids.length;
  },
  draw({ pen, aim, boxes }) {
    const [, , x, y] = aim;
    for (let n = 0; n < ids.length; n++) {
      const at = 4 * ids[n];
      const toX = Math.min(boxes[at + 2], Math.max(boxes[at], x));
      const toY = Math.min(boxes[at + 3], Math.max(boxes[at + 1], y));
      pen.line(x, y, toX, toY, n === 0 ? 'text' : 'faint');
    }
    pen.dot(x, y, 5, 'accent');
  },
  text(desk) {
    const { aim, k } = desk;
    return `space.nearest(${join(short(aim[2]), short(aim[3]), String(k), maskText(desk))});\n// ${list(ids)}`;
  },
};

let chosen = -1;

const partners: Ask = {
  name: 'partners',
  label: 'Partners',
  hint: 'Choose a box: which boxes is it in a pair with?',
  counts: 'Boxes in a pair with it',
  options: [],
  prepare({ space, aim, aimed }) {
    // The chosen box stays chosen while it moves.
    if (aimed) [chosen = -1] = space.nearest(aim[2], aim[3], 1, { out: ids });
    if (chosen >= 0 && !space.has(chosen)) chosen = -1;
  },
  ask({ space }) {
    ids.length = 0;
    if (chosen >= 0) space.collisionsOf(chosen, ids);
  },
  mark(desk) {
    markIds(desk);
    if (chosen >= 0) desk.slots[chosen] = first;
    return ids.length;
  },
  draw({ pen, boxes }) {
    if (chosen >= 0)
      pen.box(boxes[4 * chosen], boxes[4 * chosen + 1], boxes[4 * chosen + 2], boxes[4 * chosen + 3], 'text');
  },
  text({ space }) {
    if (chosen < 0) return '// no box is chosen';
    const other = ids[0] ?? (chosen === 0 ? 1 : 0);
    const calls = `space.collisionsOf(${chosen});\n// ${list(ids)}`;
    return `${calls}\nspace.isColliding(${chosen}, ${other});\n// ${space.isColliding(chosen, other)}`;
  },
};

/** Per box, the remaining frames of its flash; negative if its pair has ended. */
let flashes = new Int8Array();

/** Half the size of the ring or the cross in a box, as a share of its width. */
const markReach = 0.25;

const events: Ask = {
  name: 'events',
  label: 'Began, ended',
  hint: 'Green with a ring where a pair began, red with a cross where one ended.',
  counts: 'Began and ended in this frame',
  options: [],
  mark({ space, slots }) {
    if (flashes.length !== slots.length) flashes = new Int8Array(slots.length);
    const { began, ended } = space;
    for (let k = 0; k < ended.length; k++) flashes[ended[k]] = -flash;
    for (let k = 0; k < began.length; k++) flashes[began[k]] = flash;
    for (let id = 0; id < flashes.length; id++) {
      const left = flashes[id];
      if (left === 0) continue;
      const shade = Math.ceil((Math.abs(left) * shades) / flash) - 1;
      slots[id] = hueSlot(left > 0 ? fresh : gone, shade);
      flashes[id] -= Math.sign(left);
    }
    return (began.length + ended.length) / 2;
  },
  draw({ pen, boxes }) {
    for (let id = 0; id < flashes.length; id++) {
      if (flashes[id] === 0) continue;
      const at = 4 * id;
      const x = (boxes[at] + boxes[at + 2]) / 2;
      const y = (boxes[at + 1] + boxes[at + 3]) / 2;
      const reach = markReach * (boxes[at + 2] - boxes[at]);
      if (flashes[id] > 0) pen.circle(x, y, reach, 'text');
      else {
        pen.line(x - reach, y - reach, x + reach, y + reach, 'text');
        pen.line(x - reach, y + reach, x + reach, y - reach, 'text');
      }
    }
  },
  text({ space }) {
    return `new BroadPhase({ events: true });\nspace.update();\nspace.began; // [${space.began.subarray(0, 10).join(', ')}]\nspace.ended; // [${space.ended.subarray(0, 10).join(', ')}]`;
  },
};

/** Hues of the three layers. */
const layerHue = [8, 2, 10];

const filters: Ask = {
  name: 'filters',
  label: 'Filters',
  hint: 'Three layers: choose which of them meet. Boxes in a pair are strong, the others faint.',
  counts: 'Pairs',
  options: ['meet'],
  mark({ space, slots }) {
    for (let id = 0; id < slots.length; id++) slots[id] = hueSlot(layerHue[id % 3], 0);
    const { pairs } = space;
    for (let k = 0; k < pairs.length; k++) slots[pairs[k]] = hueSlot(layerHue[pairs[k] % 3]);
    return pairs.length / 2;
  },
  draw() {},
  text({ space }) {
    const masks = [0, 1, 2].map((layer) => `space.setFilter(${layer}, ${1 << layer}, ${maskOf(layer)});`);
    return `${masks.join('\n')}\n// … 3 as 0, 4 as 1 …\nspace.update().pairCount; // ${space.pairCount}`;
  },
};

const masks = [7, 7, 7];
const maskOf = (layer: number) => masks[layer];

/** Gives every box its layer, and the layers that it meets. */
export function setLayers(space: BroadPhase<2 | 3>, count: number, meets: readonly number[]): void {
  for (let layer = 0; layer < 3; layer++) masks[layer] = meets[layer];
  for (let id = 0; id < count; id++) space.setFilter(id, 1 << (id % 3), masks[id % 3]);
}

export const asks: readonly Ask[] = [
  box,
  point,
  circle,
  view,
  rayCast,
  fan,
  sweep,
  nearest,
  partners,
  spaces,
  events,
  filters,
  debug,
];

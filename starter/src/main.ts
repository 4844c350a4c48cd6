// A ship, bullets and rocks: broadphase finds which of them meet. Change anything, and the page reloads.
import { BroadPhase } from 'broadphase';

/** Layers: what a thing is. Its mask says what it meets. */
const ship = 1;
const bullet = 2;
const rock = 4;
const masks: Record<number, number> = { [ship]: rock, [bullet]: rock, [rock]: ship | bullet };
const colors: Record<number, string> = { [ship]: '#4f8ef7', [bullet]: '#f7c948', [rock]: '#9aa5b1' };

type Thing = Record<'layer' | 'x' | 'y' | 'dx' | 'dy' | 'size', number>;

const canvas = document.querySelector('canvas')!;
const context = canvas.getContext('2d')!;
const space = new BroadPhase({ events: true });
const things: (Thing | undefined)[] = []; // the index of a thing is the id of its box
const keys = new Set<string>();
let player: Thing;
let score = 0;
let frame = 0;

function add(layer: number, x: number, y: number, dx: number, dy: number, size: number): Thing {
  let id = things.indexOf(undefined); // free indices are reused
  if (id < 0) id = things.length;
  const thing = { layer, x, y, dx, dy, size };
  things[id] = thing;
  space.setCentred(id, x, y, size / 2, size / 2).setFilter(id, layer, masks[layer]);
  return thing;
}

function remove(id: number): void {
  things[id] = undefined;
  space.delete(id);
}

function restart(): void {
  things.length = 0;
  space.clear();
  score = 0;
  player = add(ship, canvas.width / 2, canvas.height - 50, 0, 0, 24);
}

function move(): void {
  const { width, height } = canvas;
  player.dx = 6 * (Number(keys.has('ArrowRight')) - Number(keys.has('ArrowLeft')));
  if (frame % 8 === 0) add(bullet, player.x, player.y - 20, 0, -9, 6);
  if (frame % 12 === 0) add(rock, Math.random() * width, -20, Math.random() - 0.5, 1 + 2 * Math.random(), 34);
  things.forEach((thing, id) => {
    if (!thing) return;
    thing.x += thing.dx;
    thing.y += thing.dy;
    if (thing === player) thing.x = Math.min(width - 12, Math.max(12, thing.x));
    space.setCentred(id, thing.x, thing.y, thing.size / 2, thing.size / 2);
    if (thing.y < -50 || thing.y > height + 50) remove(id);
  });
}

function collide(): void {
  const { began } = space.update(); // the new pairs, [a, b, a, b, …]
  for (let k = 0; k < began.length; k += 2) {
    const [a, b] = [things[began[k]], things[began[k + 1]]];
    if (!a || !b) continue; // already hit by another bullet in this frame
    if (a === player || b === player) {
      restart();
      return;
    }
    score++;
    for (const id of [began[k], began[k + 1]]) remove(id);
  }
}

function draw(): void {
  context.clearRect(0, 0, canvas.width, canvas.height);
  for (const thing of things) {
    if (!thing) continue;
    context.fillStyle = colors[thing.layer];
    context.fillRect(thing.x - thing.size / 2, thing.y - thing.size / 2, thing.size, thing.size);
  }
  context.fillStyle = '#ffffff';
  context.fillText(`${score} hit · arrow keys, or point`, 12, 22);
}

addEventListener('keydown', ({ key }) => keys.add(key));
addEventListener('keyup', ({ key }) => keys.delete(key));
canvas.addEventListener('pointermove', ({ offsetX }) => {
  player.x = (offsetX / canvas.clientWidth) * canvas.width;
});
context.font = '16px system-ui, sans-serif';

restart();
requestAnimationFrame(function next(now) {
  const due = Math.floor(now * 0.06); // 60 steps a second on every display; after a pause, at most 5 at once
  for (frame = Math.max(frame, due - 5); frame < due; frame++) {
    move();
    collide();
  }
  draw();
  requestAnimationFrame(next);
});

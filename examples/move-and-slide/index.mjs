// A walker in a world of tiles, drawn as text: it falls along a wall, lands, walks, jumps a step and stops in a corner.
// npm i && npm start
import { BroadPhase } from 'broadphase';
import { moveAndSlide } from './move-and-slide.mjs';

const rows = [
  '#..............................#',
  '#..............................#',
  '#..............................#',
  '#..............................#',
  '#..................####........#',
  '#..................####........#',
  '################################',
];
const tile = 16;
const space = new BroadPhase();
rows.forEach((row, y) => {
  [...row].forEach((letter, x) => {
    const id = y * row.length + x;
    if (letter === '#') space.set(id, x * tile, y * tile, (x + 1) * tile, (y + 1) * tile).setStatic(id);
  });
});
space.update();

const walker = { position: [tile, 0], size: [12, 24] };
const velocity = [0, 0];
const met = [0, 0];
for (let step = 0; step <= 240; step++) {
  const onFloor = met[1] === -1;
  velocity[0] = step < 30 ? -2 : 2; // first it presses against the wall
  velocity[1] = onFloor ? 0.4 : velocity[1] + 0.4;
  if (onFloor && met[0] === -1) velocity[1] = -8; // jumps over a step in the way
  moveAndSlide(space, walker, velocity, undefined, met);
  if (met[1] === 1) velocity[1] = 0; // hits its head
  if (step % 30 !== 0) continue;
  const [x, y] = walker.position;
  console.log(`step ${step}: at ${x.toFixed(2)}, ${y.toFixed(2)}; it met [${met.join(', ')}]`);
  const [column, row] = [Math.floor((x + 6) / tile), Math.floor((y + 12) / tile)];
  console.log(
    rows.map((line, k) => (k === row ? line.slice(0, column) + '@' + line.slice(column + 1) : line)).join('\n'),
  );
}

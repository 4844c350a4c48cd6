// The game without graphics: ships drift and fire. A bullet that hits a ship is fired again by that ship. Ship 0 is
// yours. All data are arrays by id: ships first, then bullets.
import { BroadPhase } from 'broadphase';

const ship = 1;
const bullet = 2;
const bulletRadius = 2;
/** Pixels per frame. */
const bulletSpeed = 2;
const shipSpeed = 0.5;
/** Radians between two shots of a ship: the golden angle, so that they form spirals. */
const spiral = Math.PI * (3 - Math.sqrt(5));

export class Bullets {
  constructor(ships, bullets, width, height) {
    this.ships = ships;
    this.count = ships + bullets;
    this.width = width;
    this.height = height;
    this.x = new Float32Array(this.count);
    this.y = new Float32Array(this.count);
    this.radius = new Float32Array(this.count).fill(bulletRadius);
    /** Who fired it. */
    this.owner = new Uint16Array(this.count);
    /** How brightly a ship glows from its hits, 0 to 1. */
    this.glow = new Float32Array(ships);
    this.caught = 0;
    this.vx = new Float32Array(this.count);
    this.vy = new Float32Array(this.count);
    this.shots = 0;
    this.space = new BroadPhase();
    /** The pairs found: a, b, a, b …, the ship first. */
    this.pairs = this.space.pairs;

    for (let id = 0; id < ships; id++) {
      this.radius[id] = id === 0 ? 64 : 14 + 14 * Math.random();
      this.x[id] = width * Math.random();
      this.y[id] = height * Math.random();
      const angle = 2 * Math.PI * Math.random();
      this.vx[id] = shipSpeed * Math.cos(angle);
      this.vy[id] = shipSpeed * Math.sin(angle);
    }
    [this.x[0], this.y[0], this.vx[0], this.vy[0]] = [width / 2, height / 2, 0, 0];
    for (let id = ships; id < this.count; id++) {
      this.fire(id, id % ships);
      const way = 150 * Math.random();
      this.x[id] += way * this.vx[id];
      this.y[id] += way * this.vy[id];
    }
    this.place();
    for (let id = 0; id < ships; id++) this.space.setFilter(id, ship, ship | bullet);
    for (let id = ships; id < this.count; id++) this.space.setFilter(id, bullet, ship); // bullets do not meet bullets
  }

  /** Puts a moving bullet beside a ship. */
  fire(id, from) {
    const angle = spiral * this.shots++;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const reach = this.radius[from] + 2 * bulletRadius;
    this.owner[id] = from;
    this.x[id] = this.x[from] + reach * cos;
    this.y[id] = this.y[from] + reach * sin;
    this.vx[id] = bulletSpeed * cos;
    this.vy[id] = bulletSpeed * sin;
  }

  /** Moves everything by a number of frames of a sixtieth of a second. */
  move(frames) {
    const { ships, width, height, x, y, vx, vy } = this;
    for (let id = 0; id < this.count; id++) {
      x[id] += frames * vx[id];
      y[id] += frames * vy[id];
      const outX = x[id] < 0 || x[id] > width;
      const outY = y[id] < 0 || y[id] > height;
      if (!outX && !outY) continue;
      if (id >= ships) this.fire(id, 1 + (id % (ships - 1)));
      else {
        x[id] = Math.min(width, Math.max(0, x[id]));
        y[id] = Math.min(height, Math.max(0, y[id]));
        if (outX) vx[id] *= -1;
        if (outY) vy[id] *= -1;
      }
    }
    for (let id = 0; id < ships; id++) this.glow[id] *= 0.93 ** frames;
  }

  /** Writes the boxes straight into the memory of the space. */
  place() {
    const { count, x, y, radius } = this;
    const boxes = this.space.boxes(count);
    for (let id = 0; id < count; id++) {
      boxes[4 * id] = x[id] - radius[id];
      boxes[4 * id + 1] = y[id] - radius[id];
      boxes[4 * id + 2] = x[id] + radius[id];
      boxes[4 * id + 3] = y[id] + radius[id];
    }
    return boxes;
  }

  find() {
    this.place();
    this.pairs = this.space.update().pairs;
  }

  /** The same without broadphase: every ship against everything. */
  findByPlainLoops() {
    const boxes = this.place();
    const found = [];
    for (let a = 0; a < this.ships; a++) {
      const [minX, minY, maxX, maxY] = boxes.subarray(4 * a, 4 * a + 4);
      for (let b = a + 1; b < this.count; b++) {
        const k = 4 * b;
        if (boxes[k] <= maxX && boxes[k + 2] >= minX && boxes[k + 1] <= maxY && boxes[k + 3] >= minY) found.push(a, b);
      }
    }
    this.pairs = found;
  }

  /** Reacts to overlapping boxes: ships push each other away, and a bullet that really touches a ship has hit it. */
  collide() {
    const { ships, pairs, x, y, radius } = this;
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [pairs[k], pairs[k + 1]];
      const [dx, dy] = [x[b] - x[a], y[b] - y[a]];
      const distance = Math.hypot(dx, dy);
      const over = radius[a] + radius[b] - distance;
      if (over <= 0) continue;
      if (b >= ships) {
        this.glow[a] = Math.min(1, this.glow[a] + 0.25);
        if (a === 0) this.caught++;
        this.fire(b, a === 0 ? 1 + (b % (ships - 1)) : a);
      } else if (distance > 0) {
        const push = over / distance / (a === 0 ? 1 : 2);
        x[b] += push * dx;
        y[b] += push * dy;
        if (a !== 0) {
          x[a] -= push * dx;
          y[a] -= push * dy;
        }
      }
    }
  }
}

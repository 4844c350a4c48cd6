// A drop-in broad phase for Planck (Box2D), in place of its dynamic tree:
//   useBroadPhase(world), before anything is put into the world.
// Like Planck's own, it uses fat boxes, so that small motions do not move them.
import { BroadPhase } from 'broadphase';

/** Planck's own margin, in metres, and how far a box reaches ahead of a moving body. */
const margin = 0.1;
const ahead = 2;

/** @param {import('planck').World} world an empty one */
export function useBroadPhase(world) {
  if (world.getBodyList()) throw new Error('useBroadPhase: the world has bodies, expected an empty one');
  world.m_broadPhase = new PlanckBroadPhase();
}

class PlanckBroadPhase {
  #space = new BroadPhase();
  #users = [];
  #free = [];
  /** Per proxy, its fat box: minX, minY, maxX, maxY. */
  #boxes = [];
  /** Per proxy, whether its pairs have to be reported again. */
  #moved = [];
  #changed = false;

  createProxy(aabb, user) {
    const proxy = this.#free.pop() ?? this.#users.length;
    this.#users[proxy] = user;
    this.#put(proxy, aabb, 0, 0);
    return proxy;
  }

  destroyProxy(proxy) {
    this.#space.delete(proxy);
    this.#users[proxy] = undefined;
    this.#moved[proxy] = false;
    this.#changed = true;
    this.#free.push(proxy);
  }

  moveProxy(proxy, aabb, displacement) {
    const at = 4 * proxy;
    const boxes = this.#boxes;
    const { lowerBound, upperBound } = aabb;
    const inside =
      boxes[at] <= lowerBound.x &&
      boxes[at + 1] <= lowerBound.y &&
      upperBound.x <= boxes[at + 2] &&
      upperBound.y <= boxes[at + 3];
    if (!inside) this.#put(proxy, aabb, ahead * displacement.x, ahead * displacement.y);
  }

  #put(proxy, { lowerBound, upperBound }, dx, dy) {
    const at = 4 * proxy;
    const boxes = this.#boxes;
    boxes[at] = lowerBound.x - margin + Math.min(0, dx);
    boxes[at + 1] = lowerBound.y - margin + Math.min(0, dy);
    boxes[at + 2] = upperBound.x + margin + Math.max(0, dx);
    boxes[at + 3] = upperBound.y + margin + Math.max(0, dy);
    this.#space.set(proxy, boxes[at], boxes[at + 1], boxes[at + 2], boxes[at + 3]);
    this.touchProxy(proxy);
  }

  touchProxy(proxy) {
    this.#moved[proxy] = true;
    this.#changed = true;
  }

  /** Reports every pair with a proxy that has moved; Planck knows which contacts it has already. */
  updatePairs(tell) {
    this.#update();
    const moved = this.#moved;
    const { pairs } = this.#space;
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [pairs[k], pairs[k + 1]];
      if (moved[a] || moved[b]) tell(this.#users[a], this.#users[b]);
    }
    moved.fill(false);
  }

  #update() {
    if (this.#changed) this.#space.update();
    this.#changed = false;
  }

  getUserData(proxy) {
    return this.#users[proxy];
  }

  getFatAABB(proxy) {
    const [minX, minY, maxX, maxY] = this.#boxes.slice(4 * proxy, 4 * proxy + 4);
    return { lowerBound: { x: minX, y: minY }, upperBound: { x: maxX, y: maxY } };
  }

  testOverlap(a, b) {
    const boxes = this.#boxes;
    const [i, j] = [4 * a, 4 * b];
    return (
      boxes[i] <= boxes[j + 2] &&
      boxes[j] <= boxes[i + 2] &&
      boxes[i + 1] <= boxes[j + 3] &&
      boxes[j + 1] <= boxes[i + 3]
    );
  }

  query({ lowerBound, upperBound }, visit) {
    this.#update();
    this.#space.queryBox(lowerBound.x, lowerBound.y, upperBound.x, upperBound.y, { visit });
  }

  /** In order along the ray, so that it can end at the first hit that shortens it. */
  rayCast({ p1, p2, maxFraction }, hit) {
    this.#update();
    const [dx, dy] = [p2.x - p1.x, p2.y - p1.y];
    const length = Math.hypot(dx, dy);
    let most = maxFraction;
    const visit = (proxy, distance) => {
      if (distance > most * length) return false;
      const answer = hit({ p1, p2, maxFraction: most }, proxy);
      if (answer > 0) most = answer;
      return answer !== 0;
    };
    this.#space.rayCastAll(p1.x, p1.y, dx, dy, { maxDistance: most * length, visit });
  }

  getProxyCount() {
    return this.#space.size;
  }
  getTreeHeight() {
    return 0;
  }
  getTreeBalance() {
    return 0;
  }
  getTreeQuality() {
    return 0;
  }

  shiftOrigin({ x, y }) {
    const boxes = this.#boxes;
    for (const [proxy, user] of this.#users.entries()) {
      if (user === undefined) continue;
      const at = 4 * proxy;
      for (let k = 0; k < 4; k++) boxes[at + k] -= k % 2 ? y : x;
      this.#space.set(proxy, boxes[at], boxes[at + 1], boxes[at + 2], boxes[at + 3]);
    }
    this.#changed = true;
  }
}

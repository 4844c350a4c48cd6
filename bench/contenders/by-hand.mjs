// Three ways to find pairs that people write themselves, in plain JavaScript of the usual quality. Each reads both
// objects of a pair when it is found; `collect` gathers the pairs when results are compared.

const overlap = (a, b) =>
  a.x <= b.x + b.width && b.x <= a.x + a.width && a.y <= b.y + b.height && b.y <= a.y + a.height;

/** Tests each against all after it. */
export function everyPair(things, collect) {
  let sum = 0;
  for (let i = 0; i < things.length; i++) {
    const a = things[i];
    for (let j = i + 1; j < things.length; j++) {
      const b = things[j];
      if (!overlap(a, b)) continue;
      sum += a.id ^ b.id;
      collect?.add(a.id, b.id);
    }
  }
  return sum;
}

/** Insertion sort along x: the order of the last frame is kept, so little is left to sort. */
export class SortAndSweep {
  #order;

  find(things, collect) {
    this.#order ??= [...things].sort((a, b) => a.x - b.x);
    const order = this.#order;
    for (let i = 1; i < order.length; i++) {
      const thing = order[i];
      let j = i - 1;
      for (; j >= 0 && order[j].x > thing.x; j--) order[j + 1] = order[j];
      order[j + 1] = thing;
    }
    let sum = 0;
    for (let i = 0; i < order.length; i++) {
      const a = order[i];
      const end = a.x + a.width;
      for (let j = i + 1; j < order.length && order[j].x <= end; j++) {
        const b = order[j];
        if (a.y > b.y + b.height || b.y > a.y + a.height) continue;
        sum += a.id ^ b.id;
        collect?.add(a.id, b.id);
      }
    }
    return sum;
  }
}

/** Cells twice as wide as a thing, in a new Map each frame. */
export class Grid {
  #side;

  find(things, collect) {
    this.#side ??= (2 * things.reduce((sum, { width }) => sum + width, 0)) / things.length;
    const side = this.#side;
    const cells = new Map();
    let sum = 0;
    for (const a of things) {
      const [left, right] = [Math.floor(a.x / side), Math.floor((a.x + a.width) / side)];
      const [top, bottom] = [Math.floor(a.y / side), Math.floor((a.y + a.height) / side)];
      for (let x = left; x <= right; x++) {
        for (let y = top; y <= bottom; y++) {
          const key = x * 100_003 + y;
          const cell = cells.get(key);
          if (!cell) {
            cells.set(key, [a]);
            continue;
          }
          for (const b of cell) {
            if (!overlap(a, b)) continue;
            // Two things may share several cells: the one with the larger of their corners counts.
            if (Math.floor(Math.max(a.x, b.x) / side) !== x || Math.floor(Math.max(a.y, b.y) / side) !== y) continue;
            sum += a.id ^ b.id;
            collect?.add(a.id, b.id);
          }
          cell.push(a);
        }
      }
    }
    return sum;
  }
}

// What broadphase/draw draws: each shape where it stands, nothing without an end, and nothing left behind on a canvas.
import { BroadPhase, type TechniqueName } from 'broadphase';
import { boxesInCells, drawSpace, Lines } from 'broadphase/draw';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

const pointsOf = (lines: Lines) => [...lines.points()];

/** Edges as text, each once, so that their order makes no difference. */
function edges(lines: Lines): string[] {
  const points = pointsOf(lines);
  const width = lines.dimensions;
  const texts: string[] = [];
  for (let k = 0; k < points.length; k += 2 * width) {
    const ends = [points.slice(k, k + width).join(), points.slice(k + width, k + 2 * width).join()];
    texts.push(ends.sort().join(' - '));
  }
  return texts.sort();
}

function crowd(dimensions: 2 | 3, technique: TechniqueName, count = 300) {
  const random = createRandom(42);
  const space = new BroadPhase<2 | 3>({ dimensions, technique });
  const boxes: number[] = [];
  for (let id = 0; id < count; id++) {
    const min = Array.from({ length: dimensions }, () => 100 * random());
    boxes.push(...min, ...min.map((value) => value + 4 * random()));
  }
  return space.setAll(boxes).update();
}

describe('Lines', () => {
  test('has the four edges of a box', () => {
    const lines = new Lines().addBoxes(new BroadPhase().set(7, 1, 2, 3, 5));
    expect(edges(lines)).toEqual(['1,2 - 1,5', '1,2 - 3,2', '1,5 - 3,5', '3,2 - 3,5']);
  });

  test('has the twelve edges of a box in space, each along one axis', () => {
    const lines = new Lines(3).addBoxes(new BroadPhase({ dimensions: 3 }).set(7, 0, 0, 0, 1, 2, 3));
    const found = edges(lines);
    expect(new Set(found).size).toBe(12);
    const lengths = found.map((edge) => {
      const [a, b] = edge.split(' - ').map((end) => end.split(',').map(Number));
      return a!.reduce((sum, value, axis) => sum + Math.abs(value - b![axis]!), 0);
    });
    expect(lengths.sort()).toEqual([1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3]);
  });

  test('has a line for each pair, and forgets all when cleared', () => {
    const space = crowd(2, 'auto');
    const lines = new Lines().addPairs(space);
    expect(space.pairCount).toBeGreaterThan(0);
    expect(lines.length).toBe(4 * space.pairCount);
    const { data } = lines;
    expect(lines.clear().length).toBe(0);
    expect(lines.addPairs(space).data).toBe(data);
  });

  test('grows, and keeps what it has', () => {
    const space = crowd(2, 'auto', 2000);
    const lines = new Lines().addBoxes(space);
    expect(lines.length).toBe(2000 * 16);
    const [minX, minY] = space.get(0)!;
    expect(pointsOf(lines).slice(0, 2)).toEqual([Math.fround(minX!), Math.fround(minY!)]);
  });

  test('leaves out the pair of a box that is gone', () => {
    const space = new BroadPhase().set(1, 0, 0, 2, 2).set(2, 1, 1, 3, 3).set(3, 1, 1, 3, 3).update();
    expect(new Lines().addPairs(space).length).toBe(12);
    space.delete(3);
    expect(new Lines().addPairs(space).length).toBe(4);
    expect(new Lines().addTouching(space).length).toBe(32);
  });

  test('cuts boxes without an end where the finite ones end', () => {
    const space = new BroadPhase().set(1, 0, 0, 10, 20).set(2, 5, -Infinity, Infinity, Infinity).update();
    const lines = new Lines().addBoxes(space).addPairs(space).addCells(space);
    expect(lines.points().every(Number.isFinite)).toBe(true);
    expect(edges(lines)).toContain('5,0 - 5,20');
  });

  test('draws a ray as far as it gets', () => {
    const space = new BroadPhase().set(7, 10, -1, 12, 1).update();
    const [x, y, toX, toY, , , normalX, normalY] = pointsOf(new Lines().addRay(space, [0, 0, 2, 0]));
    expect([x, y, toX, toY]).toEqual([0, 0, 10, 0]);
    expect(normalY).toBe(0);
    expect(pointsOf(new Lines().addRay(space, [0, 0, 2, 0, 4]))).toEqual([0, 0, 4, 0]);
    // The bounds of the box and the ray's origin have this diameter.
    const reach = Math.hypot(12, 2);
    expect(normalX).toBeCloseTo(10 - 0.03 * reach, 5);
    const away = pointsOf(new Lines().addRay(space, [0, 0, -1, 0]));
    expect(away.length).toBe(4);
    expect(away[2]).toBeCloseTo(-2 * reach, 5);
    expect(pointsOf(new Lines().addRay(space, [3, 4, 0, 0]))).toEqual([3, 4, 3, 4]);
  });

  test('says what is wrong, and keeps its lines', () => {
    const lines = new Lines().addBoxes(new BroadPhase().set(7, 0, 0, 1, 1));
    expect(() => lines.addRay(new BroadPhase(), [0, 0, 1])).toThrow('addRay: got [0, 0, 1], expected 4 finite numbers');
    expect(() => lines.addRay(new BroadPhase().update(), [0, 0, Number.NaN, 1])).toThrow(RangeError);
    expect(() => lines.addPairs(crowd(3, 'auto'))).toThrow('addPairs: got a space of 3 dimensions, expected 2');
    expect(() => new Lines(4 as 2)).toThrow('new Lines: got 4, expected 2 or 3 dimensions');
    expect(lines.length).toBe(16);
  });
});

test('the room for lines is one of whole segments, also after it has grown', () => {
  for (const dimensions of [2, 3] as const) {
    const lines = new Lines(dimensions);
    for (const count of [1, 300]) {
      lines.addBoxes(crowd(dimensions, 'brute-force', count));
      expect(lines.data.length % (2 * dimensions)).toBe(0);
    }
  }
});

describe('boxesInCells', () => {
  /** The smallest cell that holds the lower corner of each box, by looking at all. */
  function plain(space: BroadPhase<2 | 3>): number[] {
    const { dimensions } = space;
    const cells = space.structure().slice();
    const count = cells.length / (2 * dimensions);
    const held = new Array(count).fill(0);
    for (const [, box] of space) {
      let home = -1;
      let smallest = Infinity;
      for (let cell = 0; cell < count; cell++) {
        const numbers = cells.subarray(2 * dimensions * cell, 2 * dimensions * (cell + 1));
        let size = 1;
        let holds = true;
        for (let axis = 0; axis < dimensions; axis++) {
          const [low, high] = [numbers[axis]!, numbers[axis + dimensions]!];
          holds &&= low <= box[axis]! && box[axis]! <= high;
          size *= high - low;
        }
        if (holds && size < smallest) [home, smallest] = [cell, size];
      }
      if (home >= 0) held[home]++;
    }
    return held;
  }

  test('has room for a tree of 100,000 boxes, whose nodes lie in one another', { tags: 'long' }, () => {
    const space = crowd(2, 'aabb-tree', 100_000);
    const held = boxesInCells(space);
    expect(held.length).toBe(space.structure().length / 4);
    expect(held.reduce((a, b) => a + b, 0)).toBe(100_000);
  });

  test('counts boxes without an end', () => {
    const space = new BroadPhase({ technique: 'strip-sweep' });
    space.set(7, -Infinity, -Infinity, Infinity, Infinity).set(9, 5, 5, 15, 15).set(11, 5, -Infinity, 9, 9).update();
    expect([...boxesInCells(space)]).toEqual(plain(space));
    expect(boxesInCells(new BroadPhase({ technique: 'strip-sweep' }).update())).toHaveLength(0);
  });

  for (const technique of BroadPhase.techniques) {
    for (const dimensions of [2, 3] as const) {
      test(`counts each box once: ${technique}, ${dimensions}D`, () => {
        const space = crowd(dimensions, technique);
        const held = boxesInCells(space);
        const expected = plain(space);
        const sum = (numbers: Iterable<number>) => [...numbers].reduce((a, b) => a + b, 0);
        expect(sum(held)).toBe(sum(expected));
        // Where a corner is in two cells of one size, either counts it.
        const apart = expected.filter((boxes, cell) => boxes !== held[cell]).length;
        expect(apart).toBeLessThan(0.02 * expected.length + 1);
        expect(space.pairCount).toBe(crowd(dimensions, 'brute-force').pairCount);
      });
    }
  }
});

/** A context that notes what is called, and has the state that is saved. */
function fakeContext() {
  const calls: string[] = [];
  const state = { strokeStyle: 'before', fillStyle: 'before', globalAlpha: 1, lineWidth: 3 };
  const saved: (typeof state)[] = [];
  const note =
    (name: string) =>
    (...numbers: number[]) => {
      calls.push(`${name} ${numbers.join()}`.trim());
    };
  const context = {
    ...state,
    getTransform: () => 'world',
    setTransform: note('setTransform'),
    setLineDash: note('setLineDash'),
    beginPath: note('beginPath'),
    rect: note('rect'),
    moveTo: note('moveTo'),
    lineTo: note('lineTo'),
    fill: () => calls.push(`fill ${context.globalAlpha}`),
    stroke: () => calls.push(`stroke ${context.strokeStyle}`),
    save: () => {
      const { strokeStyle, fillStyle, globalAlpha, lineWidth } = context;
      saved.push({ strokeStyle, fillStyle, globalAlpha, lineWidth });
    },
    restore: () => Object.assign(context, saved.pop()),
  };
  return { context, calls, ctx: context as unknown as CanvasRenderingContext2D };
}

describe('drawSpace', () => {
  const space = () => new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).set(11, 40, 0, 50, 9).update();

  test('draws boxes, those that touch again, and a line between', () => {
    const { calls, ctx } = fakeContext();
    drawSpace(ctx, space(), { colors: { pairs: 'red' } });
    expect(calls.filter((call) => call.startsWith('rect'))).toEqual([
      'rect 0,0,10,10',
      'rect 5,5,10,10',
      'rect 40,0,10,9',
      'rect 0,0,10,10',
      'rect 5,5,10,10',
    ]);
    expect(calls).toContain('moveTo 5,5');
    expect(calls).toContain('lineTo 10,10');
    expect(calls.filter((call) => call === 'stroke red').length).toBe(2);
  });

  test('draws lines as wide as they are on the screen, whatever the transform', () => {
    const { calls, ctx } = fakeContext();
    drawSpace(ctx, space());
    const strokes = calls.flatMap((call, k) => (call.startsWith('stroke') ? [[calls[k - 1], calls[k + 1]]] : []));
    expect(strokes).toHaveLength(4);
    for (const around of strokes) expect(around).toEqual(['setTransform 1,0,0,1,0,0', 'setTransform world']);
  });

  test('draws only what the options ask for', () => {
    const { calls, ctx } = fakeContext();
    drawSpace(ctx, space(), { boxes: false, pairs: false });
    expect(calls.filter((call) => /^(rect|lineTo)/.test(call))).toEqual([]);
  });

  test('fills the fullest cells', () => {
    const { calls, ctx } = fakeContext();
    drawSpace(ctx, crowd(2, 'spatial-grid'), { boxes: false, pairs: false, hot: true });
    const held = [...boxesInCells(crowd(2, 'spatial-grid'))];
    const most = Math.max(...held);
    const full = held.filter((boxes) => boxes >= Math.max(2, most / 2));
    expect(full.length).toBeLessThan(held.length);
    expect(calls.filter((call) => call.startsWith('fill'))).toEqual(
      full.map((boxes) => `fill ${(0.5 * boxes) / most}`),
    );
    expect(calls.filter((call) => call.startsWith('rect')).length).toBe(full.length);
  });

  test('fills no cell with a single box', () => {
    const { calls, ctx } = fakeContext();
    const apart = new BroadPhase({ technique: 'spatial-grid', cellSize: 10 })
      .set(1, 2, 2, 3, 3)
      .set(2, 92, 92, 93, 93)
      .update();
    drawSpace(ctx, apart, { boxes: false, pairs: false, hot: true });
    expect(calls.filter((call) => call.startsWith('fill'))).toEqual([]);
  });

  test('leaves the context as it was, also where it throws', () => {
    const { context, ctx } = fakeContext();
    drawSpace(ctx, space(), { cells: true, hot: true, rays: [[-9, 5, 1, 0]] });
    expect(context).toMatchObject({ strokeStyle: 'before', fillStyle: 'before', globalAlpha: 1, lineWidth: 3 });
    const bad = { rays: [[0, 0, Number.NaN, 0]] };
    expect(() => drawSpace(ctx, space(), bad)).toThrow(RangeError);
    expect(context).toMatchObject({ strokeStyle: 'before', globalAlpha: 1, lineWidth: 3 });
    const wrapped = new BroadPhase({ wrap: [9, 9] }).update();
    expect(() => drawSpace(ctx, wrapped, { rays: [[0, 0, 1, 0, 1e9]] })).toThrow(
      'rayCast: maxDistance: got 1000000000',
    );
    expect(context).toMatchObject({ strokeStyle: 'before', globalAlpha: 1, lineWidth: 3 });
  });

  test('says what is wrong before it draws', () => {
    const { calls, ctx } = fakeContext();
    expect(() => drawSpace(ctx, crowd(3, 'auto'))).toThrow('drawSpace: got a space of 3 dimensions, expected 2');
    expect(() => drawSpace(ctx, space(), { cell: true } as object)).toThrow('drawSpace: options: got "cell"');
    expect(() => drawSpace(ctx, space(), { rays: [[1, 2]] })).toThrow('drawSpace: rays: got [1, 2]');
    const hole = [0, 0, 1, 0];
    delete hole[1];
    for (const ray of [
      [0, 0, 1, 0, '5'],
      [0, 0, 1, 0, null],
      [0, 0, 1, 0, -1],
      [0, 0, 1, Infinity],
      [0, 0, 1n, 0],
      hole,
    ]) {
      expect(() => drawSpace(ctx, space(), { rays: [ray as number[]] })).toThrow(/^drawSpace: rays: got \[0, /);
    }
    // Neither text nor a number can be made of these.
    for (const value of [Symbol('x'), Object.create(null)]) {
      expect(() => drawSpace(ctx, space(), { rays: [[0, 0, value, 1]] })).toThrow(/^drawSpace: rays: got .*expected/);
      expect(() => drawSpace(ctx, space(), { rays: value })).toThrow(/^drawSpace: rays: got .*expected/);
      expect(() => drawSpace(ctx, space(), { boxes: value })).toThrow(/^drawSpace: boxes: got .*expected/);
      expect(() => boxesInCells(value)).toThrow(/^boxesInCells: got .*expected/);
    }
    for (const value of [Symbol('wide'), 5n, null]) {
      const message = `drawSpace: lineWidth: got ${String(value)}, expected a number above 0`;
      expect(() => drawSpace(ctx, space(), { lineWidth: value as never })).toThrow(message);
    }
    expect(calls).toEqual([]);
  });
});

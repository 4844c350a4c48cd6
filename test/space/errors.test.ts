// Bad input is refused at the call, by an error that names the id and the value, and leaves everything as it was.
import { BroadPhase, type BroadPhaseOptions } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { setBox } from '../support/set-box.ts';

/** Runs `call`, which must throw a RangeError or a TypeError whose message holds every one of the fragments. */
function expectRefusal(call: () => unknown, ...fragments: readonly string[]): void {
  let error: unknown;
  try {
    call();
  } catch (thrown) {
    error = thrown;
  }
  if (!(error instanceof RangeError || error instanceof TypeError)) {
    expect.fail(`expected a RangeError or a TypeError about ${fragments.join(' and ')}, got ${error ?? 'no error'}`);
  }
  for (const fragment of fragments) expect(error.message).toContain(fragment);
}

/** Everything a space shows of its state, by copy. */
function stateOf(space: BroadPhase<2 | 3>, ids: readonly number[]) {
  return {
    size: space.size,
    boxes: ids.map((id) => Array.from(space.get(id) ?? [])),
    has: ids.map((id) => space.has(id)),
    pairs: Array.from(space.pairs),
    pairCount: space.pairCount,
    technique: space.technique,
  };
}

/** The same, for calls whose arguments no TypeScript user could give. */
const anyhow = <T>(value: unknown) => value as T;

const lowest = { 2: [0, 0, 1, 1], 3: [0, 0, 0, 1, 1, 1] };

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  const good = lowest[dimensions];
  const stride = 2 * dimensions;
  const ids = [0, 1, 2, 3, 4, 7, 9];

  /** Three boxes, two of them overlapping; then `call` must be refused and leave no trace. */
  function expectNoTrace(call: (space: BroadPhase<2 | 3>) => unknown, ...fragments: readonly string[]): void {
    const space = new BroadPhase({ dimensions });
    setBox(space, 7, good);
    setBox(
      space,
      9,
      good.map((value) => value + 0.1),
    );
    setBox(
      space,
      3,
      good.map((value) => value + 50),
    ).update();
    const before = stateOf(space, ids);
    expect(before.pairs).toEqual([7, 9]);
    expectRefusal(() => call(space), ...fragments);
    expect(stateOf(space, ids)).toEqual(before);
    space.update();
    expect(stateOf(space, ids)).toEqual(before);
  }

  const badIds = [-1, 1.5, 2 ** 24, Number.NaN, Infinity, '7', undefined, null, {}];
  test.each(badIds)('set refuses the id %s', (id) => {
    expectNoTrace((space) => setBox(space, anyhow(id), good), typeof id === 'object' && id ? 'id' : String(id));
  });

  test.each([
    ['a symbol', Symbol('me'), 'Symbol(me)'],
    ['an object of no class', Object.create(null), '[object Object]'],
    ['a BigInt', 7n, '7n'],
    ['a number as an object', new Number(7), '[object Number]'],
  ])('every call with an id refuses %s', (_, id, shown) => {
    const halves = Array(dimensions).fill(1);
    const moving = [...good, ...halves];
    for (const [name, ...more] of [
      ['set', ...good],
      ['setCentred', ...halves, ...halves],
      ['setSwept', ...moving],
      ...['delete', 'has', 'get', 'filterOf', 'isStatic', 'isEnabled', 'groupOf', 'reachOf', 'collisionsOf'].map(
        (each) => [each],
      ),
      ['setFilter', 1, 1],
      ['setStatic', true],
      ['setEnabled', true],
      ['setGroup', 1],
      ['setReach', 1],
      ['isColliding', 9],
    ] as [string, ...unknown[]][]) {
      const message = `${name}${name === 'isColliding' ? ': a' : ''}: the id is ${shown}, expected an integer`;
      expectNoTrace(
        (space) => anyhow<Record<string, (...all: unknown[]) => unknown>>(space)[name]!(id, ...more),
        message,
      );
    }
  });

  test('set refuses NaN anywhere in a box', () => {
    for (let at = 0; at < stride; at++) {
      expectNoTrace((space) => setBox(space, 7, good.with(at, Number.NaN)), '7', 'NaN');
      expectNoTrace((space) => setBox(space, 4, good.with(at, Number.NaN)), '4', 'NaN');
    }
  });

  test('set refuses a min above its max, in floats and in doubles', () => {
    for (let axis = 0; axis < dimensions; axis++) {
      expectNoTrace((space) => setBox(space, 7, good.with(axis, 1.25)), '7', '1.25');
      expectNoTrace((space) => setBox(space, 7, good.with(axis, 1 + 2 ** -52)), '7', String(1 + 2 ** -52));
      expectNoTrace((space) => setBox(space, 7, good.with(axis, Infinity)), '7', 'Infinity');
      expectNoTrace((space) => setBox(space, 7, good.with(axis + dimensions, -Infinity)), '7', '-Infinity');
    }
  });

  test.each(['1', null, undefined, {}, 1n])('set refuses the coordinate %s', (value) => {
    for (let at = 0; at < stride; at++) {
      expectNoTrace((space) => setBox(space, 7, good.with(at, anyhow(value))), '7');
    }
  });

  test('set refuses too few and too many numbers', () => {
    for (const box of [[], good.slice(1), [...good, 5], [...good, ...good]]) {
      expectNoTrace((space) => setBox(space, 9, box), '9');
    }
  });

  const kinds = [
    ['an array', (numbers: number[]) => numbers],
    ['doubles', (numbers: number[]) => Float64Array.from(numbers)],
    ['floats', (numbers: number[]) => Float32Array.from(numbers)],
  ] as const;
  test.each(kinds)('setAll of %s refuses a bad box and names the first', (_, from) => {
    const boxes = Array.from({ length: 5 }, () => good).flat();
    for (let at = 0; at < stride; at++) {
      const bad = boxes.with(3 * stride + at, Number.NaN).with(4 * stride, Number.NaN);
      expectNoTrace((space) => space.setAll(from(bad)), '3', 'NaN');
    }
    const bad = boxes.with(2 * stride, 8.5).with(4 * stride, 9.5);
    expectNoTrace((space) => space.setAll(from(bad)), '2', '8.5');
  });

  test('setAll looks at no more boxes than it takes', () => {
    const space = new BroadPhase({ dimensions });
    space.setAll([...good, ...good.with(0, Number.NaN)], 1);
    expect(space.size).toBe(1);
  });

  test('setAll refuses a length that is not a whole number of boxes', () => {
    expectNoTrace((space) => space.setAll([...good, 1]), String(stride + 1));
    expectNoTrace((space) => space.setAll(new Float32Array(stride - 1)), String(stride - 1));
  });

  test.each([-1, 1.5, Number.NaN, 3, 2 ** 24 + 1, Infinity, '2'])(
    'setAll refuses the count %s for two boxes',
    (count) => {
      expectNoTrace((space) => space.setAll([...good, ...good], anyhow(count)), String(count));
    },
  );

  test.each([null, undefined, 7, 'boxes', {}, () => []])('setAll refuses %s', (boxes) => {
    expectNoTrace((space) => space.setAll(anyhow(boxes)));
  });

  test('setAll refuses arrays of what are not numbers', () => {
    expectNoTrace((space) => space.setAll(anyhow([...good, ...good.map(String)])), '1');
    expectNoTrace((space) => space.setAll(anyhow([...good, ...good.with(0, anyhow(undefined))])), '1', 'undefined');
    expectNoTrace((space) => space.setAll(anyhow(new BigInt64Array(stride))));
    expectNoTrace((space) => space.setAll(anyhow(new DataView(new ArrayBuffer(8 * stride)))));
  });

  test.each([-1, 1.5, Number.NaN, 2 ** 24 + 1, Infinity, '2', undefined])('boxes refuses the count %s', (count) => {
    expectNoTrace((space) => space.boxes(anyhow(count)), String(count));
  });

  test('update refuses bad boxes in the shared memory, names the first, and keeps the pairs until they are mended', () => {
    const space = new BroadPhase({ dimensions });
    const boxes = Array.from({ length: 5 }, () => good).flat();
    space.boxes(5).set(boxes);
    space.update();
    const pairs = Array.from(space.pairs);
    expect(space.pairCount).toBe(10);
    for (const [value, shown] of [
      [Number.NaN, 'NaN'],
      [8.5, '8.5'],
    ] as const) {
      const view = space.boxes(5);
      view.set(boxes);
      view[3 * stride] = value;
      view[4 * stride] = value;
      expectRefusal(() => space.update(), '3', shown);
      expect(Array.from(space.pairs)).toEqual(pairs);
      view.set(boxes);
      expect(Array.from(space.update().pairs)).toEqual(pairs);
    }
  });

  test('an unknown technique is refused and the one before stays', () => {
    for (const name of ['magic', '', 7, null, undefined, 'toString', 'Auto']) {
      expectNoTrace(
        (space) => {
          space.technique = anyhow(name);
        },
        String(name),
        'strip-sweep',
      );
    }
  });

  const badOptions: [name: string, options: unknown, ...fragments: string[]][] = [
    ['an unknown technique', { technique: 'magic' }, 'magic', 'strip-sweep'],
    ['a technique that is no name', { technique: 7 }, '7'],
    ['a cell size of 0', { cellSize: 0 }, 'cellSize', '0'],
    ['a negative cell size', { cellSize: -3.5 }, 'cellSize', '-3.5'],
    ['a cell size of NaN', { cellSize: Number.NaN }, 'cellSize', 'NaN'],
    ['an infinite cell size', { cellSize: Infinity }, 'cellSize', 'Infinity'],
    ['a cell size that is no number', { cellSize: '10' }, 'cellSize', '10'],
    ['too few cell sizes', { cellSize: Array(dimensions - 1).fill(10) }, 'cellSize'],
    ['too many cell sizes', { cellSize: Array(dimensions + 1).fill(10) }, 'cellSize'],
    ['one bad cell size of several', { cellSize: Array(dimensions).fill(10).with(1, -2) }, 'cellSize', '-2'],
    ['a margin of 0', { margin: 0 }, 'margin', '0'],
    ['a margin of NaN', { margin: Number.NaN }, 'margin', 'NaN'],
    ['an infinite margin', { margin: Infinity }, 'margin', 'Infinity'],
    ['a margin that is no number', { margin: '2' }, 'margin', '2'],
    ['a negative capacity', { capacity: -1 }, 'capacity', '-1'],
    ['a fractional capacity', { capacity: 1.5 }, 'capacity', '1.5'],
    ['a capacity beyond the ids', { capacity: 2 ** 24 + 1 }, 'capacity', String(2 ** 24 + 1)],
    ['too few bounds', { bounds: [0, 1] }, 'bounds'],
    ['bounds of NaN', { bounds: good.with(0, Number.NaN) }, 'bounds', 'NaN'],
    ['bounds with min above max', { bounds: good.with(0, 2.5) }, 'bounds', '2.5'],
    ['bounds that are no numbers', { bounds: 'all' }, 'bounds', 'all'],
  ];
  test.each(badOptions)('the constructor refuses %s', (_, options, ...fragments) => {
    expectRefusal(() => new BroadPhase({ dimensions, ...(options as BroadPhaseOptions) }), ...fragments);
  });
});

test.each([0, 1, 4, 2.5, Number.NaN, '2', null])('the constructor refuses %s dimensions', (dimensions) => {
  expectRefusal(() => new BroadPhase({ dimensions: dimensions as never }), 'dimensions', String(dimensions));
});

test.each([7, 'auto', null, true])('the constructor refuses %s for options', (options) => {
  expectRefusal(() => new BroadPhase(options as never), String(options));
});

test('options left out and options undefined are the same', () => {
  const left = {
    dimensions: undefined,
    technique: undefined,
    cellSize: undefined,
    bounds: undefined,
    capacity: undefined,
  };
  const space = new BroadPhase(left as never);
  expect(space.dimensions).toBe(2);
  expect(space.technique).toBe('auto');
});

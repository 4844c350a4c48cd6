// Every query against a look at every box: after any calls, by any technique, in every recorded scene.
import { BroadPhase, type QueryOptions } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { Asker, ascending, copyOf, type Loose } from '../support/asker.ts';
import { anyPlace, type Entry, Modelled } from '../support/model.ts';
import { readTrace, traceNames } from '../support/recordings.ts';
import { setBox } from '../support/set-box.ts';

// Among the model's calls are those that switch to any technique.
describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  test.each([1, 2, 3, 4, 5, 6])(
    'answers with the boxes of the last update, after any sequence of calls, seed %i',
    (seed) => {
      const model = new Modelled({ dimensions }, seed);
      const asker = new Asker(model.space, model.random, 60);
      asker.everything(new Map());
      for (let round = 0; round < 15; round++) {
        for (let call = 0; call < 30; call++) model.step();
        model.space.update();
        const seen = copyOf(model.entries);
        for (let call = 0; call < 3; call++) {
          for (let k = 0; k < 4; k++) asker.everything(seen);
          // Seen no sooner than with the next update.
          for (let k = 0; k < 5; k++) model.step();
        }
      }
    },
  );
});

// Few queries an update, so that the index keeps its order while boxes drift, come and go.
describe.each([2, 3] as const)('among many boxes in %d dimensions', (dimensions) => {
  test.each([1, 2, 3, 4, 5, 6])('answers while most of them move, seed %i', { tags: 'long' }, (seed) => {
    const model = new Modelled({ dimensions }, seed, anyPlace, 200, 700);
    const { space, random, entries } = model;
    const asker = new Asker(space, random, 200);
    const pick = <T>(...from: T[]): T => from[model.integer(from.length)]!;
    const shifted = (box: readonly number[], by: number) => box.map((x) => x + by);
    const allAtOnce = (by: number) => {
      model.replace(model.entries.size, random() < 0.5, (id) => shifted(entries.get(id)?.box ?? model.box(), by));
    };
    model.replace(600, true);
    for (let round = 0; round < 40; round++) {
      const by = pick(0, 0.5, -1, 3);
      const how = random();
      if (how < 0.3) allAtOnce(by);
      else if (how < 0.7) for (const [id, { box }] of entries) random() < 0.9 && model.set(id, shifted(box, by));
      else if (how < 0.8)
        for (const id of [...entries.keys()]) model.set(id); // all anywhere
      else for (let call = 0; call < 150; call++) model.step();
      if (random() < 0.3)
        for (let call = 0; call < 60; call++)
          pick(
            () => model.delete(model.id()),
            () => model.set(model.id()),
          )();
      space.update();
      const seen = copyOf(entries);
      const kind = pick('planes', 'nearest', 'ray', 'sweep', 'everything', 'planes', 'planes') as 'planes';
      for (let call = pick(0, 1, 1, 2); call > 0; call--) asker[kind](seen);
      if (random() < 0.1) space.restore(space.snapshot());
    }
  });
});

test.each(traceNames)('answers in the recorded %s', { tags: 'long' }, (name) => {
  const recording = readTrace(name);
  const { dimensions, count } = recording;
  const random = createRandom(3);
  const space = new BroadPhase({ dimensions });
  const boxes = recording.frame(1);
  space.boxes(count).set(boxes);
  const entries = new Map<number, Entry>();
  for (let id = 0; id < count; id++) {
    const box = Array.from(boxes.subarray(id * 2 * dimensions, (id + 1) * 2 * dimensions));
    entries.set(id, { box, layer: 1 << (id % 3), mask: 7, isStatic: false });
    space.setFilter(id, 1 << (id % 3), 7);
  }
  space.update();
  const most = Math.max(...boxes.subarray(0, 2000));
  const asker = new Asker(space, random, most);
  for (let k = 0; k < (count > 5000 ? 4 : 15); k++) asker.everything(entries);
});

describe('at the edges', () => {
  const space = new BroadPhase().setAll([0, 0, 10, 10, 20, 0, 30, 10, 10, 10, 20, 20]).update();

  test('a ray along an edge meets the box, one beside it does not', () => {
    expect(space.rayCast(-5, 10, 1, 0)).toEqual({ id: 0, distance: 5, normal: [-1, 0] });
    expect(space.rayCastAll(-5, 10, 1, 0).map(({ id }) => id)).toEqual([0, 2, 1]);
    expect(space.rayCast(-5, 10.000001, 1, 0)?.id).toBe(2);
    expect(space.rayCast(0, 30, 0, -4)).toEqual({ id: 0, distance: 20, normal: [0, 1] });
    expect(space.rayCast(-5, -5, 1, 1)).toEqual({ id: 0, distance: Math.sqrt(50), normal: [-1, 0] });
  });

  test('a ray without length is a point', () => {
    expect(space.rayCast(9, 9, 0, 0)).toEqual({ id: 0, distance: 0, normal: [0, 0] });
    expect(space.rayCastAll(10, 10, 0, -0)).toEqual([]); // it touches, and leads nowhere
    expect(space.rayCast(11, 9, 0, 0)).toBeUndefined();
  });

  test('a ray reaches to its very end', () => {
    expect(space.rayCast(-5, 5, 3, 0, { maxDistance: 5 })?.distance).toBe(5);
    expect(space.rayCast(-5, 5, 3, 0, { maxDistance: 4.999999 })).toBeUndefined();
    expect(space.rayCast(5, 5, 3, 0, { maxDistance: 0 })?.distance).toBe(0);
  });

  test('a moving box touches what it reaches, and at once what it overlaps', () => {
    expect(space.sweep(-4, 2, -2, 4, 2, 0)).toEqual({ id: 0, time: 1, normal: [-1, 0] });
    expect(space.sweep(-4, 2, -2, 4, 1.999999, 0)).toBeUndefined();
    expect(space.sweep(2, 2, 4, 4, 100, 0)).toEqual({ id: 0, time: 0, normal: [0, 0] });
    expect(space.sweep(2, 2, 4, 4, 32, 0, { ignore: 0 })).toEqual({ id: 1, time: 0.5, normal: [-1, 0] });
    expect(space.sweep(12, 2, 14, 4, 0, 0)).toBeUndefined();
    expect(space.sweep(-Infinity, 40, Infinity, 50, 0, -40)).toEqual({ id: 2, time: 0.5, normal: [0, 1] });
  });

  test('a box at the tip of a double is met, the one behind it is not', () => {
    const exact = new BroadPhase().setAll([0.1, 0, 0.2, 1, 0.2 + 2 ** -50, 0, 1, 1]).update();
    expect(exact.queryPoint(0.2, 0.5)).toEqual([0]);
    expect(exact.queryBox(0.2, 0, 0.2 + 2 ** -50, 1).toSorted()).toEqual([0, 1]);
    expect(exact.nearest(0.2 + 2 ** -51, 0.5, 2)).toEqual([0, 1]);
    expect(exact.queryCircle(0, 0.5, 0.1)).toEqual([0]);
    expect(exact.queryCircle(0, 0.5, 0.1 - 2 ** -54)).toEqual([]);
    // The squares of distances so small are 0.
    exact.set(0, -2, 0, 0, 0).update();
    expect(exact.queryCircle(5e-324, 0, 0)).toEqual([]);
    expect(exact.queryCircle(0, 0, 0)).toEqual([0]);
    for (const radius of [1, 1e-150, 1e-170, 5e-324]) {
      expect(exact.set(0, -2, 0, 0, 0).update().queryCircle(-1, -0, radius, { touching: false })).toEqual([0]);
      exact.set(0, -2, -1, 0, 1).update();
      expect(exact.queryCircle(-1, 0, radius, { touching: false })).toContain(0);
      expect(exact.queryCircle(0, 0, radius, { touching: false })).toContain(0);
      expect(exact.queryCircle(radius, 0, radius)).toContain(0);
      expect(exact.queryCircle(radius, 0, radius, { touching: false })).not.toContain(0);
      expect(exact.queryCircle(2 * radius, 0, radius)).not.toContain(0);
    }
  });

  test('before the first update there is nothing', () => {
    const empty = new BroadPhase().set(0, 0, 0, 1, 1);
    expect(empty.queryBox(0, 0, 1, 1)).toEqual([]);
    expect(empty.rayCast(0, 0, 1, 1)).toBeUndefined();
    expect(empty.nearest(0, 0, 3)).toEqual([]);
    expect(empty.update().queryPoint(0, 0)).toEqual([0]);
    empty.clear();
    expect(empty.queryPoint(0, 0)).toEqual([0]);
    expect(empty.update().queryPoint(0, 0)).toEqual([]);
  });
});

describe('a visitor', () => {
  const space = new BroadPhase().setAll(Array.from({ length: 400 }, () => [0, 0, 1, 1]).flat()).update();

  test('may ask and change boxes, but not update', () => {
    let asked = 0;
    const seen: number[] = [];
    space.queryPoint(0, 0, {
      visit: (id) => {
        seen.push(id);
        asked += space.queryBox(0, 0, 1, 1).length;
        space.nearest(0, 0, 100, { visit: () => space.rayCast(-1, 0, 1, 0) !== undefined && ++asked % 7 !== 0 });
        space.set(id, 5, 5, 6, 6);
        return seen.length < 150;
      },
    });
    expect(new Set(seen).size).toBe(150);
    expect(asked).toBeGreaterThan(150 * 400);
    expect(() => space.queryPoint(0, 0, { visit: () => space.update() })).toThrow(
      'queryPoint: update or restore was called',
    );
    expect(() => space.nearest(0, 0, 5, { visit: () => space.update() })).toThrow(
      'nearest: update or restore was called',
    );
  });

  test('may throw', () => {
    const visit = () => {
      throw new Error('enough');
    };
    expect(() => space.queryBox(5, 5, 5, 5, { visit })).toThrow('enough');
    expect(() => space.nearest(0, 0, 5, { visit })).toThrow('enough');
    expect(space.queryBox(5, 5, 5, 5).length).toBeGreaterThan(0);
  });
});

describe.each([2, 3] as const)('bad queries in %d dimensions', (dimensions) => {
  const space = new BroadPhase({ dimensions });
  const ask = space as unknown as Loose;
  const axes = Array.from({ length: dimensions });
  const point = axes.map(() => 0);
  const box = [...point, ...point.map(() => 1)];
  const round = dimensions === 2 ? 'queryCircle' : 'querySphere';
  const queries: [string, number[]][] = [
    ['queryBox', box],
    ['queryPoint', point],
    [round, [...point, 1]],
    ['rayCast', [...point, ...point]],
    ['rayCastAll', [...point, ...point]],
    ['sweep', [...box, ...point]],
    ['nearest', [...point, 1]],
  ];

  test.each(queries)('%s', (name, good) => {
    for (let at = 0; at < good.length; at++) {
      for (const bad of ['1', null, {}, 1n]) {
        expect(() => ask[name](...good.with(at, bad as unknown as number))).toThrow(TypeError);
        expect(() => ask[name](...good.with(at, bad as unknown as number))).toThrow(`${name}: `);
      }
      expect(() => ask[name](...good.with(at, Number.NaN))).toThrow(RangeError);
      expect(() => ask[name](...good.with(at, Number.NaN))).toThrow('NaN');
    }
    expect(() => ask[name](...good.slice(1))).toThrow(`${name}: `);
    expect(() => ask[name](...good, 1)).toThrow(TypeError);
    expect(() => ask[name](...good, {}, {})).not.toThrow('was refused');
    for (const options of [null, 'all', 7]) expect(() => ask[name](...good, options)).toThrow(TypeError);
    const given = (options: Record<string, unknown>) => () => ask[name](...good, options as QueryOptions);
    for (const mask of [-1, 2 ** 32, 1.5, Number.NaN]) expect(given({ mask })).toThrow(`${name}: mask: got ${mask}`);
    expect(given({ mask: '1' })).toThrow(TypeError);
    expect(given({ ignore: [3, -1] })).toThrow(`${name}: ignore[1]: the id is -1`);
    for (const ignore of [-1, 2 ** 24, 0.5, null]) expect(given({ ignore })).toThrow(`${name}: ignore: the id is`);
    expect(given({ mask: undefined, ignore: undefined, out: undefined, visit: undefined })).not.toThrow();
    if (name !== 'rayCast' && name !== 'sweep') expect(given({ out: new Uint32Array(3) })).toThrow(`${name}: out`);
    if (name === 'rayCast' || name === 'sweep') expect(given({ accept: 7 })).toThrow(`${name}: accept: got 7`);
    if (name === 'queryBox') expect(given({ within: 1 })).toThrow('queryBox: within: got 1, expected true or false');
    if (name === 'nearest')
      expect(given({ distances: 1 })).toThrow('nearest: distances: got 1, expected an ordinary array');
    if (name !== 'rayCast') expect(given({ visit: 7 })).toThrow(`${name}: visit`);
    if (/ray|nearest/.test(name)) {
      for (const maxDistance of [-1, Number.NaN]) expect(given({ maxDistance })).toThrow(`${name}: maxDistance: got`);
      expect(given({ maxDistance: '1' })).toThrow(TypeError);
    }
  });

  test('infinite points, ways and directions, and minima above maxima', () => {
    for (const name of ['queryPoint', 'nearest', round, 'rayCast', 'rayCastAll']) {
      const good = queries.find(([each]) => each === name)![1];
      expect(() => ask[name](...good.with(0, Infinity))).toThrow('expected a finite number');
    }
    expect(() => ask.rayCast(...point, ...point.with(0, -Infinity))).toThrow('directionX: got -Infinity');
    expect(() => ask.sweep(...box, ...point.with(0, Infinity))).toThrow('dx: got Infinity');
    expect(() => ask.queryBox(...box.with(1, 2))).toThrow('minY: got 2, expected no more than maxY, which is 1');
    expect(() => ask.sweep(...box.with(0, 2), ...point)).toThrow('minX: got 2');
  });

  test('a negative radius, and bad numbers of neighbours', () => {
    expect(() => ask[round](...point, -1)).toThrow(`${round}: radius: got -1`);
    for (const k of [0, -1, 1.5, Number.NaN]) expect(() => ask.nearest(...point, k)).toThrow(`nearest: k: got ${k}`);
  });

  test('the round shape of the other world', () => {
    const wrong = dimensions === 2 ? 'querySphere' : 'queryCircle';
    expect(() => ask[wrong](...point, 1, 1)).toThrow(`${wrong}: this space has ${dimensions} dimensions`);
  });
});

describe.each([2, 3] as const)('planes in %d dimensions', (dimensions) => {
  const rest = Array.from({ length: dimensions - 1 }, () => 0);
  const row = Array.from({ length: 1000 }, (_, k) => [k, ...rest, k + 1, ...rest]);
  const fromTo = (from: number, to: number) => [1, ...rest, -from, -1, ...rest, to];

  test('answers of any number are read in parts, while boxes move too', () => {
    const space = new BroadPhase({ dimensions }).setAll(row.flat()).update();
    for (let frame = 0; frame < 20; frame++) {
      const inside: number[] = [];
      const cut: number[] = [];
      const visit = (id: number, whole: boolean) => void (whole ? inside : cut).push(id);
      space.queryPlanes(fromTo(200, 800), { visit });
      expect([inside.length, ascending(cut)]).toEqual([600, [199, 800]]);
      // A box trades its place with another, as the index follows.
      const [one, other] = [100 + frame, 500 + frame];
      setBox(space, other, row[one]!);
      setBox(space, one, row[other]!);
      space.update();
      expect(space.queryPlanes(fromTo(200, 800), { ignore: one }).length).toBe(601);
      setBox(space, one, row[one]!);
      setBox(space, other, row[other]!);
      space.update();
    }
  });

  test('what touches a plane is not behind it, in doubles too', () => {
    const space = new BroadPhase({ dimensions }).setAll([0.1, ...rest, 0.2, ...rest]).update();
    expect(space.queryPlanes([1, ...rest, -0.2])).toEqual([0]);
    expect(space.queryPlanes([1, ...rest, -0.2 - 2 ** -54])).toEqual([]);
    const seen: boolean[] = [];
    const visit = (_: number, inside: boolean) => void seen.push(inside);
    for (const d of [-0.1, -0.1 - 2 ** -56]) space.queryPlanes([1, ...rest, d], { visit });
    expect(seen).toEqual([true, false]);
  });

  test('bad planes are refused by name', () => {
    const space = new BroadPhase({ dimensions }).setAll(row.flat()).update();
    const ask =
      (...given: unknown[]) =>
      () =>
        (space as unknown as Loose).queryPlanes(...given);
    const good = fromTo(0, 5);
    for (const bad of [undefined, null, 7, 'all', {}, new Uint8Array(4)]) expect(ask(bad)).toThrow(TypeError);
    expect(ask(good.slice(1))).toThrow(`queryPlanes: planes.length: got ${good.length - 1}, expected `);
    expect(ask(Array.from({ length: 9 }, () => [1, ...rest, 0]).flat())).toThrow(RangeError);
    for (const bad of [Number.NaN, Infinity]) {
      expect(ask(good.with(2, bad))).toThrow(`queryPlanes: planes[2]: got ${bad}, expected a finite number`);
      expect(ask(good.with(2, bad))).toThrow(RangeError);
    }
    expect(ask(good.with(1, '0' as never))).toThrow(TypeError);
    expect(ask(good, { visitor: () => 1 })).toThrow('did you mean "visit"?');
    expect(ask(good, { mask: -1 })).toThrow('queryPlanes: mask: got -1');
    expect(ask(good, { out: 7 })).toThrow('queryPlanes: out: got 7');
  });
});

test('no sweep meets what begins infinitely far away, however far it goes', () => {
  const space = new BroadPhase().set(7, -Infinity, Infinity, Infinity, Infinity).update();
  expect(space.sweep(0, -0.1, 1, 0, 1e300, 1e308)).toBeUndefined();
});

test('the first query sees what the last update saw, whatever was written in place since', () => {
  const space = new BroadPhase();
  const boxes = space.boxes(1);
  boxes.set([0, 0, 1, 1]);
  space.update();
  boxes.set([5, 5, 6, 6]);
  expect([space.queryPoint(0, 0), space.queryPoint(5, 5)]).toEqual([[0], []]);
  expect([space.update().queryPoint(0, 0), space.queryPoint(5, 5)]).toEqual([[], [0]]);
});

describe.each([2, 3] as const)('the first query, in %d dimensions', (dimensions) => {
  test.each([1, 2, 3, 4, 5, 6, 7, 8])('sees the last update, whatever was given before and since, seed %i', (seed) => {
    for (let space = 0; space < 12; space++) {
      const model = new Modelled({ dimensions }, 100 * seed + space);
      const calls = (most: number) => {
        for (let call = model.integer(most); call > 0; call--) model.step();
        if (model.random() < 0.5) model.replace(model.entries.size, model.random() < 0.5);
      };
      for (let update = 0; update <= space % 4; update++) {
        calls(30);
        model.space.update();
      }
      const seen = copyOf(model.entries);
      calls(8);
      new Asker(model.space, model.random, 60).everything(seen);
    }
  });

  test.each(['float32', 'doubles'])('does not see what is written to an array of boxes() after setAll, %s', (kind) => {
    const space = new BroadPhase({ dimensions });
    const many = 5000; // of fewer, each update makes a copy
    const box = (at: number) => Array.from({ length: 2 * dimensions }, (_, k) => at + Math.floor(k / dimensions));
    const boxes = (at: number) => {
      const numbers = Array.from({ length: many }, (_, id) => box(at + 0.1 + 9 * id)).flat();
      return kind === 'doubles' ? Float64Array.from(numbers) : Float32Array.from(numbers);
    };
    const inPlace = space.setAll(boxes(0)).update().boxes(many);
    inPlace.set(boxes(0));
    space.update().setAll(boxes(5));
    inPlace.fill(Number.NaN);
    expect(space.queryBox(...(box(0) as never))).toEqual([0]);
    expect(space.update().queryBox(...(box(5) as never))).toEqual([0]);
  });
});

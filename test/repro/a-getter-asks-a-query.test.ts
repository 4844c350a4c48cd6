// A getter among the options of a query that called the space itself, even only `get`, wrote over the numbers of that
// query: the answer was silently that of another. And views that lie outside of a buffer which has shrunk gave the
// engine's own text.
import { BroadPhase, findPairs } from 'broadphase';
import { describe, expect, test } from 'vitest';

type Call = (options?: object) => unknown;

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  const solid = dimensions === 3;
  const space = new BroadPhase({ dimensions }) as unknown as BroadPhase<2>;
  const three = space as unknown as BroadPhase<3>;
  const put = (id: number, x: number) => (solid ? three.set(id, x, 0, 0, x + 5, 5, 5) : space.set(id, x, 0, x + 5, 5));
  for (let id = 0; id < 5; id++) put(id, 10 * id);
  space.update();

  const planes = (x: number, by: number) => [by, 0, ...(solid ? [0] : []), -by * x];
  const bounds = (x: number) => (solid ? [x, 0, 0, x + 6, 6, 6] : [x, 0, x + 6, 6]);
  const place = (x: number) => (solid ? [x, 2, 2] : [x, 2]);
  const way = (by: number) => (solid ? [by, 0, 0] : [by, 0]);
  const many = ({ ids, offsets, ...more }: { ids: Uint32Array; offsets: Uint32Array }) =>
    JSON.stringify([[...ids.subarray(0, offsets.at(-1))], [...offsets], Object.keys(more)]);
  // biome-ignore lint/suspicious/noExplicitAny: each takes as many numbers as the space has dimensions
  const any = space as any;
  const seen = (call: (options: object) => unknown, options: object = {}) => {
    const ids: number[] = [];
    call(Object.defineProperties({ visit: (id: number) => ids.push(id) }, Object.getOwnPropertyDescriptors(options)));
    return ids;
  };
  const calls: Record<string, Call> = {
    queryBox: (options) => any.queryBox(...bounds(0), options),
    queryPoint: (options) => any.queryPoint(...place(2), options),
    'queryPoint, visit': (options) => seen((all) => any.queryPoint(...place(2), all), options),
    'queryCircle or querySphere': (options) => any[solid ? 'querySphere' : 'queryCircle'](...place(2), 1, options),
    queryPlanes: (options) => any.queryPlanes(planes(25, 1), options),
    rayCast: (options) => any.rayCast(...place(-5), ...way(1), options),
    'rayCast, accept': (options) =>
      any.rayCast(
        ...place(-5),
        ...way(1),
        Object.defineProperties({ accept: () => true }, Object.getOwnPropertyDescriptors(options ?? {})),
      ),
    rayCastAll: (options) => any.rayCastAll(...place(-5), ...way(1), options),
    sweep: (options) => any.sweep(...bounds(-10), ...way(100), options),
    'sweep, visit': (options) => seen((all) => any.sweep(...bounds(-10), ...way(100), all), options),
    nearest: (options) => any.nearest(...place(2), 3, options),
    'nearest, visit': (options) => seen((all) => any.nearest(...place(2), 3, all), options),
    queryBoxes: (options) => many(any.queryBoxes([...bounds(0), ...bounds(20)], options)),
    queryPoints: (options) => many(any.queryPoints([...place(5), ...place(20)], options)),
    rayCasts: (options) => many(any.rayCasts([...place(-5), ...way(1)], options)),
    nearests: (options) => many(any.nearests(place(2), 3, options)),
  };
  const meanwhile: Record<string, () => unknown> = {
    get: () => space.get(3),
    'queries of all kinds': () => {
      any.queryBox(...bounds(40), { touching: false, within: true });
      any.queryPlanes(planes(15, -1));
      any.rayCast(...place(100), ...way(-1), { maxDistance: 1, mask: 0, ignore: [1, 2] });
      any.sweep(...bounds(60), ...way(-30), { visit: () => false });
      any.nearest(...place(44), 1);
      any.queryBoxes(bounds(40), { touching: false });
    },
    'one that throws': () => expect(() => any.rayCast(...place(100), ...way(-1), { maxDistance: -1 })).toThrow(),
    'what makes memory grow': () => {
      for (let id = 1000; id < 30_000; id++) put(id, 1000 + id);
    },
  };
  const values = {
    mask: 0xffffffff,
    ignore: 4,
    touching: true,
    within: false,
    maxDistance: 100,
    ignoreEach: undefined,
    out: undefined,
    visit: undefined,
  };

  for (const [what, act] of Object.entries(meanwhile)) {
    test.each(Object.keys(calls))(`%s, with a getter that calls ${what}`, (name) => {
      const ask = calls[name];
      for (const [option, value] of Object.entries(values)) {
        let expected: unknown;
        try {
          expected = ask({ [option]: value });
        } catch {
          continue; // it has no such option
        }
        let reads = 0;
        const options = Object.defineProperty({}, option, {
          enumerable: true,
          configurable: true,
          get() {
            reads++;
            act();
            return value;
          },
        });
        expect(ask(options), option).toEqual(expected);
        if (value !== undefined) expect(reads, option).toBe(1);
      }
    });
  }
});

test('an update in a getter counts, since the query has not begun', () => {
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  const options = {
    get ignore() {
      space.set(9, 0, 0, 2, 2).update();
      return 7;
    },
  };
  expect(space.queryPoint(1, 1, options)).toEqual([9]);
});

test.skipIf(!('resizable' in ArrayBuffer.prototype))('views outside of a buffer that has shrunk are refused', () => {
  const buffer = new (
    ArrayBuffer as never as new (
      length: number,
      options: object,
    ) => { resize(to: number): void } & ArrayBuffer
  )(64, { maxByteLength: 64 });
  const boxes = new Float32Array(buffer, 32, 8);
  const ids = new Uint32Array(buffer, 32, 8);
  buffer.resize(40);
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  const message = 'got a detached array: its memory was transferred or resized';
  expect(() => space.setAll(boxes)).toThrow(`setAll: ${message}`);
  expect(() => space.queryBoxes(boxes)).toThrow(`queryBoxes: ${message}`);
  expect(() => space.queryPlanes(boxes)).toThrow(`queryPlanes: ${message}`);
  expect(() => space.queryBoxes([], { ignoreEach: ids })).toThrow(`queryBoxes: ignoreEach: ${message}`);
  expect(() => findPairs(boxes)).toThrow(`findPairs: ${message}`);
});

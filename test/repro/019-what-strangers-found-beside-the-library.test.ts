// Faults that strangers found in the entry points beside the library: shards, traces, drawing, and the command.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { BroadPhase } from 'broadphase';
import { drawSpace, Lines } from 'broadphase/draw';
import { Entity, ov3, World } from 'broadphase/ro';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import {
  applyFrame,
  compare,
  exactPairs,
  exportRecording,
  importRecording,
  openAny,
  openTrace,
  readTrace,
  record,
  replay,
  survey,
  TraceWriter,
  tune,
} from 'broadphase/trace';
import { afterAll, describe, expect, test } from 'vitest';
import { runCommand } from '../support/command.ts';

const joined = (...pieces: Uint8Array[]) => Uint8Array.from(pieces.flatMap((piece) => [...piece]));
/** A trace of one frame. */
function traceOf(boxes = new Float32Array(), ids?: number[]) {
  const writer = new TraceWriter(2);
  return joined(writer.header(), writer.frame(boxes, ids), writer.end());
}
const loose = (options: unknown) => options as never;

const events = () => new BroadPhase({ events: true });

describe('a shard', () => {
  const zones = new Zones({ borders: { x: [100] } });
  const alone = new Zones({ borders: {} });

  test('whose entered threw calls it again for the same box, and has missed no event', () => {
    const left = new Shard(zones, 0, events());
    const entered: number[] = [];
    let broken = true;
    const right = new Shard(zones, 1, events(), {
      entered(id) {
        if (id === 2 && broken) throw new Error('not now');
        entered.push(id);
      },
    });
    left.set(1, 80, 0, 90, 10).set(2, 80, 0, 91, 10).set(3, 80, 0, 92, 10).exchange();
    left.update();
    for (const id of [1, 2, 3]) left.set(id, 80, 0, 110, 10);
    right.set(9, 120, 0, 130, 10);
    const deltas = left.exchange();
    expect(() => right.update(deltas)).toThrow('not now');
    expect(() => right.update(deltas)).toThrow('not now');
    broken = false;
    right.update(deltas);
    expect(entered).toEqual([1, 2, 3, 9]);
    expect([...right.began]).toEqual([]);
    left.set(1, 70, 20, 120, 30).set(2, 0, 50, 130, 60);
    right.update(left.exchange());
    expect(entered).toEqual([1, 2, 3, 9]);
    expect([...right.ids()].sort()).toEqual([1, 2, 3, 9]);
  });

  test('whose entered threw can delete the box', () => {
    const shard = new Shard(alone, 0, events(), {
      entered(id) {
        if (id === 1) throw new Error('not this one');
      },
    });
    expect(() => shard.set(1, 0, 0, 1, 1).update()).toThrow('not this one');
    expect(shard.delete(1)).toBe(true);
    shard.set(2, 0, 0, 1, 1).update();
    expect([[...shard.ids()], shard.space.size, [...shard.pairs]]).toEqual([[2], 1, []]);
  });

  const changes: [string, (shard: Shard) => unknown][] = [
    ['set', (shard) => shard.set(1, 5, 5, 6, 6)],
    ['delete', (shard) => shard.delete(1)],
    ['exchange', (shard) => shard.exchange()],
    ['update', (shard) => shard.update()],
    ['forget', (shard) => shard.forget(1)],
    ['resend', (shard) => shard.resend(1)],
  ];

  test.each(changes)('cannot be changed by entered: %s', (name, change) => {
    let calls = 0;
    const shard: Shard = new Shard(zones, 0, events(), { entered: () => (calls++ === 0 ? change(shard) : undefined) });
    const message = `${name}: called by entered, expected only after update`;
    expect(() => shard.set(1, 0, 0, 1, 1).update()).toThrow(message);
    shard.set(2, 0, 0, 1, 1).update();
    expect([shard.space.size, [...shard.pairs]]).toEqual([2, [1, 2]]);
  });

  test.each(changes)('whose space was disposed refuses %s', (_, change) => {
    const shard = new Shard(zones, 0, events());
    shard.space.dispose();
    expect(() => change(shard)).toThrow('this BroadPhase was disposed');
    expect([...shard.ids()]).toEqual([]);
  });

  test.each(['ids', 'changes', 'boxes'] as const)('names the detached %s of a delta', (name) => {
    const [delta] = new Shard(zones, 0, events()).set(1, 120, 0, 130, 10).exchange() as [Delta];
    structuredClone(delta[name].buffer, { transfer: [delta[name].buffer as ArrayBuffer] });
    expect(() => new Shard(zones, 1, events()).update([delta])).toThrow(
      /^update: delta\.\w+: got .*, expected a \w+, not detached$/,
    );
  });
});

test('a disposed space is not recorded, and is in no shard', () => {
  const space = events();
  space.dispose();
  expect(() => record(space)).toThrow('this BroadPhase was disposed');
  expect(() => new Shard(new Zones({ borders: {} }), 0, space)).toThrow('this BroadPhase was disposed');
});

describe('what a TraceWriter writes can be read:', () => {
  const two = Float32Array.of(0, 0, 1, 1, 0, 0, 1, 1);
  const writerOf = (...given: unknown[]) =>
    new (TraceWriter as never as new (...given: unknown[]) => TraceWriter)(...given);
  test.each<[string, unknown[]]>([
    ['wrap: got [-1, 0], expected 2 numbers above 0', [2, [-1, 0]]],
    ['wrap: got [5], expected 2 numbers above 0', [2, [5]]],
    ['wrap: got 5, expected 2 numbers above 0', [2, 5]],
    ['dimensions: got "2", expected 2 or 3', ['2']],
  ])('new: %s', (message, given) => {
    expect(() => writerOf(...given)).toThrow(message);
  });

  test.each<[string, unknown[]]>([
    [
      'trace: reaches: got -1, expected finite numbers',
      [two, undefined, undefined, { reaches: Float64Array.of(0, -1) }],
    ],
    ['trace: reaches: got NaN', [two, undefined, undefined, { reaches: Float64Array.of(Number.NaN, 0) }]],
    ['trace: reaches: got Infinity', [two, undefined, undefined, { reaches: Float64Array.of(Infinity, 0) }]],
    ['trace: reaches: got [1, 0], expected a Float64Array', [two, undefined, undefined, { reaches: [1, 0] }]],
    ['trace: groups: got [1.5, 0], expected a Uint32Array', [two, undefined, undefined, { groups: [1.5, 0] }]],
    ['trace: groups.length: got 1, expected 2', [two, undefined, undefined, { groups: Uint32Array.of(1) }]],
    ['trace: rules: got [1, 1, 0, 1, 1, 0], expected a Uint32Array', [two, undefined, [1, 1, 0, 1, 1, 0]]],
    ['trace: boxes: got [0, 0, 1, 1], expected a Float32Array', [[0, 0, 1, 1]]],
    ['trace: boxes: got undefined, expected a Float32Array', []],
  ])('frame: %s', (message, given) => {
    const writer = new TraceWriter(2);
    expect(() => (writer.frame as never as (...given: unknown[]) => unknown).apply(writer, given)).toThrow(message);
    expect(joined(writer.header(), writer.frame(two), writer.end())).toEqual(traceOf(two));
  });

  test('whatever the order of the calls', () => {
    const writer = new TraceWriter(2);
    const [frame, head, end] = [writer.frame(two), writer.header(), writer.end()];
    expect(joined(head, frame, end)).toEqual(traceOf(two));
    const wrap = [10, 10];
    const other = new TraceWriter(2, wrap);
    wrap[0] = -1;
    expect(openTrace(joined(other.header(), other.frame(two), other.end())).wrap).toEqual([10, 10]);
  });
});

test('a frame of other dimensions leaves a space as it was', () => {
  const space = new BroadPhase({ dimensions: 3 }).set(7, 0, 0, 0, 1, 1, 1).update();
  for (const ids of [undefined, [2, 5]]) {
    const [frame] = openTrace(traceOf(Float32Array.of(0, 0, 1, 1, 0, 0, 1, 1), ids));
    expect(() => applyFrame(space, frame!)).toThrow('applyFrame: got a frame of 2 dimensions, expected 3');
    expect([...space.keys()]).toEqual([7]);
  }
});

describe('bytes are no trace yet for', () => {
  test.each<[string, (given: never) => unknown]>([
    ['replay', (given) => [...replay(given)]],
    ['survey', (given) => survey(given)],
    ['compare', (given) => compare(given)],
    ['tune', (given) => tune(given)],
    ['exportRecording', (given) => exportRecording(given)],
  ])('%s', (name, call) => {
    for (const [given, shown] of [
      [traceOf(), '[object Uint8Array]'],
      [null, 'null'],
      ['a.trace', '"a.trace"'],
    ] as const) {
      const message = `${name}: got ${shown}, expected a trace, as of openTrace`;
      expect(() => call(given as never)).toThrow(new TypeError(message));
    }
  });

  test('readTrace', async () => {
    for (const given of [traceOf(), null, 'a.trace']) {
      const frames = readTrace(given as never);
      await expect(frames.next()).rejects.toThrow(/^readTrace: got .*, expected a stream of bytes/);
    }
  });
});

describe('mistyped options of traces are refused:', () => {
  const bytes = traceOf(Float32Array.of(0, 0, 1, 1));
  const source = openTrace(bytes);
  const boxes = [0, 0, 1, 1, 0, 0, 1, 1];
  test.each<[string, () => unknown]>([
    [
      'openTrace: there is no option "salvag", did you mean "salvage"?',
      () => openTrace(bytes, loose({ salvag: true })),
    ],
    ['openTrace: got 3, expected an object of options', () => openTrace(bytes, loose(3))],
    ['importRecording: got null, expected an object of options', () => importRecording(bytes, loose(null))],
    ['tune: there is no option "second", did you mean "seconds"?', () => tune(source, loose({ second: 1 }))],
    ['passes: got -1, expected an integer, 1 or more', () => compare(source, { passes: -1 })],
    ['passes: got 0, expected an integer, 1 or more', () => compare(source, { passes: 0 })],
    ['passes: got "a", expected an integer, 1 or more', () => compare(source, loose({ passes: 'a' }))],
    ['techniques: got "auto", expected an array of names', () => compare(source, loose({ techniques: 'auto' }))],
    ['boxes.length: got 9, expected 8', () => exactPairs(new Float32Array(9), 2)],
    ['boxes.length: got 8, expected 6', () => exactPairs(boxes, 3)],
    ['dimensions: got "2", expected 2 or 3', () => exactPairs(boxes, '2' as never)],
    ['ids.length: got 1, expected 2', () => exactPairs(boxes, 2, [7])],
  ])('%s', (message, call) => {
    expect(call).toThrow(message);
  });

  test('openAny', async () => {
    await expect(openAny(bytes, loose({ salvag: true }))).rejects.toThrow('openTrace: there is no option "salvag"');
  });

  test('those of a space are taken by compare', () => {
    expect(compare(source, { techniques: ['auto'], cellSize: 5, touching: false, passes: 1 })).toHaveLength(1);
  });
});

describe('drawSpace refuses, and draws nothing:', () => {
  const drawn: string[] = [];
  const context = new Proxy({} as CanvasRenderingContext2D, {
    get: (_, name) => () => drawn.push(String(name)),
    set: (_, name) => drawn.push(String(name)) > 0,
  });
  const space = new BroadPhase().set(1, 0, 0, 1, 1).update();
  const draw = (options?: unknown) => [context, space, options];
  test.each<[string, unknown[]]>([
    ['drawSpace: got [object BroadPhase], expected a 2D context', [space, context]],
    ['drawSpace: got null, expected a 2D context', [null, space]],
    ['drawSpace: got [object Object], expected a 2D context', [{ getContext: () => context }, space]],
    ['drawSpace: got [object Object], expected a BroadPhase', [context, {}]],
    ['drawSpace: got undefined, expected a BroadPhase', [context]],
    ['drawSpace: options: got null, expected an object', draw(null)],
    ['drawSpace: options: got "cell", expected one of boxes, pairs', draw({ cell: true })],
    ['drawSpace: colors: got "red", expected an object', draw({ colors: 'red' })],
    ['drawSpace: colors.pairs: got 5, expected a string', draw({ colors: { boxes: 'red', pairs: 5 } })],
    ['drawSpace: colors.rays: got [object Object], expected a string', draw({ colors: { rays: {} } })],
    ['drawSpace: cells: got 1, expected true or false', draw({ cells: 1 })],
    ['drawSpace: lineWidth: got NaN, expected a number above 0', draw({ lineWidth: Number.NaN })],
    ['drawSpace: lineWidth: got -1, expected a number above 0', draw({ lineWidth: -1 })],
    ['drawSpace: lineWidth: got "2", expected a number above 0', draw({ lineWidth: '2' })],
    ['drawSpace: rays: got 5, expected an array', draw({ rays: 5 })],
    ['drawSpace: rays: got 5, expected 4 finite numbers', draw({ rays: [5] })],
    [
      'drawSpace: rays: got [0, 0, NaN, 1], expected 4 finite numbers',
      draw({
        rays: [
          [0, 0, 1, 0],
          [0, 0, Number.NaN, 1],
        ],
      }),
    ],
    ['drawSpace: rays: got [0, 0, 1, 0, -1], expected 4 finite numbers', draw({ rays: [[0, 0, 1, 0, -1]] })],
  ])('%s', (message, given) => {
    expect(() => (drawSpace as (...given: unknown[]) => void)(...given)).toThrow(message);
    expect(drawn).toEqual([]);
  });
});

test('Lines names a wrong space, and dimensions as text', () => {
  expect(() => new Lines().addBoxes({} as never)).toThrow('addBoxes: got [object Object], expected a BroadPhase');
  expect(() => new Lines().addRay(null as never, [0, 0, 1, 0])).toThrow('addRay: got null, expected a BroadPhase');
  expect(() => new Lines('3' as never)).toThrow('new Lines: got "3", expected 2 or 3 dimensions');
});

describe('the command', () => {
  const folder = mkdtempSync(join(tmpdir(), 'broadphase-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  const file = (name: string, bytes: Uint8Array) => {
    writeFileSync(join(folder, name), bytes);
    return join(folder, name);
  };

  test('says that a trace has no frames', async () => {
    const writer = new TraceWriter(2);
    const empty = file('empty.trace', joined(writer.header(), writer.end()));
    expect(await runCommand(['info', empty, '--frames', '1..1'])).toMatchObject({
      code: 2,
      err: expect.stringContaining('--frames is 1..1, but the trace has no frames'),
    });
    expect(await runCommand(['compare', empty])).toMatchObject({
      code: 3,
      out: '',
      err: expect.stringContaining('empty.trace: no frames to compare on'),
    });
  });

  test('gives frames that are there as an example', async () => {
    const { err } = await runCommand(['info', file('one.trace', traceOf()), '--frames', '1..1']);
    expect(err).toContain('--frames is 1..1, expected two numbers from 0 to 0, such as 0..0');
  });

  test('does not take an empty name for the folder it is in', async () => {
    for (const name of ['', ' ']) {
      const { code, err } = await runCommand(['init', name]);
      expect([code, err]).toEqual([
        2,
        expect.stringContaining('the folder has no name, expected a new or empty folder'),
      ]);
    }
  });
});

describe('broadphase/ro', () => {
  test('refuses an unknown option of a world', () => {
    expect(() => new World(null, { timestep: 5 } as never)).toThrow(
      'ro.World: there is no option "timestep", expected one of coltech, debug, scale, timeStep, init, draw',
    );
  });

  test('shows text where numbers should be as text', () => {
    expect(() => new Entity('0' as never, 0, 1, 1)).toThrow('pos is { x: "0", y: 0 }, expected finite numbers');
    expect(ov3.str({ x: 1, y: -2.5 })).toBe('{ x: 1, y: -2.5 }');
  });
});

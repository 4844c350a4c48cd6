// What a reader of the sources found: recordings that lose what they cannot say, and arrays of another query.
import { BroadPhase } from 'broadphase';
import { drawSpace } from 'broadphase/draw';
import { exportRecording, openTrace, readTrace, record, replay, tune } from 'broadphase/trace';
import { expect, test } from 'vitest';

const touching = [0, 0, 1, 1, 1, 0, 2, 1];

function recorded(space: BroadPhase<2>) {
  const recording = record(space);
  space.setAll(Float32Array.from(touching)).update();
  return recording.bytes();
}

test('a raw recording cannot say that a world wraps around, nor that touching is not enough', () => {
  for (const options of [{ wrap: [100, 100] }, { touching: false }]) {
    const source = openTrace(recorded(new BroadPhase(options)));
    expect(() => exportRecording(source)).toThrow(/^the raw layout cannot say that/);
  }
  expect(exportRecording(openTrace(recorded(new BroadPhase()))).length).toBe(16 + 32);
});

test.each([
  [{}, { touching: false }, 0],
  [{ touching: false }, { touching: true }, 1],
  [{ touching: false }, {}, 0],
  [{ wrap: [1.5, 10] }, { wrap: undefined }, 1],
] as const)('a replay with other options is checked by these: %o, then %o', (options, others, pairs) => {
  const space = new BroadPhase(options as object);
  const source = openTrace(recorded(space as BroadPhase<2>));
  const [frame] = [...replay(source, others as object, true)];
  expect(frame).toMatchObject({ pairs, difference: null });
});

test('of a long trace, tuning keeps windows even if its first frame is empty', () => {
  const large = new Float32Array(2 ** 22); // 16 MiB: eight of them are 2^27 bytes
  for (let k = 0; k < large.length; k += 4) large.set([k, 0, k + 1, 1], k);
  let kept = 0;
  const frames = 40;
  const source = {
    dimensions: 2 as const,
    frames,
    *[Symbol.iterator]() {
      for (let index = 0; index < frames; index++) {
        const boxes = index === 0 ? large.subarray(0, 0) : large.subarray(0, large.length);
        boxes.slice = () => {
          kept += index > 0 ? 1 : 0;
          return large.slice(0, 4);
        };
        yield { index, count: boxes.length / 4, ids: undefined, boxes, changed: 0 };
      }
    },
  };
  try {
    tune(source as never, { techniques: ['brute-force'], seconds: 0.01 });
  } catch {
    // The copies are not what the frames say: only how many are kept matters.
  }
  expect(kept).toBeGreaterThan(0);
  expect(kept).toBeLessThanOrEqual(8);
});

test('whoever stops reading a stream of a trace has closed it', async () => {
  const bytes = recorded(new BroadPhase());
  let cancelled = false;
  const stream = new ReadableStream<Uint8Array>({
    pull: (controller) => controller.enqueue(bytes),
    cancel: () => {
      cancelled = true;
    },
  });
  for await (const _ of readTrace(stream)) break;
  expect([cancelled, stream.locked]).toEqual([true, false]);
  let closed = false;
  async function* chunks() {
    try {
      for (;;) yield Uint8Array.of(1, 2, 3);
    } finally {
      closed = true;
    }
  }
  await expect(readTrace(chunks()).next()).rejects.toThrow('not a trace');
  expect(closed).toBe(true);
});

test('arrays that another query left in `out` are not touched', () => {
  const space = new BroadPhase().set(7, 21, -5, 22, 5).update();
  const out = {
    ids: new Uint32Array(4),
    offsets: new Uint32Array(4),
    times: new Float64Array(4),
    normals: new Int8Array(8),
    distances: new Float64Array(4).fill(9),
    of: new Uint32Array(4).fill(9),
  };
  space.sweeps([0, 0, 1, 1, 40, 0], { out });
  expect([out.times[0], out.distances[0]]).toEqual([0.5, 9]);
  space.nearests([0, 0], 1, { out });
  expect([out.times[0], out.distances[0], out.of[0]]).toEqual([0.5, 21, 9]);
});

test('a colour that is undefined is the usual one, and one that is misspelt is refused', () => {
  const colours: unknown[] = [];
  const context = new Proxy(
    {},
    {
      get: () => () => ({}),
      set: (_, name, value) => {
        if (name === 'strokeStyle') colours.push(value);
        return true;
      },
    },
  ) as CanvasRenderingContext2D;
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  drawSpace(context, space, { pairs: false, colors: { boxes: undefined } as object });
  expect(colours).toContain('#8893a5');
  expect(colours).not.toContain(undefined);
  const count = colours.length;
  expect(() => drawSpace(context, space, { colors: { box: 'red' } as object })).toThrow(
    'drawSpace: colors: got "box", expected one of boxes, pairs, cells, hot, rays',
  );
  expect(colours.length).toBe(count);
});

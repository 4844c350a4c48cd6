// Recording a space: whatever is called between updates, the trace holds what stood there, and replays to its pairs.
import { PassThrough, Writable } from 'node:stream';
import { BroadPhase } from 'broadphase';
import { applyFrame, openTrace, record, replay, TraceError } from 'broadphase/trace';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { concat } from '../support/random-frames.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const numRuns = runs(100);

type Call = (space: BroadPhase<2 | 3>) => void;

function aCall(dimensions: 2 | 3): fc.Arbitrary<Call> {
  const side = fc.oneof(fc.integer({ min: -9, max: 9 }), fc.double({ min: -9, max: 9, noNaN: true }));
  const size = fc.integer({ min: 0, max: 40 }).map((tenths) => tenths / 10);
  const axes = { minLength: dimensions, maxLength: dimensions };
  const box = fc
    .array(fc.tuple(side, size), axes)
    .map((sides) => [...sides.map(([min]) => min), ...sides.map(([min, extent]) => min + extent)]);
  const id = fc.oneof(fc.nat(12), fc.constantFrom(5000, 2 ** 24 - 1));
  const boxes = fc.array(box, { maxLength: 10 }).map((list) => list.flat());
  return fc.oneof(
    {
      weight: 6,
      arbitrary: fc.tuple(id, box).map(
        ([id, box]): Call =>
          (space) =>
            void setBox(space, id, box),
      ),
    },
    {
      weight: 3,
      arbitrary: id.map(
        (id): Call =>
          (space) =>
            void space.delete(id),
      ),
    },
    {
      weight: 2,
      arbitrary: fc.tuple(id, fc.nat(3), fc.nat(3)).map(
        ([id, layer, mask]): Call =>
          (space) =>
            void (space.has(id) && space.setFilter(id, layer, mask)),
      ),
    },
    {
      weight: 2,
      arbitrary: fc.tuple(id, fc.boolean()).map(
        ([id, still]): Call =>
          (space) =>
            void (space.has(id) && space.setStatic(id, still)),
      ),
    },
    { weight: 4, arbitrary: fc.constant<Call>((space) => void space.update()) },
    { weight: 1, arbitrary: fc.constant<Call>((space) => space.clear()) },
    {
      weight: 1,
      arbitrary: boxes.map(
        (list): Call =>
          (space) =>
            void space.setAll(list),
      ),
    },
    {
      weight: 1,
      arbitrary: boxes.map(
        (list): Call =>
          (space) =>
            void space.setAll(Float32Array.from(list)),
      ),
    },
    {
      weight: 1,
      arbitrary: boxes.map(
        (list): Call =>
          (space) =>
            space.boxes(list.length / (2 * dimensions)).set(list),
      ),
    },
  );
}

describe.each([2, 3] as const)(`a recording in ${'%d'} dimensions (SEED=${seed})`, (dimensions) => {
  test('replays to the same boxes and the same pairs, in the same order', () => {
    const property = fc.property(fc.array(aCall(dimensions), { maxLength: 60, size: 'max' }), (calls) => {
      const space = new BroadPhase({ dimensions });
      setBox(space, 3, dimensions === 2 ? [0, 0, 1, 1] : [0, 0, 0, 1, 1, 1]); // there before the recording begins
      const recording = record(space);
      const pairs: number[][] = [];
      const sizes: number[] = [];
      const update = space.update.bind(space);
      space.update = () => {
        update();
        pairs.push([...space.pairs]);
        sizes.push(space.size);
        return space;
      };
      for (const call of calls) call(space);
      space.update();
      const twin = new BroadPhase({ dimensions });
      const trace = openTrace(recording.bytes());
      expect(trace.frames).toBe(pairs.length);
      for (const frame of trace) {
        applyFrame(twin, frame);
        expect([...twin.update().pairs]).toEqual(pairs[frame.index]);
        expect(frame.count).toBe(sizes[frame.index]);
      }
      for (let id = 0; id < 13; id++) expect(twin.get(id)).toEqual(space.get(id));
    });
    fc.assert(property, { seed, numRuns });
  });
});

const moving = (space: BroadPhase<2 | 3>, recorded: () => number) => {
  for (let k = 0; k < 10; k++)
    space
      .set(1, k, 0, k + 1, 1)
      .set(2, 5, 0, 6, 1)
      .update();
  return recorded();
};

test('a space is recorded once at a time, from record to stop', async () => {
  const space = new BroadPhase();
  const recording = record(space);
  expect(() => record(space)).toThrow('recorded already');
  expect(moving(space, () => recording.frames)).toBe(10);
  await recording.stop();
  await recording.stop();
  expect(moving(space, () => recording.frames)).toBe(10);
  const trace = openTrace(recording.bytes());
  expect(trace.frames).toBe(10);
  expect(recording.bytes().length).toBe(recording.byteLength);
  const again = record(space);
  space.update();
  expect(again.frames).toBe(1);
});

test('filters and static boxes are recorded and replayed: only changes are set again', () => {
  const space = new BroadPhase();
  const recording = record(space);
  space.setAll([0, 0, 4, 4, 1, 1, 5, 5, 2, 2, 6, 6]).update(); // nobody has a rule yet
  space.setStatic(0).setStatic(1).update();
  space.setFilter(2, 4, 0xfffffffe).update();
  space.update();
  space.setStatic(0, false).update();
  const rules = Array.from(openTrace(recording.bytes()), (frame) => frame.rules && [...frame.rules]);
  const all = 0xffffffff;
  expect(rules[0]).toBeUndefined();
  expect(rules[1]).toEqual([all, all, 1, all, all, 1, all, all, 0]);
  expect(rules[2]).toEqual([all, all, 1, all, all, 1, 4, 0xfffffffe, 0]);
  expect(rules[3]).toEqual(rules[2]);
  expect(rules[4]).toEqual([all, all, 0, all, all, 1, 4, 0xfffffffe, 0]);

  const twin = new BroadPhase();
  const told: string[] = [];
  const { setFilter, setStatic } = twin;
  twin.setFilter = (...given) => {
    told.push(`filter ${given}`);
    return setFilter.apply(twin, given);
  };
  twin.setStatic = (...given) => {
    told.push(`static ${given}`);
    return setStatic.apply(twin, given);
  };
  const pairs: number[][] = [];
  for (const frame of openTrace(recording.bytes())) {
    applyFrame(twin, frame);
    pairs.push([...twin.update().pairs]);
  }
  expect(told).toEqual(['static 0,true', 'static 1,true', 'filter 2,4,4294967294', 'static 0,false']);
  expect(pairs.map((list) => list.length / 2)).toEqual([3, 2, 2, 2, 3]);
});

test('a replay with filters, static boxes and ids is checked against an answer that knows of them', () => {
  const space = new BroadPhase();
  const recording = record(space);
  for (let frame = 0; frame < 4; frame++) {
    for (let k = 0; k < 60; k++) {
      const at = (k * 7 + frame * (k % 3)) % 23;
      space.set(3 * k + 1, at, at, at + 4, at + 4);
      if (frame === 0) space.setFilter(3 * k + 1, 1 << (k % 3), k % 5).setStatic(3 * k + 1, k % 4 === 0);
    }
    space.update();
  }
  const trace = openTrace(recording.bytes());
  for (const technique of BroadPhase.techniques) {
    const played = [...replay(trace, { technique }, true)];
    expect(
      played.map(({ difference }) => difference),
      technique,
    ).toEqual([null, null, null, null]);
    expect(played[3].pairs).toBe(space.pairCount);
    expect(played[3].pairs).toBeGreaterThan(0);
  }
});

test('the bytes so far are a whole trace while the recording goes on', () => {
  const space = new BroadPhase();
  const recording = record(space);
  expect(openTrace(recording.bytes()).frames).toBe(0);
  space.update();
  expect(openTrace(recording.bytes()).frames).toBe(1);
  space.set(0, 0, 0, 1, 1).update();
  expect(Array.from(openTrace(recording.bytes()), (frame) => frame.count)).toEqual([0, 1]);
});

test('an update that fails is no frame', () => {
  const space = new BroadPhase();
  const recording = record(space);
  space.boxes(1)[0] = Number.NaN;
  expect(() => space.update()).toThrow('NaN');
  expect(recording.frames).toBe(0);
});

test('a stream gets the same bytes, and after a crash all frames but the last are there', async () => {
  const spaces = [new BroadPhase(), new BroadPhase(), new BroadPhase()];
  const web: Uint8Array[] = [];
  const node = new PassThrough();
  const recordings = [
    record(spaces[0]),
    record(spaces[1], { to: new WritableStream<Uint8Array>({ write: (bytes) => void web.push(bytes) }) }),
    record(spaces[2], { to: node }),
  ];
  for (const space of spaces) moving(space, () => 0);
  await Promise.all(recordings.map((recording) => recording.stop()));
  expect(concat(web)).toEqual(recordings[0].bytes());
  expect(new Uint8Array(node.read())).toEqual(recordings[0].bytes());
  expect(() => recordings[1].bytes()).toThrow('was not kept');

  const crashed = concat(web.slice(0, 8)).subarray(0, -3);
  expect(() => openTrace(crashed)).toThrow(TraceError);
  expect(openTrace(crashed, { salvage: true }).frames).toBe(6);
});

test('a stream that fails ends the recording, not the game', async () => {
  const full = new Error('disk full');
  const web = new BroadPhase();
  const webRecording = record(web, { to: new WritableStream({ write: () => Promise.reject(full) }) });
  const node = new BroadPhase();
  const nodeRecording = record(node, {
    to: new Writable({ write: (_chunk, _encoding, done) => done(full) }),
  });
  for (let k = 0; k < 3; k++) {
    moving(web, () => 0);
    moving(node, () => 0);
    await new Promise((resolve) => setTimeout(resolve, 1));
  }
  expect(webRecording.frames).toBeLessThan(30);
  expect(nodeRecording.frames).toBeLessThan(30);
  expect(webRecording.fault).toBe(full);
  await expect(webRecording.stop()).rejects.toBe(full);
  await expect(nodeRecording.stop()).rejects.toBe(full);
});

test('groups and reaches come and go from frame to frame, also those of boxes that had none', () => {
  const space = new BroadPhase();
  const recording = record(space);
  for (const id of [0, 1, 2]) space.set(id, id, 0, id + 1, 1);
  const frames: unknown[] = [];
  const told = (from: BroadPhase) => [0, 1, 2].flatMap((id) => [from.groupOf(id), from.reachOf(id)]);
  for (const [group, reach] of [
    [0, 0],
    [1, 1],
    [2, 0.5],
    [0, 1],
    [1, 0],
    [0, 0],
  ] as const) {
    space.setGroup(0, group).setReach(1, reach).update();
    frames.push(told(space));
  }
  const twin = new BroadPhase();
  for (const frame of openTrace(recording.bytes())) {
    applyFrame(twin, frame);
    expect(told(twin.update())).toEqual(frames[frame.index]);
  }
});

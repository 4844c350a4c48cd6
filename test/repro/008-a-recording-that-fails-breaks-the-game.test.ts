// A `record()` that failed left a space whose every `update()` threw for good, and frames written to a stream that had
// ended were lost in silence. The same kind: whatever fails half-way leaves things as they were.
import { PassThrough, Writable } from 'node:stream';
import { BroadPhase, init } from 'broadphase';
import { openTrace, type RecordOptions, record } from 'broadphase/trace';
import { describe, expect, test } from 'vitest';

const space = () => new BroadPhase().set(0, 0, 0, 10, 10).set(1, 5, 5, 15, 15);
const soon = () => new Promise((resolve) => setTimeout(resolve, 5));
const throws = {
  write: () => {
    throw new Error('no room');
  },
  end: () => {},
  on: () => {},
};

describe('record() that is refused leaves the space as it was', () => {
  const locked = new WritableStream();
  locked.getWriter();
  const ended = new PassThrough();
  ended.end();
  test.each<[string, unknown, string]>([
    ['a file name', 'my.trace', 'record: to: got "my.trace", expected a WritableStream or a Node stream'],
    ['null', null, 'record: to: got null'],
    ['an object', {}, 'record: to: got [object Object]'],
    ['a number', 5, 'record: to: got 5'],
    ['a locked stream', locked, 'locked'],
    ['a stream that has ended', ended, 'record: the stream has ended'],
    ['a stream that throws', throws, 'no room'],
  ])('%s', (_, to, message) => {
    const mine = space();
    expect(() => record(mine, { to } as RecordOptions)).toThrow(message);
    expect(mine.update().pairCount).toBe(1);
    const recording = record(mine);
    mine.update();
    expect(recording.frames).toBe(1);
  });

  test('a space that is already recorded: the stream stays unlocked, the first recording continues', () => {
    const mine = space();
    const first = record(mine);
    const to = new WritableStream<Uint8Array>();
    expect(() => record(mine, { to })).toThrow('recorded already');
    expect(to.locked).toBe(false);
    mine.update();
    expect(first.frames).toBe(1);
  });

  test('what is no space, and options that there are not', () => {
    expect(() => record({} as BroadPhase)).toThrow('record: got [object Object], expected a BroadPhase');
    expect(() => record(space(), { too: 1 } as RecordOptions)).toThrow(
      'record: there is no option "too", did you mean "to"?',
    );
  });
});

describe('a stream that fails later ends the recording, and says so', () => {
  test('it was ended by another', async () => {
    const to = new PassThrough();
    const mine = space();
    const recording = record(mine, { to });
    mine.update();
    to.end();
    for (let k = 0; k < 3; k++) expect(mine.update().pairCount).toBe(1);
    expect(recording.frames).toBeLessThan(4);
    expect(String(recording.fault)).toContain('the stream has ended');
    await expect(recording.stop()).rejects.toThrow('the stream has ended');
  });

  test('it was destroyed between two frames', async () => {
    const to = new PassThrough();
    const mine = space();
    const recording = record(mine, { to });
    to.destroy();
    await soon();
    expect(String(recording.fault)).toContain('closed before the recording was stopped');
    expect(mine.update().pairCount).toBe(1);
    await expect(recording.stop()).rejects.toThrow('closed');
  });

  test('it throws in the middle of an update', async () => {
    let calls = 0;
    const to = { ...throws, write: () => void (++calls > 2 && throws.write()) };
    const mine = space();
    const recording = record(mine, { to });
    for (let k = 0; k < 5; k++) expect(mine.update().pairCount).toBe(1);
    expect(String(recording.fault)).toContain('no room');
    await expect(recording.stop()).rejects.toThrow('no room');
    expect(() => record(mine)).not.toThrow();
  });

  test('it says no to the last bytes', async () => {
    const to = new Writable({ write: (_bytes, _encoding, done) => done(), final: (done) => done(new Error('late')) });
    const mine = space();
    const recording = record(mine, { to });
    mine.update();
    await expect(recording.stop()).rejects.toThrow('late');
  });
});

test('what was recorded before the fault is there', () => {
  const mine = space();
  const recording = record(mine);
  mine.update();
  expect(openTrace(recording.bytes()).frames).toBe(1);
});

test('a visitor that throws, disposes the space or makes queries leaves the space intact', () => {
  const mine = space().update();
  const enough = () => {
    throw new Error('enough');
  };
  for (let k = 0; k < 3; k++) {
    expect(() => mine.queryBox(0, 0, 9, 9, { visit: enough })).toThrow('enough');
    expect(() => mine.nearest(0, 0, 5, { visit: () => mine.rayCastAll(-1, 1, 1, 0, { visit: enough }) })).toThrow(
      'enough',
    );
    expect(() => mine.sweep(-9, 0, -8, 9, 9, 0, { visit: enough })).toThrow('enough');
  }
  expect(mine.queryBox(0, 0, 9, 9).sort()).toEqual([0, 1]);
  expect(() => mine.queryBox(0, 0, 9, 9, { visit: () => mine.dispose() })).toThrow('disposed');
});

test('init with what is no kernel leaves the kernel that was there', () => {
  const other = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);
  expect(() => init(other)).toThrow('init: got a module that is not a kernel');
  expect(() => init(new WebAssembly.Module(other))).toThrow('not a kernel');
  expect(() => init(Uint8Array.of(1, 2, 3))).toThrow();
  expect(space().update().pairCount).toBe(1);
});

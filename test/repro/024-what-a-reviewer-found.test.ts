// What a reader of the code found: spaces that a replay did not dispose of, rules that a survey left out, errors that named
// no call, and pages that drew too thick on displays with three pixels per CSS pixel.
import { BroadPhase } from 'broadphase';
import {
  compare,
  gunzip,
  importRecording,
  openAny,
  openTrace,
  record,
  replay,
  survey,
  Trace,
  tune,
} from 'broadphase/trace';
import { afterEach, describe, expect, test, vi } from 'vitest';

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

/** A trace of two boxes that meet, with the rules that `rule` sets. */
function traceOf(rule: (space: BroadPhase) => void = () => {}): Uint8Array<ArrayBuffer> {
  const space = new BroadPhase();
  const recording = record(space);
  for (let x = 0; x < 3; x++) {
    space.set(0, x, 0, x + 4, 4).set(1, 5, 0, 9, 4);
    rule(space);
    space.update();
  }
  return recording.bytes();
}

describe('spaces of a replay are disposed of, however it ends', () => {
  /** How many spaces were created while `run` ran, and were not disposed of. */
  function left(run: () => void): number {
    const dispose = vi.spyOn(BroadPhase.prototype, 'dispose');
    let made = 0;
    const { Instance } = WebAssembly;
    vi.stubGlobal('WebAssembly', {
      ...Object.fromEntries(Object.getOwnPropertyNames(WebAssembly).map((name) => [name, WebAssembly[name as never]])),
      Instance: new Proxy(Instance, {
        construct(target, given: [WebAssembly.Module]) {
          if (WebAssembly.Module.exports(given[0]).some(({ name }) => name === 'open_space')) made++;
          return new target(...given);
        },
      }),
    });
    run();
    return made - dispose.mock.calls.length;
  }
  const stop = () => {
    throw new Error('stop');
  };
  const source = openTrace(traceOf());
  const techniques = ['brute-force', 'strip-sweep'] as const;

  test.each<[string, () => void]>([
    ['replay, left after a frame', () => void first(replay(source))],
    ['replay', () => void [...replay(source, {}, true)]],
    ['compare', () => void compare(source, { passes: 1 })],
    ['compare, whose progress throws', () => expect(() => compare(source, { progress: stop })).toThrow('stop')],
    ['survey', () => void survey(source)],
    ['survey, whose progress throws', () => expect(() => survey(source, stop)).toThrow('stop')],
    ['tune', () => void tune(source, { techniques, seconds: 0.01 })],
    [
      'tune, whose progress throws in the final',
      () => expect(() => tune(source, { techniques, progress: (what) => what === 'final' && stop() })).toThrow('stop'),
    ],
    [
      'compare, with a technique that there is not',
      () => expect(() => compare(source, { techniques: ['auto', 'none' as never] })).toThrow(RangeError),
    ],
  ])('%s', (_, run) => {
    expect(left(run)).toBe(0);
  });

  function first<T>(frames: Iterable<T>): T | undefined {
    for (const frame of frames) return frame;
    return undefined;
  }
});

describe('a survey knows every rule', () => {
  test.each<[string, (space: BroadPhase) => void]>([
    ['a filter', (space) => space.setFilter(0, 1, 1)],
    ['a static box', (space) => space.setStatic(0)],
    ['a box that is off', (space) => space.setEnabled(0, false)],
    ['a group', (space) => space.setGroup(0, 7)],
    ['a reach', (space) => space.setReach(0, 0.5)],
  ])('%s', (_, rule) => {
    expect(survey(openTrace(traceOf(rule))).rules).toBe(true);
  });

  test('there is none', () => {
    expect(survey(openTrace(traceOf())).rules).toBe(false);
  });
});

describe('detached bytes are refused by the call that got them', () => {
  const detached = new Uint8Array(64);
  structuredClone(detached, { transfer: [detached.buffer] });

  test.each<[string, (bytes: Uint8Array) => unknown]>([
    ['openTrace', openTrace],
    ['Trace', (bytes) => new Trace(bytes)],
    ['importRecording', importRecording],
    ['openAny', openAny],
    ['gunzip', gunzip],
  ])('%s', async (name, call) => {
    await expect((async () => call(detached))()).rejects.toThrow(`${name}: got detached memory`);
  });
});

describe('boxes of the pages', () => {
  /** The pixels of a large box, on a canvas of two pixels per CSS pixel, by a display with more or as many. */
  async function painted(devicePixelRatio: number): Promise<Uint8ClampedArray> {
    const shown: { data: Uint8ClampedArray }[] = [];
    const context = { putImageData: (image: { data: Uint8ClampedArray }) => shown.push(image) };
    vi.stubGlobal('devicePixelRatio', devicePixelRatio);
    vi.stubGlobal(
      'ImageData',
      class {
        readonly data: Uint8ClampedArray;
        readonly width: number;
        readonly height: number;
        constructor(width: number, height: number) {
          this.data = new Uint8ClampedArray(4 * width * height);
          this.width = width;
          this.height = height;
        }
      },
    );
    const { CanvasRenderer } = await import('../../site/shared/renderer-canvas.ts');
    const { Camera } = await import('../../site/shared/camera.ts');
    const { makePalette } = await import('../../site/shared/palette.ts');
    const renderer = new CanvasRenderer({ getContext: () => context } as unknown as HTMLCanvasElement);
    renderer.setPalette(makePalette(false, '#ffffff'));
    const camera = new Camera();
    camera.resize(80, 80);
    camera.fit([0, 0, 80, 80]);
    renderer.draw(Float32Array.of(10, 10, 70, 70), Uint8Array.of(1), 1, camera);
    return shown[0].data;
  }

  test('have outlines as thin on a display with three pixels per CSS pixel, where canvases have two', async () => {
    expect(await painted(3)).toEqual(await painted(2));
  });
});

// `broadphase generate`: a trace of a seeded scene.
import type { Frame, FrameSource } from 'broadphase/trace';
import { createScene, gameNames, type SceneName, sceneNames } from '../scenes/index.ts';
import { type Command, exitCode, UsageError } from './arguments.ts';
import { checkWritable, writeFrames } from './files.ts';
import { bytes, counted, number, progressBar } from './terminal.ts';

const names: readonly SceneName[] = [...sceneNames, ...gameNames];

/** The limit of a space. */
const mostBoxes = 2 ** 24;
/** The limit for all frames together: takes about 1 GB while it is written. */
const mostInAll = 2 ** 27;

export const generateCommand: Command = {
  summary: 'write a trace of a seeded scene',
  operands: { scene: names.join(', '), file: 'the file to write; with .gz at the end, gzipped' },
  options: {
    count: { value: 'n', help: 'number of boxes (10000)' },
    frames: { value: 'n', help: 'number of frames (60)' },
    seed: { value: 'n', help: 'the same seed gives the same scene (1)' },
    speed: { value: 'n', help: 'the largest distance a box moves per frame; boxes are about 10 wide (2)' },
  },
  async run(input, terminal) {
    const [name, path] = input.operands;
    if (!names.includes(name as SceneName)) {
      throw new UsageError(`no scene ${name}, expected one of ${names.join(', ')}`);
    }
    const count = input.number('count', { least: 0, most: mostBoxes, whole: true }) ?? 10_000;
    const frames = input.number('frames', { least: 0, most: mostInAll, whole: true }) ?? 60;
    const seed = input.number('seed', { least: 0, most: 2 ** 32 - 1, whole: true }) ?? 1;
    const speed = input.number('speed', { least: 0, most: 1e6 }) ?? 2;
    if (count * frames > mostInAll) {
      const asked = `${number(frames)} frames of ${number(count)} boxes are ${number(count * frames)} boxes`;
      throw new UsageError(`${asked}, expected at most ${number(mostInAll)} in all: they are held in memory`);
    }
    await checkWritable('<file>', path, []);
    const dimensions = name.endsWith('3d') ? 3 : 2;
    const progress = progressBar(terminal);
    const source: FrameSource = {
      dimensions,
      frames,
      *[Symbol.iterator](): Generator<Frame> {
        const scene = createScene(name as SceneName, count, { seed, speed });
        for (let index = 0; index < frames; index++) {
          if (index > 0) scene.step();
          progress.show('frames', index, frames);
          yield { index, count, ids: undefined, boxes: scene.boxes, changed: count };
        }
      },
    };
    const size = await writeFrames(path, { source, first: 0 });
    progress.end();
    if (input.has('json')) {
      terminal.out(`${JSON.stringify({ path, scene: name, dimensions, count, frames, bytes: size })}\n`);
    } else terminal.out(`${path}: ${counted(frames, 'frame')} of ${counted(count, 'box')}, ${bytes(size)}\n`);
    return exitCode.ok;
  },
};

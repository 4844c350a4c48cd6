// The scenes of the pages: seeded ones of any number of boxes, and a recorded one, under one interface.
import { createScene, type SceneName } from '../../src/scenes/index.ts';
import { framesOf, type RecordedFrames } from '../../src/scenes/recorded.ts';
import { openAny } from '../../src/trace/import.ts';
import type { World } from './camera.ts';

/** A scene that a page runs: each step moves the boxes by one frame, in place. */
export interface LiveScene {
  readonly count: number;
  readonly boxes: Float32Array;
  readonly world: World;
  step(): void;
}

const topSpeed = 2;

/** A seeded 2D scene. With few boxes the world is small, so they move more slowly. */
export function seededScene(name: SceneName, count: number): LiveScene {
  const scene = createScene(name, count, { speed: Math.min(topSpeed, 0.02 * Math.sqrt(count)) });
  return {
    count,
    boxes: scene.boxes,
    world: [0, 0, scene.world, scene.world],
    step: () => scene.step(),
  };
}

/** Fetches a recording. Some servers unpack a .gz, so its bytes decide whether it is still packed. */
export async function fetchRecording(url: string): Promise<RecordedFrames> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return framesOf(await openAny(new Uint8Array(await response.arrayBuffer())));
}

/** Steps between two recorded frames: the short recordings are shown in slow motion. */
const slowness = 8;

/** A recording in slow motion, forwards and backwards without end. */
export function recordedScene(recording: RecordedFrames): LiveScene {
  const { count, frames } = recording;
  const boxes = recording.frame(0).slice();
  const last = (frames - 1) * slowness;
  let at = 0;
  let direction = 1;

  const world: [number, number, number, number] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < boxes.length; i += 4) {
    world[0] = Math.min(world[0], boxes[i]);
    world[1] = Math.min(world[1], boxes[i + 1]);
    world[2] = Math.max(world[2], boxes[i + 2]);
    world[3] = Math.max(world[3], boxes[i + 3]);
  }

  return {
    count,
    boxes,
    world,
    step() {
      if (at + direction < 0 || at + direction > last) direction = -direction;
      at += direction;
      const k = Math.min(frames - 2, Math.floor(at / slowness));
      const part = at / slowness - k;
      const from = recording.frame(k);
      const to = recording.frame(k + 1);
      for (let i = 0; i < boxes.length; i++) boxes[i] = from[i] + part * (to[i] - from[i]);
    },
  };
}

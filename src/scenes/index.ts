// Every scene by its name: the same boxes and the same motion for the tests, the benchmark and the pages.
// Not part of the package.
import { kinds } from './kinds.ts';
import { MovingBoxes, type Scene } from './moving-boxes.ts';

export type { Scene } from './moving-boxes.ts';

export type SceneName = `${keyof typeof kinds}${2 | 3}d`;

export interface SceneOptions {
  /** Same seed, same scene (1). */
  seed?: number;
  /** The furthest a box moves in one frame, in units of the world (2). */
  speed?: number;
}

export const sceneNames: readonly SceneName[] = ([2, 3] as const).flatMap((dimensions) =>
  (Object.keys(kinds) as (keyof typeof kinds)[]).map((kind) => `${kind}${dimensions}d` as const),
);

export function createScene(name: SceneName, count: number, options: SceneOptions = {}): Scene {
  if (!sceneNames.includes(name)) {
    throw new RangeError(`No scene is called ${JSON.stringify(name)}: expected one of ${sceneNames.join(', ')}.`);
  }
  if (!Number.isInteger(count) || count < 0) {
    throw new RangeError(`A scene of ${count} boxes: expected a whole number, 0 or more.`);
  }
  const { seed = 1, speed = 2 } = options;
  const dimensions = name.endsWith('3d') ? 3 : 2;
  const kind = kinds[name.slice(0, -2) as keyof typeof kinds];
  return new MovingBoxes(name, kind, dimensions, count, seed, speed);
}

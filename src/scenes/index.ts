// Every scene by its name: the same boxes and the same motion for the tests, the benchmark and the pages.
// Not part of the package.
import { BulletHell } from './bullet-hell.ts';
import { Crowd } from './crowd.ts';
import { kinds } from './kinds.ts';
import { MovingBoxes } from './moving-boxes.ts';
import { Rings } from './rings.ts';
import type { Numbers, Scene } from './scene.ts';
import { TileMap } from './tile-map.ts';

export type { Scene } from './scene.ts';

const games = { rings: Rings, 'bullet-hell': BulletHell, 'tile-map': TileMap, crowd: Crowd };

export type KindName = `${keyof typeof kinds}${2 | 3}d`;
export type GameName = keyof typeof games;
export type SceneName = KindName | GameName;

export interface SceneOptions {
  /** Same seed, same scene (1). */
  seed?: number | undefined;
  /** The furthest a box moves in one frame, in units of the world (2). */
  speed?: number | undefined;
  /** What positions are held in: 'float32', or 'double', as games hold them ('float32'). */
  numbers?: 'float32' | 'double' | undefined;
}

/** Boxes of every kind, in 2D and in 3D. */
export const sceneNames: readonly KindName[] = ([2, 3] as const).flatMap((dimensions) =>
  (Object.keys(kinds) as (keyof typeof kinds)[]).map((kind) => `${kind}${dimensions}d` as const),
);

/** What games do with boxes, in 2D. */
export const gameNames = Object.keys(games) as readonly GameName[];

export function createScene(
  name: SceneName,
  count: number,
  options: SceneOptions & { numbers: 'double' },
): Scene<Float64Array>;
export function createScene(name: SceneName, count: number, options?: SceneOptions): Scene;
export function createScene(name: SceneName, count: number, options: SceneOptions = {}): Scene<Numbers> {
  const names: readonly SceneName[] = [...sceneNames, ...gameNames];
  if (!names.includes(name)) {
    throw new RangeError(`No scene is called ${JSON.stringify(name)}: expected one of ${names.join(', ')}.`);
  }
  if (!Number.isInteger(count) || count < 0) {
    throw new RangeError(`A scene of ${count} boxes: expected a whole number, 0 or more.`);
  }
  const { seed = 1, speed = 2, numbers = 'float32' } = options;
  const Held = numbers === 'double' ? Float64Array : Float32Array;
  if (name in games) return new games[name as GameName](count, seed, speed, Held);
  const dimensions = name.endsWith('3d') ? 3 : 2;
  const kind = kinds[name.slice(0, -2) as keyof typeof kinds];
  return new MovingBoxes(name, kind, dimensions, count, seed, speed, Held);
}

// What the lab can show: every generator of src/scenes, and the recorded traces that come with the page.
import { gameNames, type SceneName, sceneNames } from '../../src/scenes/index.ts';

export const fewestBoxes = 2;
export const mostBoxes = 200_000;

/** Recorded traces, by their file in site/public/traces. */
export const traces: Readonly<Record<string, { file: string; label: string }>> = {
  rain: { file: 'rain.bin.gz', label: 'Rain (Box2D)' },
  smash: { file: 'smash.trace.gz', label: 'Smash (Box2D)' },
  junkyard: { file: 'junkyard.trace.gz', label: 'Junkyard (Box2D)' },
  tumbler: { file: 'tumbler.trace.gz', label: 'Tumbler (Box2D)' },
  gravity: { file: 'gravity.trace.gz', label: 'Turning gravity, 3D (Rapier)' },
};

/** What the scenes are called where their own name does not say it. */
const labels: Readonly<Record<string, string>> = {
  uniform: 'Uniform',
  sparse: 'Sparse',
  dense: 'Dense',
  mixed: 'Mixed sizes',
  giants: 'A few giants',
  clustered: 'Clusters',
  static: 'Mostly still',
  skewed: 'Long and thin',
  rings: 'Rings of squares',
  'bullet-hell': 'Bullet hell',
  'tile-map': 'Tile map with walkers',
  crowd: 'Crowd in formation',
};

export interface SceneGroup {
  title: string;
  scenes: readonly (readonly [name: string, label: string])[];
}

const labelled = (name: SceneName): readonly [string, string] => {
  const label = labels[name.replace(/[23]d$/, '')] ?? name;
  return [name, name.endsWith('3d') ? `${label}, 3D` : label];
};

export const sceneGroups: readonly SceneGroup[] = [
  { title: 'Flat', scenes: sceneNames.filter((name) => name.endsWith('2d')).map(labelled) },
  { title: 'As in games', scenes: gameNames.map(labelled) },
  { title: 'Solid', scenes: sceneNames.filter((name) => name.endsWith('3d')).map(labelled) },
  { title: 'Recorded', scenes: Object.entries(traces).map(([name, { label }]) => [name, label]) },
];

export const isTrace = (name: string): boolean => Object.hasOwn(traces, name);

export const isScene = (name: string): boolean =>
  sceneGroups.some(({ scenes }) => scenes.some(([known]) => known === name));

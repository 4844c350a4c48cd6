// What the lab can show: all generators of src/scenes, and the recorded traces that come with the page.
import junkyard from '../../recordings/junkyard.trace.gz?url';
import rain from '../../recordings/rain.trace.gz?url';
import gravity from '../../recordings/rapier3d-gravity8k.trace.gz?url';
import smash from '../../recordings/smash.trace.gz?url';
import tumbler from '../../recordings/tumbler.trace.gz?url';
import { gameNames, type SceneName, sceneNames } from '../../src/scenes/index.ts';

export const fewestBoxes = 2;
export const mostBoxes = 200_000;

/** Recordings that come with the page. */
export const traces: Readonly<Record<string, { label: string; url: string }>> = {
  rain: { label: 'Rain (Box2D)', url: rain },
  smash: { label: 'Smash (Box2D)', url: smash },
  junkyard: { label: 'Junkyard (Box2D)', url: junkyard },
  tumbler: { label: 'Tumbler (Box2D)', url: tumbler },
  gravity: { label: 'Turning gravity, 3D (Rapier)', url: gravity },
};

/** Labels of scenes whose own name does not say enough. */
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

// The techniques by name, and which of them this build has.

import { badValue } from './errors.ts';
import { builtTechniques } from './kernel/load.ts';

/** All that there are, in the order of the kernel's numbers, which stand in snapshots: new ones go before 'auto'. */
export const techniques = [
  'brute-force',
  'spatial-grid',
  'retained-grid',
  'home-cell-grid',
  'hierarchical-grid',
  'sweep-and-prune',
  'strip-sweep',
  'quadtree',
  'bsp-tree',
  'r-tree',
  'aabb-tree',
  'incremental',
  'auto',
] as const;

/** The name of a technique. */
export type TechniqueName = (typeof techniques)[number];

export const isBuilt = (name: TechniqueName): boolean => (builtTechniques() & (1 << techniques.indexOf(name))) !== 0;

/** Those of this build, in order. */
export const builtNames = (): TechniqueName[] => techniques.filter(isBuilt);

/** The kernel's number of a technique that this build has. */
export function checkTechnique(name: unknown): number {
  const technique = techniques.indexOf(name as TechniqueName);
  if (technique >= 0 && isBuilt(techniques[technique]!)) return technique;
  const more = technique < 0 ? '' : ": the others are in 'broadphase/all'";
  badValue('technique', name, `one of ${builtNames().join(', ')}${more}`, typeof name !== 'string');
}

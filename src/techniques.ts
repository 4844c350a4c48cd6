// The techniques by name, and which of them this build has.

import { badValue } from './errors.ts';
import { techniques } from './generated/abi.ts';
import { builtTechniques } from './kernel/load.ts';

export { techniques };

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

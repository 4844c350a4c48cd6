// The techniques by name, and which of them this build has.

import { badValue } from './errors.ts';
import { techniques } from './generated/abi.ts';
import { builtTechniques } from './kernel/load.ts';

export { techniques };

/** The name of a technique. */
export type TechniqueName = (typeof techniques)[number];

/** Whether it is one of the `built`, a bit for each. */
export const isBuilt = (name: TechniqueName, built = builtTechniques()): boolean =>
  (built & (1 << techniques.indexOf(name))) !== 0;

/** Those that are `built`, in order. */
export const builtNames = (built = builtTechniques()): TechniqueName[] =>
  techniques.filter((name) => isBuilt(name, built));

/** The kernel's number of a technique that is `built`. */
export function checkTechnique(name: unknown, built = builtTechniques()): number {
  const technique = techniques.indexOf(name as TechniqueName);
  if (technique >= 0 && isBuilt(techniques[technique]!, built)) return technique;
  const more = technique < 0 ? '' : ": the others are in 'broadphase/all'";
  badValue('technique', name, `one of ${builtNames(built).join(', ')}${more}`, typeof name !== 'string');
}

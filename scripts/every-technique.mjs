// For bundlers: the library with the kernel that has every technique, in place of the lean one. That is all in which
// 'broadphase/all' differs from 'broadphase'.
import { fileURLToPath } from 'node:url';

const kernel = fileURLToPath(new URL('../src/generated/kernel.ts', import.meta.url));

/** A plugin for Vite and rolldown. */
export const everyTechnique = {
  name: 'every-technique',
  enforce: 'pre',
  resolveId: (source) => (source.endsWith('/generated/kernel-lean.ts') ? kernel : undefined),
};

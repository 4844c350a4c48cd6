// A bundler plugin: replaces the lean kernel by another. That is the only difference of 'broadphase/all',
// 'broadphase/2d' and 'broadphase/3d' from 'broadphase'.
import { fileURLToPath } from 'node:url';

/** A plugin for Vite and rolldown: the kernel of that name (scripts/kernel.mjs). */
export const withKernel = (name) => {
  const kernel = fileURLToPath(new URL(`../src/generated/${name}.ts`, import.meta.url));
  return {
    name: `with-${name}`,
    enforce: 'pre',
    resolveId: (source) => (source.endsWith('/generated/kernel-lean.ts') ? kernel : undefined),
  };
};

/** The kernel that has every technique. */
export const everyTechnique = withKernel('kernel');

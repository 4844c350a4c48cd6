// Bundles a TypeScript entry of the repository into one module that Node can run; about half a second.
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { everyTechnique } from './every-technique.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));

/**
 * Both paths are relative to the repository. Returns the path of the file written.
 * @param plugins `[]`: with the techniques of `import 'broadphase'` alone
 */
export async function bundle(entry, output, plugins = [everyTechnique]) {
  const slash = output.lastIndexOf('/');
  await build({
    root,
    configFile: false,
    logLevel: 'warn',
    publicDir: false,
    plugins,
    resolve: {
      alias: { 'broadphase/trace': `${root}src/trace/index.ts`, broadphase: `${root}src/index.ts` },
    },
    build: {
      ssr: entry,
      target: 'node20',
      outDir: output.slice(0, slash),
      emptyOutDir: false,
      rollupOptions: { output: { entryFileNames: output.slice(slash + 1) } },
    },
  });
  return root + output;
}

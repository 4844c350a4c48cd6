// Bundles a TypeScript entry of the repository into one module that Node can run; about half a second.
import { fileURLToPath } from 'node:url';
import { build } from 'vite';

const root = fileURLToPath(new URL('..', import.meta.url));

/** Both paths are relative to the repository. Returns the path of what was written. */
export async function bundle(entry, output) {
  const slash = output.lastIndexOf('/');
  await build({
    root,
    configFile: false,
    logLevel: 'warn',
    publicDir: false,
    resolve: { alias: { broadphase: `${root}src/index.ts` } },
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

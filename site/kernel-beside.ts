// For the pages: the kernel with every technique, fetched as a file beside the scripts rather than inlined in them as
// text, so that the browser compiles it as it comes. Whatever imports the library waits for it, by top-level await.
// Not for workers: a message that comes while one of them waits is lost, since nobody listens yet.
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const kernel = fileURLToPath(new URL('../build/kernel.wasm', import.meta.url));
const here = '\0kernel-beside';
const inlined = 'compile(read(kernel))';

export const kernelBeside: Plugin = {
  name: 'kernel-beside',
  enforce: 'pre',
  resolveId: (source) => (source.endsWith('/generated/kernel-lean.ts') ? here : undefined),
  load: (id) =>
    id === here
      ? `import url from ${JSON.stringify(`${kernel}?url`)};
         export const bytes = await (await fetch(url)).arrayBuffer();`
      : undefined,
  transform(code, id) {
    if (!id.endsWith('/src/kernel.ts')) return;
    if (!code.includes(inlined))
      throw new Error(`src/kernel.ts no longer has ${inlined}: site/kernel-beside.ts needs it`);
    return { code: code.replace(inlined, 'compile(kernel.bytes)'), map: null };
  },
};

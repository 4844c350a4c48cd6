// Serves all examples with a page at once, with the library from source: `npx vite examples`. None of them needs this:
// copied elsewhere, each starts with `npm i && npm start`.
import { fileURLToPath } from 'node:url';
import { everyTechnique } from '../scripts/every-technique.mjs';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));

/** A cross-origin isolated page has a finer clock. */
const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** For examples/vue, if the packages of the examples are installed. */
const vue = await import('@vitejs/plugin-vue').then(
  ({ default: plugin }) => plugin(),
  () => undefined,
);

export default {
  root: path('.'),
  base: './',
  appType: 'mpa', // a URL without a page gets a 404
  plugins: [everyTechnique, vue],
  resolve: {
    alias: {
      'broadphase/all': path('../src/index.ts'), // everyTechnique turns it into that
      'broadphase/draw': path('../src/draw/index.ts'),
      'broadphase/shard': path('../src/shard/index.ts'),
      'broadphase/trace': path('../src/trace/index.ts'),
      broadphase: path('../src/index.ts'),
    },
  },
  // A dependency that is found later makes Vite reload the page.
  optimizeDeps: { entries: ['*/index.html'] },
  server: { headers, fs: { allow: [path('..')] } },
};

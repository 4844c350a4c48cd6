// For work on the examples that run in a browser, all in one: `npx vite examples`. The library comes straight from its
// source. None of them needs this: taken out of here, each starts by `npm i && npm start`.
import { fileURLToPath } from 'node:url';
import { everyTechnique } from '../scripts/every-technique.mjs';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));

/** A page that is alone in its process has a finer clock. */
const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** For examples/vue, where the packages of the examples are installed. */
const vue = await import('@vitejs/plugin-vue').then(
  ({ default: plugin }) => plugin(),
  () => undefined,
);

export default {
  root: path('.'),
  base: './',
  appType: 'mpa', // an address that is no page is answered with 404
  plugins: [everyTechnique, vue],
  resolve: {
    alias: {
      'broadphase/all': path('../src/index.ts'), // everyTechnique makes it that
      'broadphase/draw': path('../src/draw/index.ts'),
      'broadphase/shard': path('../src/shard/index.ts'),
      'broadphase/trace': path('../src/trace/index.ts'),
      broadphase: path('../src/index.ts'),
    },
  },
  // What is found only later makes Vite reload a page.
  optimizeDeps: { entries: ['*/index.html'] },
  server: { headers, fs: { allow: [path('..')] } },
};

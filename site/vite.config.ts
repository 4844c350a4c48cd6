// The site: every page under site/, with the library taken straight from its source.
// The two headers make the pages cross-origin isolated: clocks are then fine enough to time one update(),
// and SharedArrayBuffer exists.
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { everyTechnique } from '../scripts/every-technique.mjs';
import { addresses } from './plugins/addresses.ts';
import { api } from './plugins/api.ts';
import { documents } from './plugins/documents.ts';
import { frame } from './plugins/frame.ts';
import { live } from './plugins/live.ts';
import { notFound } from './plugins/not-found.ts';
import { sources } from './plugins/sources.ts';

const path = (file: string) => fileURLToPath(new URL(file, import.meta.url));
const headers = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

export default defineConfig({
  root: path('.'),
  base: './',
  appType: 'mpa', // a URL without a page gets a 404, which plugins/not-found.ts fills
  // The same in pages and workers, in development and in a build: every technique, inlined in the script.
  plugins: [addresses, api, documents, frame, live, notFound, sources, everyTechnique],
  resolve: {
    dedupe: ['react', 'react-dom', '@xyflow/react', 'd3-force', 'd3-quadtree', 'rbush', 'flatbush', 'three'],
    alias: {
      'broadphase/draw': path('../src/draw/index.ts'),
      'broadphase/ro': path('../src/ro/index.ts'),
      'broadphase/shard': path('../src/shard/index.ts'),
      'broadphase/trace': path('../src/trace/index.ts'),
      broadphase: path('../src/index.ts'),
      buffer: path('bench/no-buffer.ts'),
    },
  },
  define: { global: 'globalThis' }, // for box-intersect, which the benchmark page runs
  worker: { format: 'es', plugins: () => [everyTechnique] },
  build: {
    target: 'es2022',
    outDir: path('dist'),
    emptyOutDir: true,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 600, // three.js, which only the lab's solid scenes and one showcase fetch
    rolldownOptions: {
      input: {
        index: path('index.html'),
        404: path('404.html'),
        article: path('article/index.html'),
        lab: path('lab/index.html'),
        bench: path('bench/index.html'),
        queries: path('queries/index.html'),
        showcases: path('showcases/index.html'),
        'narrow-phase': path('narrow-phase/index.html'),
      },
    },
  },
  // With the workers, so that their dependencies are found too: if found later, Vite reloads the page during a run.
  optimizeDeps: { entries: ['**/index.html', '*/worker.ts', 'lab/worker/worker.ts', '!dist/**'] },
  server: { headers, fs: { allow: [path('..')] } },
  preview: { headers },
});

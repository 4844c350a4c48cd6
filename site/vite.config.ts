// The site: every page under site/, with the library taken straight from its source.
// The two headers make the pages cross-origin isolated: clocks are then fine enough to time one update(),
// and SharedArrayBuffer exists.
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { everyTechnique } from '../scripts/every-technique.mjs';
import { api } from './api.ts';
import { documents } from './documents.ts';
import { frame } from './frame.ts';
import { kernelBeside } from './kernel-beside.ts';

const path = (file: string) => fileURLToPath(new URL(file, import.meta.url));
const headers = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

export default defineConfig({
  root: path('.'),
  base: './',
  plugins: [api, documents, frame, kernelBeside],
  resolve: {
    alias: {
      'broadphase/ro': path('../src/ro/index.ts'),
      'broadphase/trace': path('../src/trace/index.ts'),
      broadphase: path('../src/index.ts'),
      buffer: path('bench/no-buffer.ts'),
    },
  },
  define: { global: 'globalThis' }, // for box-intersect, which the page of the benchmark races
  worker: { format: 'es', plugins: () => [everyTechnique] },
  build: {
    target: 'es2022',
    outDir: path('dist'),
    emptyOutDir: true,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 600, // three.js, which only the lab's solid scenes fetch
    rolldownOptions: {
      input: {
        index: path('index.html'),
        article: path('article/index.html'),
        lab: path('lab/index.html'),
        bench: path('bench/index.html'),
        questions: path('questions/index.html'),
        'narrow-phase': path('narrow-phase/index.html'),
      },
    },
  },
  server: { headers, fs: { allow: [path('..')] } },
  preview: { headers },
});

// For the examples that run in a browser: npx vite examples/record-phaser --config examples/vite.config.mjs
// The library comes straight from its source; in a project of your own nothing of this is needed.
import { fileURLToPath } from 'node:url';
import { everyTechnique } from '../scripts/every-technique.mjs';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));

export default {
  base: './',
  plugins: [everyTechnique],
  resolve: {
    alias: { 'broadphase/trace': path('../src/trace/index.ts'), broadphase: path('../src/index.ts') },
  },
  build: { target: 'es2022', chunkSizeWarningLimit: 4000 },
};

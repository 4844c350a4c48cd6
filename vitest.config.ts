import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { everyTechnique } from './scripts/every-technique.mjs';

const path = (file: string) => fileURLToPath(new URL(file, import.meta.url));

export default defineConfig({
  plugins: [everyTechnique],
  resolve: {
    alias: {
      'broadphase/ro': path('./src/ro/index.ts'),
      'broadphase/trace': path('./src/trace/index.ts'),
      broadphase: path('./src/index.ts'),
    },
  },
  test: {
    maxWorkers: '100%', // also where there are but two cores
    projects: [
      {
        extends: true,
        test: {
          name: 'unit',
          include: ['test/**/*.test.ts', 'examples/**/*.test.mjs'],
          exclude: ['test/browser/**', '**/node_modules/**'],
          testTimeout: 30_000,
        },
      },
    ],
  },
});

import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { everyTechnique, withKernel } from './scripts/every-technique.mjs';

const path = (file: string) => fileURLToPath(new URL(file, import.meta.url));

export default defineConfig({
  // KERNEL: another than the one with every technique, for scripts/dev.mjs.
  plugins: [process.env.KERNEL ? withKernel(process.env.KERNEL) : everyTechnique],
  resolve: {
    alias: [
      { find: 'broadphase/all', replacement: path('./src/index.ts') },
      { find: 'broadphase/draw', replacement: path('./src/draw/index.ts') },
      { find: 'broadphase/ro', replacement: path('./src/ro/index.ts') },
      { find: 'broadphase/shard', replacement: path('./src/shard/index.ts') },
      { find: 'broadphase/trace', replacement: path('./src/trace/index.ts') },
      { find: 'broadphase', replacement: path('./src/index.ts') },
      // What the benchmark has bundled when it runs, tests take from where it comes.
      { find: /^.*\/build\/bench\/library\.mjs$/, replacement: path('./bench/library.ts') },
    ],
  },
  test: {
    tags: [{ name: 'long', description: 'left out of `npm run check`, so that it can be run often' }],
    testTimeout: 120_000, // a busy machine is slow, and no test is about time
    hookTimeout: 120_000,
    maxWorkers: '100%', // also where there are but two cores
    execArgv: ['--max-semi-space-size=128'], // MiB: an eighth less time is spent
    projects: [
      {
        extends: true,
        test: {
          name: 'unit',
          include: ['test/**/*.test.ts'],
          exclude: ['test/browser/**'],
        },
      },
      {
        extends: true,
        test: {
          name: 'examples', // several wait for processes of their own
          include: ['examples/test/*.test.mjs'],
        },
      },
    ],
  },
});

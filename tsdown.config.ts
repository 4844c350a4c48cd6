// The published package: ES modules with their types, and the kernel beside them for hosts that load it themselves.
// Entries are built apart, so that who imports the library alone gets one file; to each other they are external.
import { defineConfig, type UserConfig } from 'tsdown';

const common: UserConfig = { format: 'esm', platform: 'neutral', target: 'es2022', dts: true };
const entries = { broadphase: './index.js', 'broadphase/trace': './trace.js' };

/** An entry that imports others of this package by their names, and finds them beside itself. */
const beside: UserConfig = {
  deps: { neverBundle: Object.keys(entries) },
  outputOptions: { paths: entries },
  clean: false,
};

export default defineConfig([
  { ...common, entry: { index: 'src/index.ts' }, copy: ['build/kernel.wasm'] },
  { ...common, ...beside, entry: { trace: 'src/trace/index.ts' } },
  { ...common, ...beside, entry: { ro: 'src/ro/index.ts' } },
  { ...common, ...beside, entry: { cli: 'src/cli/index.ts' }, platform: 'node', dts: false, fixedExtension: false },
]);

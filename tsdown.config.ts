// The published package: ES modules with their types, and the kernel beside them for hosts that load it themselves.
// Entries are built apart, so that who imports the library alone gets one file; to each other they are external.
// There are two of the library, which differ in the kernel: the lean one, and `all`, with every technique. The others
// use that one. Types are those of the lean one for both, so that a space of either can be passed on.
// script/ is the lean one for a plain <script> tag, where it is the global `broadphase`, and for `require` where that
// cannot load modules. CDNs send .cjs as something browsers do not run, so it is a .js file, in a folder of scripts.
import { defineConfig, type UserConfig } from 'tsdown';
import { everyTechnique } from './scripts/every-technique.mjs';

const common: UserConfig = { format: 'esm', platform: 'neutral', target: 'es2022', clean: false };
const types: UserConfig = { ...common, dts: { emitDtsOnly: true } };

/** For entries that import others of this package by their names, and find them beside themselves. */
const beside = (library: string): UserConfig => {
  const entries = { broadphase: library, 'broadphase/trace': './trace.js' };
  return { deps: { neverBundle: Object.keys(entries) }, outputOptions: { paths: entries } };
};

const folderOfScripts: UserConfig['plugins'] = {
  name: 'folder-of-scripts',
  generateBundle() {
    const files = { 'package.json': '{ "type": "commonjs" }\n', 'broadphase.d.ts': "export * from '../index.js';\n" };
    for (const [fileName, source] of Object.entries(files)) this.emitFile({ type: 'asset', fileName, source });
  },
};

export default defineConfig([
  { ...common, dts: true, clean: true, entry: { index: 'src/index.ts' }, copy: ['build/kernel.wasm'] },
  { ...common, dts: false, entry: { all: 'src/index.ts' }, plugins: [everyTechnique] },
  {
    ...common,
    dts: false,
    entry: 'src/index.ts',
    format: 'umd',
    globalName: 'broadphase',
    minify: true,
    outDir: 'dist/script',
    outputOptions: { entryFileNames: 'broadphase.js' },
    plugins: [folderOfScripts],
  },
  ...['trace', 'ro', 'shard'].flatMap((name): UserConfig[] => [
    { ...common, ...beside('./all.js'), dts: false, entry: { [name]: `src/${name}/index.ts` } },
    { ...types, ...beside('./index.js'), entry: { [name]: `src/${name}/index.ts` } },
  ]),
  {
    ...common,
    ...beside('./all.js'),
    entry: { cli: 'src/cli/index.ts' },
    platform: 'node',
    dts: false,
    fixedExtension: false,
  },
]);

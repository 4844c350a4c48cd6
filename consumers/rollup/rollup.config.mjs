import resolve from '@rollup/plugin-node-resolve';
import url from '@rollup/plugin-url';

const plugins = [resolve(), url({ include: '**/*.wasm', limit: 0 })];
export default ['main.js', 'worker.js'].map((input) => ({ input, plugins, output: { dir: 'dist', format: 'iife' } }));

// The published package: one ES module with its types, and the kernel beside it for hosts that load it themselves.
import { defineConfig } from 'tsdown';

export default defineConfig({
  entry: { index: 'src/index.ts' },
  format: 'esm',
  platform: 'neutral',
  target: 'es2022',
  dts: true,
  copy: ['build/kernel.wasm'],
});

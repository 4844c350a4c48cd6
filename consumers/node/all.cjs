// `require` of every entry, and that it gives what `import` gives.
const { readFileSync } = require('node:fs');
const library = require('broadphase');
require('broadphase/all');
require('broadphase/2d');
require('broadphase/3d');
require('broadphase/draw');
require('broadphase/ro');
require('broadphase/shard');
require('broadphase/trace');

import('broadphase').then(async (imported) => {
  if (imported.BroadPhase !== library.BroadPhase) throw new Error('require and import give two libraries');
  const { every } = await import('./every.js');
  console.log(await every(readFileSync(require.resolve('broadphase/kernel.wasm'))));
});

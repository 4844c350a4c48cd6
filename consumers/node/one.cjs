// The library by `require`, where that cannot load modules: Node before 20.19, and tools with a `require` of their own.
const { readFileSync } = require('node:fs');
const { BroadPhase, findPairs, init } = require('broadphase');

const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
init(readFileSync(require.resolve('broadphase/kernel.wasm')));
const loaded = new BroadPhase({ technique: 'quadtree' }).set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
console.log(`index ${space.pairs}; findPairs ${findPairs([0, 0, 9, 9, 5, 5, 8, 8])}; kernel.wasm ${loaded.pairs}`);

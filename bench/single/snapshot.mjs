// The cost of a snapshot: its bytes, and the time to take and to restore one. The boxes move in between, so that no two
// snapshots are equal.
//   npm run bench:snapshot
import { bundle } from '../../scripts/bundle.mjs';
import { median } from '../harness/statistics.mjs';

const { BroadPhase, createScene } = await import(await bundle('bench/library.ts', 'build/bench/library.mjs'));

for (const [name, count] of [
  ['uniform2d', 1000],
  ['uniform3d', 1000],
  ['uniform2d', 100_000],
]) {
  for (const events of [false, true]) {
    const scene = createScene(name, count);
    const space = new BroadPhase({ dimensions: scene.dimensions, events });
    const [taken, restored] = [[], []];
    let saved;
    for (let round = 0; round < 300; round++) {
      scene.step();
      space.setAll(scene.boxes).update();
      const start = performance.now();
      saved = space.snapshot();
      const middle = performance.now();
      space.restore(saved);
      restored.push(performance.now() - middle);
      taken.push(middle - start);
    }
    const microseconds = (times) => `${(median(times.slice(100)) * 1000).toFixed(1).padStart(8)} µs`;
    const what = `${name} ${count}${events ? ', events' : ''}`;
    console.log(
      `${what.padEnd(26)}${String(saved.length).padStart(9)} bytes  take${microseconds(taken)}  restore${microseconds(restored)}`,
    );
  }
}

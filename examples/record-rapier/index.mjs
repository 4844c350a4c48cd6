// npm i && npm start: 300 bodies fall onto a floor; five seconds of it are written to rapier.trace.
import { writeFileSync } from 'node:fs';
import { recordRapier } from './record-rapier.mjs';
import { createScene } from './scene.mjs';

const world = await createScene();
const recorded = recordRapier(world);
for (let step = 0; step < 300; step++) {
  world.step();
  recorded.frame();
}
await recorded.stop();
writeFileSync('rapier.trace', recorded.recording.bytes());
console.log(`rapier.trace: ${recorded.recording.frames} frames. Now: npx broadphase tune rapier.trace`);

// npm i && npm start: 200 bodies fall onto a seesaw; five seconds of it are written to planck.trace.
import { writeFileSync } from 'node:fs';
import { recordPlanck } from './record-planck.mjs';
import { createScene } from './scene.mjs';

const world = createScene();
const recorded = recordPlanck(world);
for (let step = 0; step < 300; step++) {
  world.step(1 / 60);
  recorded.frame();
}
await recorded.stop();
writeFileSync('planck.trace', recorded.recording.bytes());
console.log(`planck.trace: ${recorded.recording.frames} frames. Now: npx broadphase tune planck.trace`);

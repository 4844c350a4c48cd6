// npm i && npm start: 300 asteroids; five seconds of them are written to three.trace. That needs no renderer.
import { writeFileSync } from 'node:fs';
import { recordThree } from './record-three.mjs';
import { createScene } from './scene.mjs';

const { scene, step } = createScene();
const recorded = recordThree(scene);
for (let frame = 0; frame < 300; frame++) {
  step(frame);
  recorded.frame();
}
await recorded.stop();
writeFileSync('three.trace', recorded.recording.bytes());
console.log(`three.trace: ${recorded.recording.frames} frames. Now: npx broadphase tune three.trace`);

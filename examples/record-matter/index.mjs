// npm i && npm start: 300 bodies fall into a box; five seconds of it are written to matter.trace.
import { writeFileSync } from 'node:fs';
import Matter from 'matter-js';
import { recordMatter } from './record-matter.mjs';
import { createScene } from './scene.mjs';

const engine = createScene();
const recorded = recordMatter(engine);
for (let step = 0; step < 300; step++) Matter.Engine.update(engine, 1000 / 60);
await recorded.stop();
writeFileSync('matter.trace', recorded.recording.bytes());
console.log(`matter.trace: ${recorded.recording.frames} frames. Now: npx broadphase tune matter.trace`);

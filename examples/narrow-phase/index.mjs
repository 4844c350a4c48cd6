// npm i && npm start: ten seconds of each world, and how many pairs of boxes really touched.
import { fastBoxes, masks, shapes } from './scenes.mjs';

const frames = 600;
for (const [name, scene] of Object.entries({
  'polygons and circles, by separating axes': shapes(),
  'pixel masks': masks(),
  'fast boxes, swept': fastBoxes(),
})) {
  let [pairs, hits] = [0, 0];
  for (let frame = 0; frame < frames; frame++) {
    scene.move();
    scene.broad();
    scene.narrow();
    scene.react();
    pairs += scene.space.pairCount;
    hits += scene.hits.length / 2;
  }
  console.log(`${name}: ${(pairs / frames).toFixed(1)} pairs of boxes a frame, ${(hits / frames).toFixed(1)} touch`);
}

// npm i && npm start: the same 2,000 entities in bitECS and in koota.
import * as bitecs from './bitecs.mjs';
import * as koota from './koota.mjs';

for (const [name, ecs] of Object.entries({ bitecs, koota })) {
  const game = ecs.createGame();
  for (let k = 0; k < 2000; k++) {
    ecs.spawn(game, (k * 37) % 1000, (k * 61) % 1000, 3 + (k % 5), 3 + (k % 7), (k % 11) - 5, (k % 13) - 6);
  }
  let pairs = 0;
  const frames = 300;
  const started = performance.now();
  for (let frame = 0; frame < frames; frame++) {
    ecs.moveSystem(game, 1 / 60);
    pairs += ecs.collisionSystem(game).length / 2;
  }
  const ms = (performance.now() - started) / frames;
  console.log(`${name}: ${(pairs / frames).toFixed(0)} pairs a frame, ${ms.toFixed(2)} ms with moving and reading`);
}

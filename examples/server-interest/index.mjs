// npm i && npm start: 1,000 players without a network, and the cost of sending everything to everybody instead. With
// --serve it listens on port 8080, with 20 ticks per second.
import { Interest } from './interest.mjs';
import { startServer } from './server.mjs';

if (process.argv.includes('--serve')) {
  const server = startServer({ port: 8080 });
  setInterval(server.tick, 50);
  console.log('ws://localhost:8080');
} else {
  const [players, world, reach, ticks] = [1000, 2000, 50, 200];
  const interest = new Interest(reach);
  const places = Array.from({ length: players }, () => [Math.random() * world, Math.random() * world]);
  for (const [player, [x, y]] of places.entries()) interest.add(player, x, y);
  let [entered, left, spent, seen] = [0, 0, 0, 0];
  for (let tick = 0; tick < ticks; tick++) {
    for (const [player, place] of places.entries()) {
      for (let axis = 0; axis < 2; axis++) {
        place[axis] = Math.min(world, Math.max(0, place[axis] + 4 * (Math.random() - 0.5)));
      }
      interest.move(player, place[0], place[1]);
    }
    const started = performance.now();
    interest.update(
      () => entered++,
      () => left++,
    );
    spent += performance.now() - started;
  }
  for (let player = 0; player < players; player++) seen += interest.seenBy(player).length;
  console.log(`${players} players, each sees ${(seen / players).toFixed(1)} others on average`);
  console.log(
    `a tick: ${(spent / ticks).toFixed(2)} ms, ${(entered / ticks).toFixed(0)} enter and ${(left / ticks).toFixed(0)} leave`,
  );
  console.log(`messages a tick: ${seen} instead of ${players * (players - 1)}`);
}

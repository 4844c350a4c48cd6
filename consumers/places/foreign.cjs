// Hands the library values of another realm: what a test runner's structuredClone gives, an iframe, a vm context.
// Says what came out; throws where one was refused.

/**
 * @param library the package
 * @param foreign the globals of the other realm
 * @param kernel the bytes of broadphase/kernel.wasm, of the other realm; left out, `init` is not tried
 */
function everyForeign({ BroadPhase, findPairs, findPairsBetween, init }, foreign, kernel) {
  const boxes = [0, 0, 10, 10, 5, 5, 15, 15];
  const answers = [];
  for (const kind of ['Array', 'Float32Array', 'Float64Array']) {
    const given = foreign[kind].from(boxes);
    const space = new BroadPhase().setAll(given).update();
    const bytes = foreign.Uint8Array.from(space.snapshot());
    const out = foreign.Array.of();
    const all = [
      space.pairs,
      findPairs(given),
      findPairsBetween(given, boxes).length / 2,
      new BroadPhase().restore(bytes).update().pairs,
      new BroadPhase().restore(bytes.buffer).update().pairs,
      space.get(1, new foreign.Float64Array(4)),
      space.queryBox(0, 0, 1, 1, { out }) === out,
    ];
    answers.push(all.join(' '));
  }
  new BroadPhase({ wrap: foreign.Array.of(100, 100) });
  if (kernel) {
    init(kernel);
    init(kernel.buffer);
    new BroadPhase();
  }
  if (new Set(answers).size !== 1) throw new Error(answers.join('\n'));
  return answers[0];
}

const expectedOfForeign = '0,1 0,1 4 0,1 0,1 5,5,15,15 true';

if (typeof module === 'undefined') globalThis.foreign = { everyForeign, expectedOfForeign };
else module.exports = { everyForeign, expectedOfForeign };

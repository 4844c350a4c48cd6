// How long a technique takes for one step: the boxes handed over, the search, and the pairs back.
import type { coltech } from 'broadphase/ro';

const WARM_UP = 3; // runs until the browser has compiled the code
const AT_LEAST = 12; // milliseconds of measuring

/** The median of as many runs as time allows, in milliseconds, and the number of pairs. */
export function timeStep(technique: coltech.Technique): { milliseconds: number; pairs: number } {
  let pairs = 0;
  const run = () => {
    const started = performance.now();
    technique.update();
    pairs = technique.queryForCollisionPairs().length;
    return performance.now() - started;
  };

  for (let i = 0; i < WARM_UP; i++) run();
  const times: number[] = [];
  for (let spent = 0; spent < AT_LEAST; spent += times[times.length - 1] + 0.001) times.push(run());
  times.sort((a, b) => a - b);
  return { milliseconds: times[times.length >> 1], pairs };
}

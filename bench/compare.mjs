// What changed from one file of results to another: what did by more than the noise is marked.
import { change } from './statistics.mjs';
import { short } from './table.mjs';

export function compare(before, after) {
  const lines = [];
  let [slower, faster, same, new_, broken] = [0, 0, 0, 0, 0];
  const earlier = new Map(before.races.flatMap((race) => race.results.map((result) => [keyOf(race, result), result])));
  for (const race of after.races) {
    for (const result of race.results) {
      if (!result.figures) continue;
      const old = earlier.get(keyOf(race, result));
      if (!old?.figures) {
        new_++;
        continue;
      }
      const { ratio, beyondNoise } = change(old.figures, result.figures);
      const spoilt = Boolean(result.wrong) && !old.wrong;
      if (spoilt) broken++;
      if (!beyondNoise) same++;
      else if (ratio > 1) slower++;
      else faster++;
      if (!beyondNoise && !spoilt) continue;
      const mark = spoilt ? '!! its pairs are wrong now' : ratio > 1 ? '*  slower' : '   faster';
      const times = `${short(old.figures.median)} -> ${short(result.figures.median)} ms`;
      lines.push(`${keyOf(race, result).padEnd(56)}${times.padStart(22)}  ${ratio.toFixed(2).padStart(5)}x ${mark}`);
    }
  }
  if (before.machine.cpu !== after.machine.cpu) lines.unshift('These are of different machines: compare with care.');
  const gone = earlier.size - same - slower - faster;
  lines.push(
    `${slower} slower, ${faster} faster, ${same} within the noise, ${new_} new, ${gone} without a figure, ${broken} newly wrong`,
  );
  return lines.join('\n');
}

const keyOf = ({ scene, count }, { name }) => `${scene} ${count} ${name}`;

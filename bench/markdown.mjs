// Tables for the README out of a file of results: the headline, and each goal with its figure.
import { goals } from './goals.mjs';
import { bestOf, short, whole } from './table.mjs';

export function markdown(record, cases) {
  const { machine, date } = record;
  const races = record.races.filter(({ question }) => !question);
  const asked = record.races.filter(({ question }) => question);
  const lines = [
    `Milliseconds per frame, one thread, on ${machine.cpu} (${machine.system}, Node ${machine.node}), ${date.slice(0, 10)}.`,
  ];
  if (races.length > 0) lines.push('', ...pairTable(races));
  if (asked.length > 0) lines.push('', ...questionTable(asked));
  lines.push('', '| goal | figure | met |', '| --- | --- | --- |');
  for (const { goal, figure, met } of goals(record, cases)) {
    lines.push(`| ${goal} | ${figure} | ${met === undefined ? 'not measured' : met ? 'yes' : 'no'} |`);
  }
  return lines.join('\n');
}

function pairTable(races) {
  const lines = [
    '| scene | boxes | pairs | `auto` | the best technique | the fastest npm package | that is |',
    '| --- | ---: | ---: | ---: | --- | --- | ---: |',
  ];
  for (const { scene, count, pairs, results } of races) {
    const auto = results.find(({ name, figures }) => name === 'auto' && figures);
    const fixed = bestOf(results.filter(({ name }) => name !== 'auto'));
    const peer = bestPeer(results);
    lines.push(
      `| ${[
        scene,
        whole(count),
        whole(pairs),
        auto ? short(auto.figures.median) : '',
        fixed ? `${short(fixed.figures.median)} ${fixed.name}` : '',
        peer ? `${short(peer.figures.median)} ${peer.name}` : 'none within the limit',
        peer && auto ? `${short(peer.figures.median / auto.figures.median)}x` : '',
      ].join(' | ')} |`,
    );
  }
  return lines;
}

/** 1,000 questions a frame. */
function questionTable(races) {
  const lines = [
    '| 1,000 questions a frame | boxes | answers | `broadphase` | the fastest npm package | that is |',
    '| --- | ---: | ---: | ---: | --- | ---: |',
  ];
  for (const { scene, still, count, pairs, results } of races) {
    const ours = bestOf(results);
    const peer = bestPeer(results);
    lines.push(
      `| ${[
        `\`${scene.replace('-moved', '')}\`${still ? '' : ' after an update of all'}`,
        whole(count),
        whole(pairs),
        ours ? short(ours.figures.median) : '',
        peer ? `${short(peer.figures.median)} ${peer.name}` : 'none',
        peer && ours ? `${short(peer.figures.median / ours.figures.median)}x` : '',
      ].join(' | ')} |`,
    );
  }
  return lines;
}

/** The fastest package whose pairs are right. What a tutorial would write is no package. */
export function bestPeer(results) {
  const tutorials = ['tutorial-brute-force', 'tutorial-grid'];
  return results
    .filter(({ peer, figures, wrong }) => figures && !wrong && !['broadphase', 'floor', ...tutorials].includes(peer))
    .sort((a, b) => a.figures.median - b.figures.median)[0];
}

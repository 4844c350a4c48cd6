// Text out of files of results: the tables of one, each goal with its figure, or docs/figures.md out of all of a machine.
import { coherenceTable, coherenceVerdicts } from './coherence-table.mjs';
import { goals } from './goals.mjs';
import { bestOf, short, whole } from './table.mjs';
import { techniqueTables } from './techniques.mjs';

/** A file of results of whatever kind. */
export function markdown(record, cases) {
  const { everyTechnique, coherence } = record;
  if (everyTechnique) return techniqueTables(record);
  if (coherence) return joined(origin(record), coherenceTable(coherence), goalTable(coherenceVerdicts(coherence)));
  return joined(origin(record), tables(record), goalTable(verdicts(record, cases)));
}

/** docs/figures.md, out of what a machine has: results of `--full`, of `--techniques all`, of `--coherence`. */
export function figures({ full, techniques, coherence }, cases) {
  const rows = coherence?.coherence;
  const reached = [...(full ? verdicts(full, cases, techniques?.races) : []), ...(rows ? coherenceVerdicts(rows) : [])];
  return joined(
    '# Figures',
    'What `npm run bench` has measured, from `bench/results/`; [how it is measured](../bench/README.md). `node bench/run.mjs --markdown` writes this page. Where others use the machine too, it takes up to three times as long at some minutes as at others: read ratios, and those of one row, which were taken in turns.',
    '## Goals',
    goalTable(reached),
    'Side by side with native libraries nothing was raced here: there are earlier figures of theirs, on another machine, for the recorded scenes and for 5 % that move.',
    full && joined('## Against packages', origin(full), tables(full)),
    rows &&
      joined(
        '## When little changes',
        `${origin(coherence)} All anew is \`strip-sweep\`; ratios are to it, frame by frame.`,
        coherenceTable(rows),
      ),
    (techniques ?? full) && joined('## Techniques', origin(techniques ?? full), techniqueTables(techniques ?? full)),
  );
}

const joined = (...parts) => parts.filter(Boolean).join('\n\n');

const origin = ({ machine, date }) =>
  `Milliseconds per frame, one thread, on ${machine.cpu} (${machine.system}, Node ${machine.node}), ${date.slice(0, 10)}.`;

/** Each goal, its figure, and whether it is met. */
const verdicts = (record, cases, judged) =>
  goals(record, cases, judged).map(({ goal, figure, met }) => [
    goal,
    figure,
    met === undefined ? 'not measured' : met ? 'yes' : 'no',
  ]);

const goalTable = (rows) =>
  ['| goal | figure | met |', '| --- | --- | --- |', ...rows.map((cells) => `| ${cells.join(' | ')} |`)].join('\n');

function tables({ races }) {
  const pairs = races.filter(({ question }) => !question);
  const asked = races.filter(({ question }) => question);
  return joined(pairs.length > 0 && pairTable(pairs).join('\n'), asked.length > 0 && questionTable(asked).join('\n'));
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

// Documents made from a record of results: docs/figures.md, and the tables of README.md and of docs/guides/worth-it.md.
import { goals } from './goals.mjs';
import { fastest, isPackage, named, none, ofKind } from './rows.mjs';
import {
  coldTable,
  motionsTable,
  nativeTable,
  objectsOthers,
  objectsTable,
  onceTable,
  queriesTable,
  scenesTable,
  techniquesTable,
} from './tables.mjs';
import { markdownTable, short, times, whole } from './words.mjs';
import { worthTable } from './worth.mjs';

const joined = (...parts) => parts.filter(Boolean).join('\n\n');

const originOf = ({ machine, date, commit, cut }) =>
  `Milliseconds, medians, one thread, on ${machine.cpu} (${machine.system}, Node ${machine.node}), ${date.slice(0, 10)}, of commit ${commit}.${cut ? ` ${cut}` : ''}`;

/** The page, with the kinds that have rows. */
export function figuresPage(record) {
  const has = (kind) => record.rows.some((row) => row.kind === kind);
  const part = (kind, ...text) => has(kind) && joined(...text);
  return joined(
    '# Figures',
    'Measured with `npm run bench`, which writes this page from `bench/results/`. [How it is measured](../bench/README.md): all contenders of a row are timed in the same frames, in turns, and their pairs are compared in each. Read the ratios, since the speed of the machine varies from hour to hour.',
    originOf(record),
    '## Goals',
    goalTable(goals(record)),
    part(
      'objects',
      '## A whole frame, from objects',
      'A game has things with x, y, width and height in doubles. In a frame it gives the boxes, finds all pairs, and reads both things of each pair. A contender is "slow" if five frames do not fit into a second.',
      objectsTable(record),
      'All move: the time of each package divided by that of `set`.',
      objectsOthers(record),
    ),
    part(
      'motions',
      '## Motions',
      '`update` of `auto`, in the same frames as `strip-sweep`, which does a full rebuild in each. Positions are doubles: given by `set`, or written in place as float32. Each motion runs three times, and the fastest time of each frame counts. "Start" is the frames before the timed ones.',
      motionsTable(record, 'motions'),
    ),
    part(
      'movers',
      '## Few movers',
      'A given number of boxes jitter by up to half their side and are set; all others are at rest.',
      motionsTable(record, 'movers'),
    ),
    part(
      'once',
      '## One-shot',
      'Milliseconds of the first call in a fresh process, and of the tenth (the fourth, if a call takes more than 300 ms).',
      onceTable(record),
    ),
    part(
      'cold',
      '## Cold',
      'Milliseconds from the start of the process, or of the page, to the first pair of two boxes; and of whole frames of 1,000 things in a fresh process.',
      coldTable(record),
    ),
    part(
      'scenes',
      '## Scenes',
      'All boxes are given at once, as float32 in place, or as doubles by `setAll`; a frame includes giving the boxes and finding the pairs.',
      scenesTable(record),
      '### Techniques',
      '`update` alone; the fastest is in bold.',
      techniquesTable(record),
    ),
    part('queries', '## Queries', '1,000 queries per frame.', queriesTable(record)),
    part('native', '## Native libraries, side by side', versionsOf(record), nativeTable(record)),
  );
}

const versionsOf = ({ rows, native }) =>
  `${[...new Set(rows.flatMap(({ versions = [] }) => versions))].join('; ')}.${native ? ` ${native.date.slice(0, 10)}, ours of commit ${native.commit}.` : ''}`;

const goalTable = (reached) =>
  markdownTable(
    ['goal', 'figure', 'met'],
    reached.map(({ goal, figure, met }) => [goal, figure, met === undefined ? 'not measured' : met ? 'yes' : 'no']),
  );

/** Things, and scenes with their boxes, that README.md shows. */
const headlineThings = [50, 200, 1000, 10_000, 100_000];
const headlineScenes = [
  'uniform2d 10000',
  'uniform2d 100000',
  'uniform2d 1000000',
  'mixed2d 100000',
  'clustered2d 100000',
  'static2d 100000',
  'uniform3d 100000',
  'rain 15505',
];

/** What scenes whose names begin like this are. */
const sceneWords = {
  uniform: 'all move',
  mixed: 'sizes from 2 to 2,000',
  clustered: 'twenty crowds',
  static: '5 % move',
  rain: 'a recorded Box2D game',
};

export function headlineOf(record) {
  const scenes = ofKind(record, 'scenes').filter(
    ({ name, count, numbers }) => numbers === 'float32' && headlineScenes.includes(`${name} ${count}`),
  );
  const legend = Object.entries(sceneWords)
    .filter(([word]) => scenes.some(({ name }) => name.startsWith(word)))
    .map(([word, text]) => `\`${word}\`: ${text}`);
  const order = ({ name, count }) => headlineScenes.indexOf(`${name} ${count}`);
  const cells = scenes
    .sort((a, b) => order(a) - order(b))
    .map((row) => {
      const [auto, peer] = [named(row, 'auto'), fastest(row, isPackage)];
      const against =
        peer && auto
          ? [`${short(peer.total.median)} ${peer.name}`, times(peer.total.median / auto.total.median)]
          : [none(row), ''];
      return [row.name, whole(row.count), whole(row.pairs.mean), auto ? short(auto.total.median) : '', ...against];
    });
  return joined(
    originOf(record),
    'A whole frame of a game: its things are objects, their boxes are given, all pairs found, and both things of each pair read.',
    worthTable(record, headlineThings),
    `The kernel alone, with boxes written in place as float32. The ratio is the package's time divided by that of \`auto\`. ${legend.join('; ')}.`,
    markdownTable(['scene', 'boxes', 'pairs', '`auto`', 'the fastest npm package', 'ratio'], cells),
  );
}

/** What docs/guides/worth-it.md shows. */
export const worthOf = (record) =>
  joined(
    originOf(record),
    worthTable(record),
    'All move: the time of each package divided by that of `set`.',
    objectsOthers(record),
  );

const [begin, end] = ['<!-- figures: written by npm run bench -->', '<!-- end of figures -->'];

/** Replaces the text between the two marks of a document. */
export function putFigures(text, figures) {
  const [from, to] = [text.indexOf(begin), text.indexOf(end)];
  if (from < 0 || to < from) throw new Error('The document has no marks for the figures.');
  return `${text.slice(0, from)}${begin}\n${figures}\n${text.slice(to)}`;
}

// A table for each kind of rows.
import { motionCells, motionTitles } from './motions.mjs';
import { autoAgainstBest, fastest, isPackage, named, none, ofKind, timed } from './rows.mjs';
import { markdownTable, short, times, whole } from './words.mjs';

const cell = (found) => (found ? short(found.total.median) : '');
const withName = (found) => (found ? `${short(found.total.median)} ${found.name}` : '');
const pairsOf = ({ pairs }) => `${whole(pairs.mean)} (${whole(pairs.least)}–${whole(pairs.most)})`;

/** Whole frames from objects. `counts`: only these numbers of things. */
export function objectsTable(record, counts) {
  const rows = ofKind(record, 'objects').filter(({ count }) => !counts || counts.includes(count));
  const titles = [
    'things',
    '',
    '`set` each',
    '`boxes()`',
    'brute force',
    'sort and sweep',
    'grid in a Map',
    'the fastest npm package',
    'pairs',
  ];
  const cells = rows.map((row) => {
    const movers = named(row, 'set movers');
    const ours = movers ? `${cell(named(row, 'set'))}; movers only ${cell(movers)}` : cell(named(row, 'set'));
    const others = ['boxes()', 'brute force', 'sort and sweep', 'grid in a Map'].map(
      (name) => cell(named(row, name)) || 'slow',
    );
    return [whole(row.count), row.name, ours, ...others, withName(fastest(row, isPackage)), whole(row.pairs.mean)];
  });
  return markdownTable(titles, cells);
}

/** The time of each contender divided by that of `set`. */
export function objectsOthers(record) {
  const rows = ofKind(record, 'objects').filter(({ name }) => name === 'all move');
  const names = [...new Set(rows.flatMap(({ contenders }) => contenders.filter(isPackage).map(({ name }) => name)))];
  const titles = ['package', ...rows.map(({ count }) => whole(count))];
  const cells = names.map((name) => [
    name,
    ...rows.map((row) => {
      const [found, ours] = [named(row, name), named(row, 'set')];
      const entrant = row.contenders.find((each) => each.name === name);
      if (!found) return entrant?.error ? 'failed' : entrant?.slow ? 'slow' : '';
      return `${times(found.total.median / ours.total.median)}${found.wrong ? ' WRONG' : ''}`;
    }),
  ]);
  return markdownTable(titles, cells);
}

export function scenesTable(record) {
  const rows = ofKind(record, 'scenes').filter(({ numbers }) => numbers === 'float32');
  const doubles = new Map(
    ofKind(record, 'scenes')
      .filter(({ numbers }) => numbers === 'double')
      .map((row) => [`${row.name} ${row.count}`, row]),
  );
  const titles = [
    'scene',
    'boxes',
    'pairs: mean (min–max)',
    '`auto`',
    'in doubles',
    'the fastest npm package',
    'ratio',
    'in frames',
  ];
  const cells = rows.map((row) => {
    const auto = named(row, 'auto');
    const peer = fastest(row, isPackage);
    const double = doubles.get(`${row.name} ${row.count}`);
    const inDoubles = double && named(double, 'auto');
    return [
      row.name,
      whole(row.count),
      pairsOf(row),
      cell(auto),
      inDoubles ? `${cell(inDoubles)}; update alone ${times(inDoubles.update.median / auto.update.median)}` : '',
      peer ? withName(peer) : none(row),
      peer && auto ? times(peer.total.median / auto.total.median) : '',
      `${row.frames}${peer && peer.timed < row.frames ? `; package ${peer.timed} of them` : ''}`,
    ];
  });
  return markdownTable(titles, cells);
}

export function techniquesTable(record) {
  const rows = ofKind(record, 'scenes').filter(
    (row) => row.numbers === 'float32' && timed(row).filter(({ peer }) => peer === 'broadphase').length > 4,
  );
  const ours = rows.flatMap((row) => row.contenders.filter(({ peer }) => peer === 'broadphase'));
  const names = [...new Set(ours.map(({ name }) => name))];
  const cells = rows.map((row) => {
    const judged = autoAgainstBest(row);
    const figures = names.map((name) => {
      const found = named(row, name);
      const text = found ? short(found.update.median) : 'slow';
      return name === judged?.best ? `**${text}**` : text;
    });
    const verdict = judged ? `${times(judged.ratio)}${judged.within ? '' : ' (missed)'}` : '';
    return [row.name, whole(row.count), ...figures, verdict];
  });
  return markdownTable(['scene', 'boxes', ...names, '`auto` against the best'], cells);
}

export const motionsTable = (record, kind) => {
  const rows = ofKind(record, kind);
  const sets = [...new Set(rows.map(({ set }) => set))];
  const titled = { tune: 'For tuning:', check: 'For validation:' };
  return sets
    .map((set) => {
      const table = markdownTable(motionTitles, rows.filter((row) => row.set === set).map(motionCells));
      return titled[set] ? `${titled[set]}\n\n${table}` : table;
    })
    .join('\n\n');
};

export function queriesTable(record) {
  const titles = ['query', 'boxes', '`broadphase`', 'the fastest npm package', 'ratio', 'answers'];
  const cells = ofKind(record, 'queries').map((row) => {
    const [ours, peer] = [named(row, 'broadphase'), fastest(row, isPackage)];
    const when = row.still ? '' : ' after an update of all';
    const name = `\`${row.name.replace('-moved', '')}\`${when}`;
    const ratio = peer && ours ? times(peer.total.median / ours.total.median) : '';
    return [name, whole(row.count), cell(ours), withName(peer), ratio, whole(row.pairs.mean)];
  });
  return markdownTable(titles, cells);
}

export function onceTable(record) {
  const rows = ofKind(record, 'once');
  const names = [...new Set(rows.flatMap(({ contenders }) => contenders.map(({ name }) => name)))];
  const both = (found) => {
    if (found?.first === undefined) return found?.error ? 'failed' : 'slow';
    return `${short(found.first)} / ${found.later === undefined ? '' : short(found.later)}${found.wrong ? ' WRONG' : ''}`;
  };
  const cells = rows.map((row) => [
    `\`${row.name}\``,
    whole(row.count),
    ...names.map((name) => both(row.contenders.find((each) => each.name === name))),
    whole(row.pairs.mean),
  ]);
  return markdownTable(['call', 'boxes', ...names, 'pairs'], cells);
}

export function coldTable(record) {
  const rows = record.rows.filter(({ kind }) => kind === 'cold');
  const cells = rows.flatMap((row) =>
    row.error
      ? [[row.name, row.error, '', '', '', '', '']]
      : row.contenders.map(({ name, first, ten, all, own, kB }) => [
          row.name,
          name,
          short(first),
          ten ? short(ten) : '',
          all ? short(all) : '',
          own ? short(own) : '',
          kB ? short(kB) : '',
        ]),
  );
  return markdownTable(
    ['', 'contender', 'first', 'mean of ten frames', 'of 120', 'of first: import to pairs', 'script, kB gzipped'],
    cells,
  );
}

export function nativeTable(record) {
  const rows = ofKind(record, 'native');
  const cells = rows.flatMap((row) => {
    const ours = named(row, 'strip-sweep');
    return timed(row).map((each) => [
      row.name,
      whole(row.count),
      each.name,
      short(each.total.median),
      times(each.total.median / ours.total.median),
      `${each.timed}${each.wrong ? '; WRONG' : ''}`,
    ]);
  });
  return markdownTable(['scene', 'boxes', 'contender', 'ms', 'of strip-sweep', 'frames'], cells);
}

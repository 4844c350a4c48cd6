// Is it worth it? By number of things: hand-written code, packages, this library, and which of them is fast enough.
import { fastest, isPackage, named, ofKind } from './rows.mjs';
import { markdownTable, short, whole } from './words.mjs';

/** A frame at 60 Hz in milliseconds, and the share of it that is negligible. */
const frame = 1000 / 60;
const missed = 0.01;

/** The simplest contender that is fast enough: below a hundredth of a frame, time does not matter. */
export function adviceOf(row) {
  const isEnough = (name) => named(row, name)?.total.median < missed * frame;
  if (isEnough('brute force')) return 'fifteen lines';
  const byHand = ['sort and sweep', 'grid in a Map'].find(isEnough);
  return byHand ?? '`broadphase`';
}

/** Whole frames from objects, and what is fast enough. `counts`: only these numbers of things. */
export function worthTable(record, counts) {
  const rows = ofKind(record, 'objects').filter(({ count }) => !counts || counts.includes(count));
  const titles = [
    'things',
    'fast enough',
    'brute force',
    'sort and sweep',
    'grid in a Map',
    'the fastest npm package',
    '`broadphase`, by `set`',
    'by `boxes()`',
  ];
  const cells = rows.map((row) => {
    const [of, peer] = [(name) => named(row, name), fastest(row, isPackage)];
    const byHand = ['brute force', 'sort and sweep', 'grid in a Map'].map((name) => of(name));
    const ours = [of('set movers') ?? of('set'), of('boxes()')];
    return [
      row.name === 'all move' ? whole(row.count) : `${whole(row.count)}, ${row.name}`,
      adviceOf(row),
      ...byHand.map((found) => (found ? short(found.total.median) : 'slow')),
      peer ? `${short(peer.total.median)} ${peer.name}` : 'slow',
      ...ours.map((found) => (found ? short(found.total.median) : '')),
    ];
  });
  return markdownTable(titles, cells);
}

// The tables of the benchmark's page, as rows of text.
import { goals } from './goals.mjs';
import { motionCells, motionTitles } from './motions.mjs';

const plain = (text) => text.replaceAll('`', '');

export function figuresOf(record) {
  const rows = record.rows.filter(({ kind }) => kind === 'motions' || kind === 'movers');
  return {
    titles: motionTitles.map(plain),
    motions: rows.map(motionCells),
    goals: goals(record)
      .filter(({ figure }) => figure)
      .map(({ goal, figure, met }) => [plain(goal), figure, met ? 'yes' : 'no']),
  };
}

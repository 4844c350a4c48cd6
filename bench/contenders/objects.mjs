// A frame as a game has it: objects with x, y, width and height in doubles. This library, given the boxes in three
// ways, and hand-written code. All find every pair and read both of its objects.
import { BroadPhase } from '../../build/bench/library.mjs';
import { PairList } from '../peers/kit/pair-list.mjs';
import { everyPair, Grid, SortAndSweep } from './by-hand.mjs';

export const byHand = ['brute force', 'sort and sweep', 'grid in a Map'];
export const ours = ['set', 'set movers', 'boxes()'];

export const create = ({ things, variant }) =>
  byHand.includes(variant) ? hand(things, variant) : library(things, variant);

function library(things, variant) {
  const space = new BroadPhase();
  return {
    give: { set, 'set movers': setMovers, 'boxes()': write }[variant],
    update() {
      space.update();
      return space.pairCount;
    },
    walk: () => lookAt(things, space.pairs),
    pairs: () => space.pairs,
    stats: () => ({ bytes: space.stats.bytes, kept: space.stats.technique === 'incremental' }),
    dispose: () => space.dispose(),
  };

  function set() {
    for (let i = 0; i < things.length; i++) {
      const { x, y, width, height } = things[i];
      space.set(i, x, y, x + width, y + height);
    }
  }

  function setMovers() {
    for (let i = 0; i < things.length; i++) {
      const { x, y, width, height, moved } = things[i];
      if (moved || !space.has(i)) space.set(i, x, y, x + width, y + height);
    }
  }

  function write() {
    const boxes = space.boxes(things.length);
    for (let i = 0, k = 0; i < things.length; i++) {
      const { x, y, width, height } = things[i];
      boxes[k++] = x;
      boxes[k++] = y;
      boxes[k++] = x + width;
      boxes[k++] = y + height;
    }
  }
}

function hand(things, variant) {
  const list = new PairList();
  const method = { 'brute force': () => everyPair, 'sort and sweep': sweep, 'grid in a Map': grid }[variant]();
  return {
    update: () => method(things, undefined),
    pairs() {
      list.clear();
      method(things, list);
      return list.pairs();
    },
  };

  function sweep() {
    const kept = new SortAndSweep();
    return (all, collect) => kept.find(all, collect);
  }

  function grid() {
    const kept = new Grid();
    return (all, collect) => kept.find(all, collect);
  }
}

/** What a game does with the pairs: it reads both objects. */
export function lookAt(things, pairs) {
  let sum = 0;
  for (let k = 0; k < pairs.length; k += 2) sum += things[pairs[k]].id ^ things[pairs[k + 1]].id;
  return sum;
}

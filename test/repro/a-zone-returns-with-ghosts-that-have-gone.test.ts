// What a tester found: a zone that returned with an old state kept ghosts that had gone in the meantime, and reported
// pairs with them, though the others had resent what it must see. All of these use the three arrays alone, as a network
// does; test/entries/shard-return.test.ts plays the same with random worlds.
import { BroadPhase } from 'broadphase';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import { expect, test } from 'vitest';

const zones = new Zones({ borders: { x: [100, 200] } });
const make = (zone: number, state?: Delta) => new Shard(zones, zone, new BroadPhase({ events: true }), { state });
const sent = ({ from, to, ids, changes, boxes }: Delta): Delta => ({ from, to, ids, changes, boxes });
const tick = (...shards: Shard[]) => {
  const deltas = shards.flatMap((shard) => shard.exchange()).map(sent);
  for (const shard of shards) shard.update(deltas.filter(({ to }) => to === shard.zone));
  return deltas;
};

test('a ghost that moved away while the zone was dead is gone', () => {
  const left = make(0).set(1, 90, 0, 110, 10);
  let right = make(1).set(2, 105, 0, 106, 1);
  tick(left, right);
  const saved = right.state();
  expect([...saved.ids].sort()).toEqual([1, 2]);
  left.forget(1);
  left.set(1, 10, 0, 20, 10).exchange();
  left.update();
  right = make(1, saved);
  left.resend(1);
  right.resend(0);
  // Nothing is left to tell, and that is told.
  expect(tick(left, right).map(({ to, ids, changes }) => [to, ...ids, ...changes])).toEqual([
    [1, 32],
    [0, 32],
  ]);
  expect([right.sees(1), [...right.pairs], [...right.ended]]).toEqual([false, [], [1, 2]]);
});

test('a zone that comes back before it was missed takes the place of its newer self', () => {
  let left = make(0).set(1, 90, 0, 110, 10);
  const right = make(1).set(2, 105, 0, 106, 1);
  tick(left, right);
  const saved = left.state();
  left.set(3, 90, 0, 110, 10);
  tick(left, right);
  expect([...right.ids()].sort()).toEqual([1, 2, 3]);
  left = make(0, saved);
  left.resend(1);
  right.resend(0);
  tick(left, right);
  expect([...right.ids()].sort()).toEqual([1, 2]);
});

test('who forgot a zone says that its pairs begin again', () => {
  let left = make(0).set(1, 90, 0, 110, 10);
  const right = make(1).set(2, 105, 0, 106, 1);
  tick(left, right);
  const saved = left.state();
  right.forget(0);
  expect([...right.update().ended]).toEqual([1, 2]);
  left = make(0, saved);
  left.resend(1);
  right.resend(0);
  tick(left, right);
  expect([[...right.began], [...right.pairs]]).toEqual([
    [1, 2],
    [1, 2],
  ]);
});

test('a hand-over that crosses a resend is not undone', () => {
  const [left, middle] = [make(0), make(1).set(1, 110, 0, 120, 10)];
  tick(left, middle);
  // The middle zone hands a box over, and still sees it. The left zone does not know that it has it when it resends.
  middle.set(1, 95, 0, 120, 10);
  left.resend(1);
  tick(left, middle);
  expect([left.owns(1), middle.sees(1)]).toEqual([true, true]);
  // Nor when the message is late by several ticks.
  middle.set(2, 90, 0, 110, 10);
  left.resend(1);
  const [resent] = left.exchange();
  const [given] = middle.exchange();
  middle.update();
  middle.exchange();
  middle.update([resent]);
  left.update([given]);
  expect([left.owns(2), middle.sees(2)]).toEqual([true, true]);
});

test('a hand-over between two others that crosses a resend is not undone', () => {
  const [left, middle, right] = [make(0).set(1, 90, 0, 250, 10), make(1), make(2)];
  tick(left, middle, right);
  left.set(1, 110, 0, 250, 10);
  middle.resend(2);
  const [given] = left.exchange().filter(({ to }) => to === 2);
  const [resent] = middle.exchange();
  right.update([given]);
  right.update([resent]);
  expect(right.sees(1)).toBe(true);
});

test('a box that is taken after `resend` was called is sent too', () => {
  const [left, middle] = [make(0).set(1, 90, 0, 250, 10), make(1)];
  tick(left, middle);
  left.set(1, 110, 0, 250, 10);
  const [given] = left.exchange().filter(({ to }) => to === 1);
  middle.resend(2);
  middle.update([given]);
  const [resent] = middle.exchange();
  expect([resent.to, ...resent.ids, ...resent.changes]).toEqual([2, 1, 1, 32]);
});

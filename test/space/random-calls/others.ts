// Calls that more than one object takes part in: another space, a recording, a visitor that changes boxes.
import { BroadPhase } from 'broadphase';
import { applyFrame, openTrace } from 'broadphase/trace';
import fc from 'fast-check';
import { expect } from 'vitest';
import { expectKeys } from '../../support/expect-pairs.ts';
import { meet } from '../../support/model.ts';
import { setBox } from '../../support/set-box.ts';
import { ascending, call, copy, type Model, on, overlap, put, type RandomCall, type World } from './model.ts';
import { anId, bits, shapes, show } from './values.ts';

/** The pairs of a box here and one there, as text, sorted. */
function between(here: Model['seen'], there: Model['seen'], world: World): string[] {
  const found: string[] = [];
  for (const [a, one] of here) {
    for (const [b, other] of there) {
      // Neither groups nor what is static matters between two spaces.
      const meets = meet({ ...one, isStatic: false, group: 0 }, other);
      if (meets && overlap(world, one, other)) found.push(`${a} ${b}`);
    }
  }
  return found.sort();
}

const texts = (pairs: Uint32Array) =>
  Array.from({ length: pairs.length / 2 }, (_, k) => `${pairs[2 * k]} ${pairs[2 * k + 1]}`).sort();

export function others(dimensions: 2 | 3): RandomCall[] {
  return [...anotherSpace(dimensions), replayed, aVisitor(dimensions)];
}

function anotherSpace(dimensions: 2 | 3): RandomCall[] {
  const { aBox } = shapes(dimensions);
  const change = fc.tuple(anId, aBox, bits, fc.constantFrom(0, 0, 1, undefined));
  return [
    fc.tuple(fc.array(change, { maxLength: 6 }), fc.boolean(), fc.boolean()).map(([changes, updates, forth]) =>
      call(
        `pairsWith another, from here: ${forth}, changed by ${show(changes.flat(2))}, updated: ${updates}`,
        (model, space) => {
          const { other, seen, world } = model;
          for (const [id, box, mask, reach] of changes) changeOther(other, id, box, mask, reach);
          if (updates) other.space.update();
          if (updates) other.seen = copy(other.entries);
          const [here, there] = forth ? [space, other.space] : [other.space, space];
          const expected = forth ? between(seen, other.seen, world) : between(other.seen, seen, world);
          expect(texts(here.pairsWith(there))).toEqual(expected);
        },
      ),
    ),
    fc.constant(
      call('another restores a snapshot of this', ({ other, entries }, space) => {
        other.space.restore(space.snapshot());
        other.entries = copy(entries);
        other.seen = copy(entries);
      }),
    ),
  ];
}

/** Without a reach, the box is deleted. */
function changeOther(other: Model['other'], id: number, box: number[], mask: number, reach: number | undefined): void {
  if (reach === undefined) {
    expect(other.space.delete(id)).toBe(other.entries.delete(id));
    return;
  }
  setBox(other.space, id, box).setFilter(id, 1, mask).setReach(id, reach);
  put(other, id, box);
  Object.assign(other.entries.get(id)!, { layer: 1, mask, reach });
}

const replayed: RandomCall = fc.constant(
  call('the recording so far is replayed', ({ recording, frames, world }, { dimensions }) => {
    const copied = new BroadPhase<2 | 3>({ dimensions, ...world });
    let played = 0;
    expect(recording!.fault).toBeUndefined();
    for (const frame of openTrace(recording!.bytes())) {
      applyFrame(copied, frame);
      expectKeys(copied.update(), frames[played++]!);
    }
    expect(played).toBe(frames.length);
  }),
);

/** It is given each box that the last update saw, whatever it does to them. */
function aVisitor(dimensions: 2 | 3): RandomCall {
  const { aBox } = shapes(dimensions);
  const everywhere = [...Array<number>(dimensions).fill(-Infinity), ...Array<number>(dimensions).fill(Infinity)];
  const change = fc.tuple(anId, aBox, fc.boolean());
  return fc.tuple(fc.array(change, { maxLength: 5 }), fc.constantFrom(everywhere, undefined)).map(([changes, box]) =>
    call(`${box ? 'queryBox' : 'queryPlanes'} whose visitor changes ${show(changes.flat(2))}`, (model, space) => {
      const visited: number[] = [];
      const visit = (id: number) => {
        visited.push(id);
        const [at, its, stays] = changes[visited.length - 1] ?? [];
        if (at === undefined) return;
        model.view = undefined;
        if (model.entries.delete(at)) model.gone.add(at);
        space.delete(at);
        if (!stays) return;
        setBox(space, at, its!);
        put(model, at, its!);
      };
      if (box) on(space).queryBox(...box, { visit, touching: true });
      else space.queryPlanes([], { visit, touching: true });
      expect(ascending(visited)).toEqual(ascending([...model.seen].flatMap(([id, { isOff }]) => (isOff ? [] : [id]))));
    }),
  );
}

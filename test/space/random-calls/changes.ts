// Calls that change what stands in a space, and what the model makes of them.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { expect } from 'vitest';
import { expectKeys } from '../../support/expect-pairs.ts';
import { pathOf } from '../../support/path-of.ts';
import { setBox } from '../../support/set-box.ts';
import {
  all,
  call,
  copy,
  expectEvents,
  type Model,
  on,
  pairsOf,
  put,
  type RandomCall,
  replace,
  update,
} from './model.ts';
import { anId, bits, shapes, show, tuple } from './values.ts';

/** Boxes come, move and go. */
export function changes(dimensions: 2 | 3): RandomCall[] {
  const { aBox, aPoint, aWay } = shapes(dimensions);
  const rowOf = (model: Model, id: number) => [...model.view!.subarray(id * 2 * dimensions, (id + 1) * 2 * dimensions)];

  return [
    fc.tuple(anId, aBox).map(([id, box]) =>
      call(`set(${id}, ${show(box)})`, (model, space) => {
        expect(setBox(space, id, box)).toBe(space);
        put(model, id, box);
      }),
    ),
    fc.tuple(anId, aBox, aWay).map(([id, box, way]) =>
      call(`setSwept(${show([id, ...box, ...way])})`, (model, space) => {
        expect(on(space).setSwept(id, ...box, ...way)).toBe(space);
        put(model, id, pathOf(box, way));
      }),
    ),
    fc.tuple(anId, aPoint, tuple(fc.constantFrom(0, 0.5, 1, 3), dimensions)).map(([id, centre, half]) =>
      call(`setCentred(${show([id, ...centre, ...half])})`, (model, space) => {
        expect(on(space).setCentred(id, ...centre, ...half)).toBe(space);
        put(model, id, [...centre.map((x, a) => x - half[a]!), ...centre.map((x, a) => x + half[a]!)]);
      }),
    ),
    fc.tuple(fc.array(aBox, { maxLength: 20 }), fc.nat(9)).map(([given, more]) =>
      call(`setAll(${show([...given.flat(), `${more} more`])}, ${given.length})`, (model, space) => {
        const rest = Array<number>(more).fill(Number.NaN);
        expect(space.setAll([...given.flat(), ...rest], given.length)).toBe(space);
        replace(model, given);
        model.view = undefined;
      }),
    ),
    fc
      .tuple(fc.array(aBox, { maxLength: 20 }), fc.constantFrom('array', 'doubles', 'floats', 'boxes'))
      .map(([given, how]) =>
        call(`setAll(${how} ${show(given.flat())})`, (model, space) => {
          const floats = how === 'floats' || how === 'boxes';
          const boxes = floats ? given.map((box) => box.map(Math.fround)) : given;
          const flat = boxes.flat();
          model.view = undefined;
          if (how === 'boxes') {
            model.view = space.boxes(boxes.length);
            model.view.set(flat);
          } else
            space.setAll(how === 'array' ? flat : how === 'floats' ? Float32Array.from(flat) : Float64Array.from(flat));
          replace(model, boxes);
          expect(space.size).toBe(boxes.length);
        }),
      ),
    fc.nat(30).map((count) =>
      call(`boxes(${count})`, (model, space) => {
        const { entries } = model;
        const nothing = Array<number>(2 * dimensions).fill(0);
        replace(
          model,
          Array.from({ length: count }, (_, id) => (entries.get(id)?.box ?? nothing).map(Math.fround)),
        );
        model.view = space.boxes(count);
        for (let id = 0; id < count; id++) expect(rowOf(model, id)).toEqual(model.entries.get(id)!.box);
      }),
    ),
    ...[1, 2].map(() =>
      fc.tuple(fc.nat(30), aBox).map(([id, box]) =>
        call(`view[${id}] = ${show(box)}`, (model) => {
          if (!model.view || id >= model.view.length / (2 * dimensions)) return;
          // A fraction that no other call gives: what is shown already, when it is written again, is no change.
          const floats = box.map((x) => Math.fround(x + 1 / 1024));
          const shown = rowOf(model, id);
          model.view.set(floats, id * 2 * dimensions);
          const its = model.entries.get(id)!;
          its.box = its.box.map((x, k) => (floats[k] === shown[k] ? x : floats[k]!));
          for (let a = 0; a < dimensions; a++) {
            if (its.box[a]! <= its.box[a + dimensions]!) continue;
            its.box[a] = floats[a]!;
            its.box[a + dimensions] = floats[a + dimensions]!;
          }
        }),
      ),
    ),
    anId.map((id) =>
      call(`delete(${id})`, (model, space) => {
        model.view = undefined;
        const had = model.entries.delete(id);
        if (had) model.gone.add(id);
        expect(space.delete(id)).toBe(had);
      }),
    ),
    anId.map((id) =>
      call(`get(${id})`, (model, space) => {
        expect(space.has(id)).toBe(model.entries.has(id));
        expect(space.get(id, [])).toEqual(model.entries.get(id)?.box);
        expect(space.size).toBe(model.entries.size);
      }),
    ),
    fc.constant(
      call('keys(), and what belongs to them', (model, space) => {
        expect([...space.keys()]).toEqual([...model.entries.keys()]);
        for (const [id, { layer, mask, isStatic, isOff = false, group = 0, reach = 0 }] of model.entries) {
          expect(space.filterOf(id)).toEqual({ layer, mask });
          expect([space.isStatic(id), space.isEnabled(id)]).toEqual([isStatic, !isOff]);
          expect([space.groupOf(id), space.reachOf(id)]).toEqual([group, reach]);
        }
      }),
    ),
    fc.constant(
      call('clear()', (model, space) => {
        space.clear();
        replace(model, []);
        model.view = undefined;
      }),
    ),
  ];
}

/** What belongs to an id, the technique, and updates. */
export function rules(): RandomCall[] {
  return [
    fc.tuple(anId, bits, bits).map(([id, layer, mask]) =>
      call(`setFilter(${id}, ${layer}, ${mask})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) Object.assign(known, { layer, mask });
        if (known) expect(space.setFilter(id, layer, mask)).toBe(space);
        else expect(() => space.setFilter(id, layer, mask)).toThrow(`setFilter: there is no box ${id}`);
      }),
    ),
    fc.tuple(anId, fc.boolean()).map(([id, isStatic]) =>
      call(`setStatic(${id}, ${isStatic})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) known.isStatic = isStatic;
        if (known) expect(space.setStatic(id, isStatic)).toBe(space);
        else expect(() => space.setStatic(id, isStatic)).toThrow(`setStatic: there is no box ${id}`);
      }),
    ),
    fc.tuple(anId, fc.boolean()).map(([id, enabled]) =>
      call(`setEnabled(${id}, ${enabled})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) known.isOff = !enabled;
        if (known) expect(space.setEnabled(id, enabled)).toBe(space);
        else expect(() => space.setEnabled(id, enabled)).toThrow(`setEnabled: there is no box ${id}`);
        expect(space.isEnabled(id)).toBe(known !== undefined && enabled);
      }),
    ),
    fc.tuple(anId, fc.constantFrom(0, 1, 2, all)).map(([id, group]) =>
      call(`setGroup(${id}, ${group})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) known.group = group;
        if (known) expect(space.setGroup(id, group)).toBe(space);
        else expect(() => space.setGroup(id, group)).toThrow(`setGroup: there is no box ${id}`);
      }),
    ),
    fc.tuple(anId, fc.constantFrom(0, 1, 0.1, 2.5)).map(([id, reach]) =>
      call(`setReach(${id}, ${reach})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) known.reach = reach;
        if (known) expect(space.setReach(id, reach)).toBe(space);
        else expect(() => space.setReach(id, reach)).toThrow(`setReach: there is no box ${id}`);
      }),
    ),
    fc.constantFrom(...BroadPhase.techniques).map((technique) =>
      call(`technique = ${technique}`, (_, space) => {
        space.technique = technique;
        expect(space.technique).toBe(technique);
      }),
    ),
    ...[1, 2, 3].map(() => fc.constant(call('update()', update))),
  ];
}

/** Snapshots, and what only looks. */
export function saves(dimensions: 2 | 3): RandomCall[] {
  return [
    fc.constant(
      call('structure()', (_, space) => {
        const cells = space.structure();
        expect(cells.length % (2 * dimensions)).toBe(0);
        space.validate();
      }),
    ),
    fc.constant(
      call('snapshot()', (model, space) => {
        const { entries, gone, before, began, ended } = model;
        model.saved = { bytes: space.snapshot(), entries: copy(entries), gone: new Set(gone), before, began, ended };
      }),
    ),
    fc.constant(
      call('restore(what was saved)', (model, space) => {
        const { saved } = model;
        if (!saved) return;
        expect(space.restore(saved.bytes)).toBe(space);
        model.view = undefined;
        model.entries = copy(saved.entries);
        model.gone = new Set(saved.gone);
        model.before = saved.before;
        model.began = saved.began;
        model.ended = saved.ended;
        model.seen = copy(saved.entries);
        const keys = pairsOf(model.entries, model.world);
        expectKeys(space, keys);
        expectEvents(model, space);
        model.shown = new Set(keys);
        expect(Buffer.compare(space.snapshot(), saved.bytes)).toBe(0);
      }),
    ),
    fc.tuple(fc.nat(), fc.nat(7)).map(([at, bit]) =>
      call(`restore(what was saved, but for bit ${bit} of byte ${at})`, (model, space) => {
        if (!model.saved) return;
        const bytes = model.saved.bytes.slice();
        bytes[at % bytes.length]! ^= 1 << bit;
        expect(() => space.restore(bytes)).toThrow(/^restore: /);
      }),
    ),
  ];
}

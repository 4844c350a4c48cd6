// What the types refuse and what they infer: compiled by `npm run check`, never run. An `@ts-expect-error` over a line
// that has no error is an error itself.
import type { BroadPhase as Flat } from '../../src/2d.ts';
import * as flat from '../../src/2d.ts';
import * as solid from '../../src/3d.ts';
import * as all from '../../src/all.ts';
import {
  type Box,
  type BoxOfId,
  BroadPhase,
  type BroadPhaseOptions,
  findPairs,
  type MovingBox,
  type TechniqueName,
} from '../../src/index.ts';
import { record } from '../../src/trace/index.ts';

/** Compiles where both types are the same. */
type Same<A, B> = (<T>() => T extends A ? 1 : 2) extends <T>() => T extends B ? 1 : 2 ? true : false;
const same = <A, B>(..._: Same<A, B> extends true ? [] : [never]): void => {};

const space2 = new BroadPhase();
const space3 = new BroadPhase({ dimensions: 3 });
declare const either: 2 | 3;
const spaceOfEither = new BroadPhase({ dimensions: either });

// The dimension is inferred from the options.
same<typeof space2, BroadPhase<2>>();
same<typeof space2, BroadPhase>();
same<typeof space3, BroadPhase<3>>();
same<typeof spaceOfEither, BroadPhase<2 | 3>>();
same<typeof space3.dimensions, 3>();
const withOptions = new BroadPhase({ events: true, technique: 'strip-sweep' });
same<typeof withOptions, BroadPhase<2>>();
declare const options: BroadPhaseOptions;
declare const optionsOfEither: BroadPhaseOptions<2 | 3>;
const withTheirs = [new BroadPhase(options), new BroadPhase(optionsOfEither)] as const;
same<typeof withTheirs, readonly [BroadPhase<2>, BroadPhase<2 | 3>]>();
declare const optionsOfThree: BroadPhaseOptions<3>;
// @ts-expect-error: they need not say so, and two is the default
new BroadPhase(optionsOfThree);
new BroadPhase({ ...optionsOfThree, dimensions: 3 });

// A box has as many numbers as the space has dimensions for.
space2.set(1, 0, 0, 1, 1).setSwept(1, 0, 0, 1, 1, 5, 5);
space3.set(1, 0, 0, 0, 1, 1, 1).setSwept(1, 0, 0, 0, 1, 1, 1, 5, 5, 5);
spaceOfEither.set(1, 0, 0, 1, 1).set(1, 0, 0, 0, 1, 1, 1);
// @ts-expect-error: four numbers in 3D
space3.set(1, 0, 0, 1, 1);
// @ts-expect-error: six numbers in 2D
space2.set(1, 0, 0, 0, 1, 1, 1);
// @ts-expect-error: five numbers in either
spaceOfEither.set(1, 0, 0, 0, 1, 1);
// @ts-expect-error: no number
space2.set(1, 0, 0, 1, '1');
// @ts-expect-error: a way of two numbers in 3D
space3.setSwept(1, 0, 0, 0, 1, 1, 1, 5, 5);

// So have the queries.
space2.queryBox(0, 0, 1, 1, { mask: 1 });
space3.queryBox(0, 0, 0, 1, 1, 1, { mask: 1 });
space2.queryPoint(0, 0);
space3.queryPoint(0, 0, 0);
space2.queryCircle(0, 0, 1);
space3.querySphere(0, 0, 0, 1);
space2.queryPlanes(new Float32Array(3), { visit: (id, inside) => inside && id > 3 });
space3.queryPlanes([0, 0, 1, 0]).at(0);
// @ts-expect-error: a plane is numbers, not an object
space3.queryPlanes([{ normal: [0, 0, 1], constant: 0 }]);
space2.rayCast(0, 0, 1, 0)?.distance.toFixed();
space3.rayCastAll(0, 0, 0, 1, 0, 0, { out: [] }).at(0);
space2.sweep(0, 0, 1, 1, 5, 5, { ignore: 1 })?.time.toFixed();
space2.sweep(0, 0, 1, 1, 5, 5, { accept: (id, hit) => id > hit.time });
space2.sweep(0, 0, 1, 1, 5, 5, { visit: (id, time, hit) => id > time + hit.time });
// @ts-expect-error: a visitor sees all hits
space2.sweep(0, 0, 1, 1, 5, 5, { accept: () => true, visit: () => true });
space3.nearest(0, 0, 0, 2, { maxDistance: 1 });
// @ts-expect-error: a box of four numbers in 3D
space3.queryBox(0, 0, 1, 1);
// @ts-expect-error: a point of three numbers in 2D
space2.queryPoint(0, 0, 0);
// @ts-expect-error: a circle in 3D
space3.queryCircle(0, 0, 1);
// @ts-expect-error: a sphere in 2D
space2.querySphere(0, 0, 0, 1);
// @ts-expect-error: a ray of four numbers in 3D
space3.rayCast(0, 0, 1, 0);
// @ts-expect-error: a ray of six numbers in 2D
space2.rayCastAll(0, 0, 0, 1, 0, 0);
// @ts-expect-error: a box of four numbers that moves along two axes in 3D
space3.sweep(0, 0, 1, 1, 5, 5);
// @ts-expect-error: how many is missing
space3.nearest(0, 0, 0);

// Functions for a space of any dimension pass on a box, or all that a call takes.
export function place<D extends 2 | 3>(space: BroadPhase<D>, id: number, box: Box<D>, way: MovingBox<D>): void {
  space.set(id, ...box).setSwept(id, ...way);
}
export function placeAll<D extends 2 | 3>(space: BroadPhase<D>, ...boxes: BoxOfId<D>[]): void {
  for (const box of boxes) space.set(...box);
}
place(space2, 1, [0, 0, 1, 1], [0, 0, 1, 1, 5, 5]);
placeAll(space3, [1, 0, 0, 0, 1, 1, 1], [2, 0, 0, 0, 1, 1, 1]);

// Types that list the members of what they hold, as those of Vue and Immer do, leave it a space.
type Held<T> = { [Key in keyof T]: T[Key] };
const held: BroadPhase<3> = {} as Held<BroadPhase<3>>;

// A space is not of other dimensions than its variable says.
// @ts-expect-error: it has two
const notSolid: BroadPhase<3> = new BroadPhase();
// @ts-expect-error: it has two
const notSolidEither: BroadPhase<3> = new BroadPhase({ events: true });
// @ts-expect-error: it has three
const notFlat: BroadPhase = new BroadPhase({ dimensions: 3 });
const anySpaces: BroadPhase<2 | 3>[] = [space2, space3, spaceOfEither, new all.BroadPhase()];

// `broadphase` knows its techniques, `broadphase/all` every one, and a space of either can be passed on.
// @ts-expect-error: it is in broadphase/all
new BroadPhase({ technique: 'quadtree' });
// @ts-expect-error: it is in broadphase/all
space2.technique = 'quadtree';
// @ts-expect-error: it is in broadphase/all
findPairs([], { technique: 'quadtree' });
space2.technique = 'strip-sweep';
for (const technique of BroadPhase.techniques) new BroadPhase({ technique });
for (const technique of all.BroadPhase.techniques) new all.BroadPhase({ technique });
same<(typeof all.BroadPhase.techniques)[number], TechniqueName>();
const every = new all.BroadPhase({ technique: 'quadtree', dimensions: 3 });
same<typeof every.dimensions, 3>();
every.technique = 'r-tree';
all.findPairs([], { technique: 'bsp-tree' });
// @ts-expect-error: there is no such technique
new all.BroadPhase({ technique: 'magic' });
const lean: BroadPhase<3> = every;
const back: all.BroadPhase = space2;
record(every);
record(space2);

// Options of techniques that `broadphase` lacks are refused there, as they are when the code runs.
// @ts-expect-error: it is in broadphase/all
new BroadPhase({ cellSize: 8 });
// @ts-expect-error: it is in broadphase/all
new BroadPhase({ dimensions: 3, bounds: [0, 0, 0, 9, 9, 9] });
// @ts-expect-error: it is in broadphase/all
new BroadPhase({ dimensions: either, margin: 1 });
// @ts-expect-error: it is in broadphase/all
findPairs([], { cellSize: [8, 8] });
// @ts-expect-error: it is in broadphase/all
new flat.BroadPhase({ margin: 1 });
// @ts-expect-error: it is in broadphase/all
flat.findPairs([], { bounds: [0, 0, 9, 9] });
// @ts-expect-error: it is in broadphase/all
new solid.BroadPhase({ cellSize: 8 });
declare const optionsOfAll: all.BroadPhaseOptions;
// @ts-expect-error: they may have a cell size
new BroadPhase({ ...optionsOfAll, technique: 'auto' });
new BroadPhase({ cellSize: undefined, bounds: undefined, margin: undefined });
new all.BroadPhase({ technique: 'spatial-grid', cellSize: 8, bounds: [0, 0, 9, 9], margin: undefined });
new all.BroadPhase({ dimensions: 3, cellSize: [8, 8, 8], margin: 1 });
new all.BroadPhase(options);
all.findPairs([], { cellSize: 8 });
all.findPairsBetween([], [], options);

// The entries of one dimension have that one alone.
const ofFlat = new flat.BroadPhase({ events: true });
ofFlat.set(1, 0, 0, 1, 1);
const ofSolid = new solid.BroadPhase();
ofSolid.set(1, 0, 0, 0, 1, 1, 1);
new flat.BroadPhase({ dimensions: 2 });
new solid.BroadPhase({ dimensions: 3 });
// @ts-expect-error: two dimensions alone
new flat.BroadPhase({ dimensions: 3 });
// @ts-expect-error: three dimensions alone
new solid.BroadPhase({ dimensions: 2 });
// @ts-expect-error: four numbers in 3D
ofSolid.set(1, 0, 0, 1, 1);
// @ts-expect-error: two dimensions alone
flat.findPairs([], { dimensions: 3 });
// @ts-expect-error: three dimensions alone
solid.findPairsBetween([], [], { dimensions: 2 });
const asBoth: BroadPhase<2> = ofFlat;
const asFlat: Flat = space2;
record(ofSolid);

// Whether a box is static is said, or left out.
space2.setStatic(1).setStatic(1, false);
// @ts-expect-error: it may be undefined, which is refused
space2.setStatic(1, undefined);
// @ts-expect-error: it may be undefined, which is refused
space2.setEnabled(1, undefined);

export const used = [held, notSolid, notSolidEither, notFlat, anySpaces, lean, back, asBoth, asFlat];

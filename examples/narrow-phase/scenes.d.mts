// For the page of the site that shows these worlds.
import type { BroadPhase } from 'broadphase';

export declare const world: number;

interface World<Thing> {
  readonly space: BroadPhase;
  readonly things: readonly Thing[];
  readonly hits: readonly number[];
  move(): void;
  broad(): void;
  narrow(): void;
  react(): void;
}

interface Point {
  readonly x: number;
  readonly y: number;
}
/** A shape of SAT.js: a circle has a radius, a polygon corners. */
export interface ShapeThing {
  readonly shape: { readonly pos: Point; readonly r?: number; readonly calcPoints?: readonly Point[] };
}
export interface MaskThing {
  readonly mask: { readonly width: number; readonly height: number; readonly solid: Uint8Array };
  readonly left: number;
  readonly top: number;
}
export interface FastThing {
  readonly isBullet: boolean;
  readonly box: readonly [number, number, number, number];
  readonly way: readonly [number, number];
  readonly time: number;
  readonly first: number;
}

export declare function shapes(count?: number, seed?: number): World<ShapeThing>;
export declare function masks(count?: number, seed?: number): World<MaskThing>;
export declare function fastBoxes(count?: number, seed?: number): World<FastThing>;

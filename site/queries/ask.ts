// The interface of a query on the page, what it works with, and what all queries share.
import type { BroadPhase, TechniqueName } from 'broadphase';
import { hues, shades } from '../shared/groups.ts';
import type { Pen } from './pen.ts';

/** The data that a query works with. */
export interface Desk {
  readonly space: BroadPhase<2 | 3>;
  readonly boxes: Float32Array;
  /** The colour slot of every box. */
  readonly slots: Uint8Array;
  /** The side of the world. */
  readonly world: number;
  /** Where the pointer went down, and where it is now: x, y, x, y. */
  readonly aim: Float64Array;
  /** Whether that has changed since the last answer. */
  readonly aimed: boolean;
  readonly k: number;
  readonly radius: number;
  readonly all: boolean;
  /** Whether boxes have to be wholly inside. */
  readonly within: boolean;
  /** The layers that the query asks for. */
  readonly mask: number;
  readonly pen: Pen;
}

export type OptionName = 'k' | 'within' | 'radius' | 'all' | 'mask' | 'meet';

export interface Ask {
  readonly name: string;
  readonly label: string;
  readonly hint: string;
  /** The unit of the number of answers. */
  readonly counts: string;
  readonly options: readonly OptionName[];
  /** The technique that finds the pairs, if the query needs a certain one. */
  readonly technique?: TechniqueName;
  /** Builds what the query takes. */
  prepare?(desk: Desk): void;
  /** Makes the query. This alone is timed. Without it, the answer is there after `update()`, whose time is shown. */
  ask?(desk: Desk): void;
  /** Marks what was found among the boxes, and counts it. */
  mark(desk: Desk): number;
  /** Draws the query and its answer. */
  draw(desk: Desk): void;
  /** The call and its answer, as in a program. */
  text(desk: Desk): string;
}

export const hueSlot = (hue: number, shade = shades - 1) => 1 + (hue % hues) * shades + shade;
/** The colours of the marks. */
export const found = hueSlot(8);
export const first = hueSlot(0);
export const fresh = 4;
export const gone = 0;
/** The number of frames for which a pair that began or ended flashes. */
export const flash = 40;

/** A number, rounded to one decimal. */
export const short = (value: number) => String(Math.round(value * 10) / 10);
export const list = (ids: readonly number[]) => `[${ids.slice(0, 24).join(', ')}${ids.length > 24 ? ', …' : ''}]`;
export const maskText = ({ mask }: Desk) => (mask === 7 ? '' : `{ mask: ${mask} }`);
export const join = (...parts: string[]) => parts.filter(Boolean).join(', ');

// The message of one zone to another at an exchange.
import { badValue, checkBox } from '../errors.ts';
import { isAttached, isTypedArray } from '../values.ts';
import { checkOther, type Zones } from './zones.ts';

/**
 * What changed for one zone among the boxes that another owned, as typed arrays to send as they are. The deltas of one
 * zone must arrive in order, and none may be lost.
 */
export interface Delta {
  /** The sender. */
  from: number;
  /** The receiver. */
  to: number;
  /** The boxes that changed. */
  ids: Uint32Array;
  /**
   * The change of each id: 0, it is new or has moved; 1, it comes into sight; 16, it is gone. After {@link Shard.resend},
   * one more at the end, 32: these are all boxes that the receiver must see of the sender, and it drops any other.
   */
  changes: Uint8Array;
  /** For each id its box, unless it is gone; followed by its box as of the previous update, if it comes into sight. */
  boxes: Float64Array;
}

/** The minima, then the maxima. */
export type Box = readonly number[];

/** How many boxes follow for one id: none if it is gone, else its box, and the previous one if it comes into sight. */
export type Told = readonly [id: number, ...boxes: Box[]];

/** Values of `changes`, by the number of boxes that follow. */
const changeOf = [16, 0, 1];

/** The further change at the end of a delta with all boxes. In `changes`, it takes part in any way of sending them. */
const all = 32;

export const pack = (from: number, to: number, told: readonly Told[], isAll = false): Delta => ({
  from,
  to,
  ids: Uint32Array.from(told, ([id]) => id),
  changes: Uint8Array.from([...told.map((each) => changeOf[each.length - 1]), ...(isAll ? [all] : [])]),
  boxes: Float64Array.from(told.flatMap(([, ...boxes]) => boxes.flat())),
});

/** A delta, read. */
export interface Message {
  from: number;
  told: Told[];
  /** Whether these are all boxes that the receiver must see of the sender. */
  isAll: boolean;
}

const kinds = [
  ['ids', 'Uint32Array'],
  ['changes', 'Uint8Array'],
  ['boxes', 'Float64Array'],
] as const;

/** Throws unless this is a delta for this zone, or its own state, since it may have come over a network. */
export function unpack(where: string, delta: Delta, zone: number, zones: Zones): Message {
  const isObject = typeof delta === 'object' && delta !== null;
  if (!isObject) badValue(where, delta, 'an object { from, to, ids, changes, boxes }', true);
  const { from, to, ids, changes, boxes } = delta;
  if (to !== zone) badValue(`${where}.to`, to, `${zone}, this zone`);
  if (where !== 'state') checkOther(`${where}.from`, from, zone, zones.count);
  else if (from !== zone) badValue('state.from', from, `${zone}, this zone`);
  for (const [name, kind] of kinds) {
    const isWhole = isTypedArray(delta[name], kind) && isAttached(delta[name]);
    if (!isWhole) badValue(`${where}.${name}`, delta[name], `a ${kind}, not detached`, true);
  }
  const isAll = changes.length === ids.length + 1 && changes.at(-1) === all;
  if (!isAll && changes.length !== ids.length) badValue(`${where}.changes.length`, changes.length, `${ids.length}`);
  const width = 2 * zones.dimensions;
  let at = 0;
  const told = Array.from(ids, (id, k): Told => {
    const count = changeOf.indexOf(changes[k]);
    if (count < 0) badValue(`${where}.changes[${k}]`, changes[k], '0, 1 or 16');
    const next = Array.from({ length: count }, () => Array.from({ length: width }, () => boxes[at++]));
    for (const box of next) checkBox(`${where}.boxes`, id, box, zones.dimensions);
    return [id, ...next];
  });
  if (at !== boxes.length) badValue(`${where}.boxes.length`, boxes.length, `${at}`);
  return { from, told, isAll };
}

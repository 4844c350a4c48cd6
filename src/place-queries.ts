// The queries about places: which boxes collide, and which are in a box, at a point, or in a circle.
import { area, copyIds, isNumber, known, number, point } from './answers.ts';
import { badQuery, checkDistance, checkId, checkOut, corners, isSize } from './errors.ts';
import { radiusAt } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { type BoxOptions, boxOptions, type IdsOptions, idsOptions, readOptions } from './query-options.ts';

export function isColliding(instance: KernelInstance, a: number, b: number): boolean {
  checkId('isColliding: a', a);
  checkId('isColliding: b', b);
  try {
    return known(instance, 'isColliding', instance.exports.is_pair(a, b)) === 1;
  } catch (error) {
    instance.recover(error, 'isColliding');
  }
}

export function collisionsOf(instance: KernelInstance, id: number, given?: number[]): number[] {
  checkId('collisionsOf', id);
  const out = checkOut('collisionsOf', given);
  try {
    return copyIds(instance, known(instance, 'collisionsOf', instance.exports.partners(id)), out);
  } catch (error) {
    instance.recover(error, 'collisionsOf');
  }
}

export function queryBox(
  instance: KernelInstance,
  a: number,
  b: number,
  c: number,
  d: number,
  e?: unknown,
  f?: unknown,
  options?: BoxOptions,
): number[] {
  const flat = instance.width === 4;
  const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d);
  if (flat) {
    if (!(good && a <= c && b <= d)) badQuery('queryBox', [a, b, c, d], corners[2], number);
    options = e as BoxOptions | undefined;
  } else if (!(good && isNumber(e) && isNumber(f) && a <= d && b <= e && c <= f)) {
    badQuery('queryBox', [a, b, c, d, e, f], corners[3], number);
  }
  const asked = readOptions(instance, 'queryBox', options, boxOptions);
  const io = instance.io();
  io[0] = a;
  io[1] = b;
  io[2] = c;
  io[3] = d;
  if (!flat) {
    io[4] = e as number;
    io[5] = f as number;
  }
  return area(instance, 'queryBox', asked);
}

export function queryPoint(
  instance: KernelInstance,
  x: number,
  y: number,
  z?: unknown,
  options?: IdsOptions,
): number[] {
  return area(instance, 'queryPoint', point(instance, 'queryPoint', idsOptions, x, y, z, options));
}

export function queryCircle(
  instance: KernelInstance,
  x: number,
  y: number,
  radius: number,
  options?: IdsOptions,
): number[] {
  if (instance.width !== 4) wrongShape('queryCircle', instance.dimensions, 'querySphere');
  return round(instance, 'queryCircle', x, y, options, undefined, radius);
}

export function querySphere(
  instance: KernelInstance,
  x: number,
  y: number,
  z: number,
  radius: number,
  options?: IdsOptions,
): number[] {
  if (instance.width !== 6) wrongShape('querySphere', instance.dimensions, 'queryCircle');
  return round(instance, 'querySphere', x, y, z, options, radius);
}

/** A circle or a sphere: the options follow the point. */
function round(
  instance: KernelInstance,
  where: string,
  x: number,
  y: number,
  z: unknown,
  options: IdsOptions | undefined,
  radius: number,
): number[] {
  const asked = point(instance, where, idsOptions, x, y, z, options);
  if (!isSize(radius)) checkDistance(`${where}: radius`, radius);
  instance.io()[radiusAt] = radius;
  return area(instance, where, asked);
}

function wrongShape(where: string, dimensions: number, right: string): never {
  throw new TypeError(`${where}: this space has ${dimensions} dimensions, expected a call of ${right}`);
}

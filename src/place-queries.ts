// The queries about places: which boxes collide, and which are in a box, at a point, or in a circle.
import { area, copyIds, isNumber, number, point } from './answers.ts';
import { badQuery, checkBoolean, checkDistance, checkId, checkOut, corners } from './errors.ts';
import { noCircle, radiusAt, within } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { type BoxOptions, boxOptions, type IdsOptions } from './query-options.ts';

export function isColliding(instance: KernelInstance, a: number, b: number): boolean {
  checkId('isColliding: a', a);
  checkId('isColliding: b', b);
  try {
    return instance.kernel.is_pair(a, b) === 1;
  } catch (error) {
    instance.recover(error, 'isColliding');
  }
}

export function collisionsOf(instance: KernelInstance, id: number, given?: number[]): number[] {
  checkId('collisionsOf', id);
  const out = checkOut('collisionsOf', given);
  try {
    return copyIds(instance, instance.kernel.partners(id), out);
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
  const io = instance.io();
  if (instance.width === 4) {
    const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && a <= c && b <= d;
    if (!good) badQuery('queryBox', [a, b, c, d], corners[2], number);
    options = e as BoxOptions | undefined;
  } else {
    const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && isNumber(e) && isNumber(f);
    if (!(good && a <= d && b <= e && c <= f)) {
      badQuery('queryBox', [a, b, c, d, e, f], corners[3], number);
    }
    io[4] = e;
    io[5] = f;
  }
  io[0] = a;
  io[1] = b;
  io[2] = c;
  io[3] = d;
  const wholly = options?.within === undefined ? false : options.within;
  checkBoolean('queryBox: within', wholly);
  io[radiusAt] = wholly ? within : noCircle;
  return area(instance, 'queryBox', options, boxOptions);
}

export function queryPoint(
  instance: KernelInstance,
  x: number,
  y: number,
  z?: unknown,
  options?: IdsOptions,
): number[] {
  options = point(instance, 'queryPoint', x, y, z, options);
  instance.io()[radiusAt] = noCircle;
  return area(instance, 'queryPoint', options);
}

export function queryCircle(
  instance: KernelInstance,
  x: number,
  y: number,
  radius: number,
  options?: IdsOptions,
): number[] {
  if (instance.width !== 4) wrongShape('queryCircle', instance.dimensions, 'querySphere');
  point(instance, 'queryCircle', x, y);
  instance.io()[radiusAt] = checkDistance('queryCircle: radius', radius);
  return area(instance, 'queryCircle', options);
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
  point(instance, 'querySphere', x, y, z);
  instance.io()[radiusAt] = checkDistance('querySphere: radius', radius);
  return area(instance, 'querySphere', options);
}

function wrongShape(where: string, dimensions: number, right: string): never {
  throw new TypeError(`${where}: this space has ${dimensions} dimensions, expected a call of ${right}`);
}

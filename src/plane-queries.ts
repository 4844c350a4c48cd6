// The query with planes: what a camera sees.
import { area } from './answers.ts';
import type { Numbers } from './dimensions.ts';
import { badValue, checkNumberArray } from './errors.ts';
import { planesAt } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { idsOptions, type PlanesOptions, readOptions } from './query-options.ts';

/** How many planes a query may have. */
const most = 8;
const names = ['nx, ny, d', 'nx, ny, nz, d'];

export function queryPlanes(instance: KernelInstance, planes: Numbers, options?: PlanesOptions): number[] {
  const where = 'queryPlanes';
  checkNumberArray(where, planes);
  const width = instance.dimensions + 1;
  const { length } = planes;
  if (length % width !== 0 || length > most * width) {
    badValue(`${where}: planes.length`, length, `${names[width - 3]} of at most ${most} planes`);
  }
  for (let k = 0; k < length; k++) {
    const value: unknown = planes[k];
    if (!Number.isFinite(value)) {
      badValue(`${where}: planes[${k}]`, value, 'a finite number', typeof value !== 'number');
    }
  }
  const asked = readOptions(instance, where, options, idsOptions);
  const io = instance.io();
  asked.distances = planes; // a mark, which any other query would replace
  instance.copyIn(where, io, planesAt, planes, length);
  if (asked.distances !== planes) throw new Error(`${where}: a getter of planes made a query`);
  return area(instance, where, asked, (length / width) | 0); // as an integer: a double would be garbage
}

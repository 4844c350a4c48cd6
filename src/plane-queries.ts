// The question about planes: what a camera sees.
import { planesAt } from './answers.ts';
import type { Dimensions } from './dimensions.ts';
import { badValue, checkNumberArray } from './errors.ts';
import { PlaceQueries } from './place-queries.ts';
import type { PlanesOptions } from './query-options.ts';

/** How many planes a question may have. */
const most = 8;
const names = ['nx, ny, d', 'nx, ny, nz, d'];

/** A space that says what is in view. */
export abstract class PlaneQueries<D extends Dimensions> extends PlaceQueries<D> {
  /**
   * The ids of the boxes that are not wholly behind any of up to eight planes, such as the six of a camera's view: in no
   * particular order. A plane is a normal n and an offset d; a point p is behind it where n · p + d, summed in doubles
   * along x, y and z in turn, is below 0. A box is behind it where all of it is; what touches it is not. The planes may
   * bound anything convex, or nothing: without planes all boxes are meant. A box near a corner of the view may be
   * outside of it and yet behind no single plane: it is among the answers.
   *
   * In a world that wraps around a box is in view where it stands in the world, its minimum from 0 on, or one world
   * further or back along any axes. It is an answer once, and inside where one of these copies is.
   *
   * @param planes 4 numbers for each plane, its normal, of any length, and its offset: `[nx, ny, nz, d, …]`; in 2D 3:
   *   `[nx, ny, d, …]`. All finite
   * @param options as for `queryBox`; `visit` is told which boxes are wholly inside, in front of all planes: what is in
   *   them need not be looked at again
   * @throws as all questions do: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).set(8, 4, 0, 0, 6, 1, 1).set(9, 8, 0, 0, 9, 1, 1).update();
   * const planes = [1, 0, 0, 0, -1, 0, 0, 5]; // x from 0 to 5
   * space.queryPlanes(planes).sort((a, b) => a - b); // → [7, 8]
   * const whole: number[] = [];
   * space.queryPlanes(planes, { visit: (id, inside) => inside && whole.push(id) });
   * whole; // → [7]
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1).set(8, 4, 4, 6, 6).update();
   * space.queryPlanes([-1, -1, 3]); // → [7]
   */
  queryPlanes(planes: Float32Array | Float64Array | readonly number[], options?: PlanesOptions): number[] {
    const where = 'queryPlanes';
    checkNumberArray(where, planes);
    const width = this.dimensions + 1;
    if (planes.length % width !== 0 || planes.length > most * width) {
      badValue(`${where}: planes.length`, planes.length, `${names[width - 3]} of at most ${most} planes`);
    }
    const io = this.io();
    for (let k = 0; k < planes.length; k++) {
      const value: unknown = planes[k];
      if (!Number.isFinite(value)) {
        badValue(`${where}: planes[${k}]`, value, 'a finite number', typeof value !== 'number');
      }
      io[planesAt + k] = planes[k]!;
    }
    return this.area(where, options, undefined, (planes.length / width) | 0); // as an integer: a double would be garbage
  }
}

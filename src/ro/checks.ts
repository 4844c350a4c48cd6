// What is refused in the same words in several places.

/** @throws RangeError unless the value is a finite number above 0, or from `least` on. */
export function checkFinite(what: string, value: number, least = Number.MIN_VALUE): void {
  if (Number.isFinite(value) && value >= least) return;
  throw new RangeError(`${what} is ${value}, expected a finite number${least ? ' above 0' : ', 0 or more'}`);
}

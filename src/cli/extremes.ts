// The least and the most of any number of values. `Math.max(...values)` fails for many: arguments are on the stack.

/** Infinity if there are none. */
export const leastOf = (values: readonly number[]): number => values.reduce((a, b) => Math.min(a, b), Infinity);

/** -Infinity if there are none. */
export const mostOf = (values: readonly number[]): number => values.reduce((a, b) => Math.max(a, b), -Infinity);

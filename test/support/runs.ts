// How many random cases a test tries, and from which seed. If CI is set, it is all of them, otherwise an eighth, for
// a faster `npm run check`. The seed differs each time, and is in the names of the tests. RUNS=… sets the number,
// SEED=… the seed.

export const seed = Number(process.env.SEED ?? Math.floor(Math.random() * 2 ** 31));

export const runs = (all: number): number => Number(process.env.RUNS ?? (process.env.CI ? all : Math.ceil(all / 8)));

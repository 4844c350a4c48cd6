// How many random cases a test tries, and from which seed. Where CI is set all of them, else an eighth, for a
// quicker `npm run check`; the seed is another each time and stands in what is printed.
// RUNS=… says how many, SEED=… which.

export const seed = Number(process.env.SEED ?? Math.floor(Math.random() * 2 ** 31));

export const runs = (all: number): number => Number(process.env.RUNS ?? (process.env.CI ? all : Math.ceil(all / 8)));

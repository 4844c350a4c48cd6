// A library that answers queries, as a contender: its results are pairs of a box and the number of a query.
import { asking, makeQueries } from '../harness/queries.mjs';

export async function create({ variant, row, scene, ...rest }) {
  const { create: createAsker } = await import(`../askers/${variant}.mjs`);
  const asker = await createAsker({ ...rest, still: row.still });
  return asking(asker, row, makeQueries(row, scene, row.seed), scene);
}

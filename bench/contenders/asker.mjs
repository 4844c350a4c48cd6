// Who answers questions, as a contender: what it finds are pairs of a box and the number of a question.
import { asking, makeQuestions } from '../harness/questions.mjs';

export async function create({ variant, row, scene, ...rest }) {
  const { create: createAsker } = await import(`../askers/${variant}.mjs`);
  const asker = await createAsker({ ...rest, still: row.still });
  return asking(asker, row, makeQuestions(row, scene, row.seed), scene);
}

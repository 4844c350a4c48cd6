// The exact answers as if they were a contender's. Never timed.
import { naive } from '../questions.mjs';

export const create = (scene) => ({ ...naive(scene), untimed: true });

// Our techniques as contenders of a race.
import { fileURLToPath } from 'node:url';

const module = fileURLToPath(new URL('./broadphase.mjs', import.meta.url));

export const techniques = (...names) => names.map((name) => ({ name, peer: 'broadphase', module, variant: name }));

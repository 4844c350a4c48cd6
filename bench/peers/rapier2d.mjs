// rapier2d: see kit/rapier.mjs.
import RAPIER from '@dimforge/rapier2d-compat';
import { rapier } from './kit/rapier.mjs';

export const npm = '@dimforge/rapier2d-compat';
export const dimensions = [2];

export const create = (scene) => rapier(RAPIER, scene);

// rapier3d: see kit/rapier.mjs.
import RAPIER from '@dimforge/rapier3d-compat';
import { rapier } from './kit/rapier.mjs';

export const npm = '@dimforge/rapier3d-compat';
export const dimensions = [3];

export const create = (scene) => rapier(RAPIER, scene);

// rapier3d: see kit/rapier-rays.mjs.
import RAPIER from '@dimforge/rapier3d-compat';
import { rapierRays } from './kit/rapier-rays.mjs';

export const npm = '@dimforge/rapier3d-compat';
export const dimensions = [3];
export const answers = ['rayCast'];

export const create = (scene) => rapierRays(RAPIER, scene);

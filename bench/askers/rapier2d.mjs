// rapier2d: see kit/rapier-rays.mjs.
import RAPIER from '@dimforge/rapier2d-compat';
import { rapierRays } from './kit/rapier-rays.mjs';

export const npm = '@dimforge/rapier2d-compat';
export const dimensions = [2];
export const answers = ['rayCast'];

export const create = (scene) => rapierRays(RAPIER, scene);

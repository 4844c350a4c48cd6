import type { Plugin } from 'vite';

export const everyTechnique: Plugin;

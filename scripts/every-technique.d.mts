import type { Plugin } from 'vite';

export function withKernel(name: string): Plugin;
export const everyTechnique: Plugin;

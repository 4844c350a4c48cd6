import type { Plugin } from 'vite';

export function bundle(entry: string, output: string, plugins?: Plugin[]): Promise<string>;

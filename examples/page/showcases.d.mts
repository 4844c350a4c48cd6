import type { Show } from './showcase.mjs';

export const showcases: Readonly<Record<string, () => Promise<Show>>>;

// How sharp canvases are.

/** More pixels than this for each CSS pixel take time, and hardly anybody sees them. */
const sharpest = 2;

/** How many pixels a canvas has for each CSS pixel: as many as the display, up to a limit. */
export const density = (): number => Math.min(sharpest, devicePixelRatio);

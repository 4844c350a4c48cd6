/**
 * Shows a space: its boxes, pairs, cells and rays, drawn on a canvas, or as line segments for any renderer. Made for
 * debugging: it costs time for every box, and makes some garbage.
 *
 * @module broadphase/draw
 */
export { type Colors, type DrawOptions, drawSpace } from './canvas.ts';
export { boxesInCells } from './cells.ts';
export { Lines } from './lines.ts';

// How a box looks, with either renderer: a small one is solid, a large one has an outline and a light inside. Lengths
// are in CSS pixels.

/** How much of what is behind it a solid box covers. */
export const solid = 0.92;
/** How much the inside of a large box covers. */
export const light = 0.3;
/** The outline begins to show at the first size of a box, and the inside is light from the second on. */
export const outlineFrom = 4;
export const lightFrom = 14;
export const outlineWidth = 1.25;
/** Boxes are cut off this many pixels outside the canvas: huge coordinates would be imprecise. Outlines do not show. */
export const overhang = 9;

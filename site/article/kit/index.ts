// The kit that the article's figures are built from.
//
// A figure is `<figure id="fig-N" data-figure="name">` in index.html, with its caption there, and a module
// `figures/name.ts` that exports `mount`. The page calls mount once, shortly before the figure comes into sight, with an
// empty <div class="live"> to build in. What mount returns, if anything, is called whenever the figure goes out of
// sight: stop what runs. It must be ready to run again. `--tall`, `--tall-tablet` and `--tall-phone` on the figure, in
// rem, reserve the height of the live part on screens 1280, 768 and 375 pixels wide: keep them true, or the page jumps.
//
// createView        a canvas to draw on; draw() gets a sheet of CSS pixels with the colours of the theme; describe() says
//                   it in words
// worldCanvas       a canvas for a `ro.World`
// runWhileAttended  start and stop by hover, focus, tap (hover does not start under reduced motion)
// makeDraggable, contains, confine   drag by mouse, finger and arrow keys, in world units
// button, choice, slider, counters, sayer, row   the controls; each is appended to the root it is given
// listing, excerpt, passage   real source (import it with `?raw`), with one line lit
// showArrays        the arrays that a grid consists of
// everyFrame        something that moves
// createStepper     Back, Step, Play and a slider over a recorded run
// fitWorld, gridOn, cellBox, boxOn, lookOf   world units to a view's pixels, and the grids and boxes drawn there
// dot, levelLine, text   what is drawn in pixels
// columns           two places side by side on a wide screen, one above the other on a phone
export { showArrays } from './arrays.ts';
export { runWhileAttended } from './attend.ts';
export { button, choice, counters, row, sayer, slider } from './controls.ts';
export { element } from './dom.ts';
export { confine, contains, makeDraggable } from './drag.ts';
export { boxOn, cellBox, dot, fitWorld, gridOn, levelLine, lookOf, text } from './drawing.ts';
export { everyFrame } from './frames.ts';
export { columns } from './layout.ts';
export { excerpt, listing, passage } from './listing.ts';
export { createStepper } from './stepper.ts';
export { type Colors, onThemeChange, themeColors } from './theme.ts';
export { createView, type Sheet, worldCanvas } from './view.ts';

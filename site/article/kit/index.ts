// The kit that the article's figures are built from.
//
// A figure is `<figure id="fig-N" data-figure="name">` in index.html, with its caption there, and a module
// `figures/name.ts` that exports `mount`. The page calls mount once, shortly before the figure comes into sight, with an
// empty <div class="live"> to build in. What mount returns, if anything, is called whenever the figure goes out of
// sight: stop what runs. It must be ready to run again. `--tall` and `--tall-phone` on the figure, in rem, reserve the
// height that the live part will have: keep them true, so that nothing on the page jumps.
//
// createView        a canvas to draw on in CSS pixels; draw() gets the colours of the theme; describe() says it in words
// worldCanvas       a canvas for a `ro.World`
// runWhileAttended  start and stop by hover, focus, tap (hover does not start under reduced motion)
// makeDraggable     drag by mouse, finger and arrow keys
// button, choice, slider, counters, sayer, row   the controls; each is appended to the root it is given
// listing, excerpt, passage   real source (import it with `?raw`), with one line lit
// createStepper     Back, Step, Play and a slider over a recorded run
// fitWorld, gridOn, boxOn, lookOf, text   world units to a view's pixels, and the grids and boxes drawn there
// columns           two places side by side on a wide screen, one above the other on a phone
export { type Attended, prefersStill, runWhileAttended } from './attend.ts';
export { button, type Counters, choice, counters, row, type Slider, sayer, slider } from './controls.ts';
export { element, uniqueId } from './dom.ts';
export { makeDraggable } from './drag.ts';
export { boxOn, type Fit, fitWorld, gridOn, lookOf, text } from './drawing.ts';
export { columns } from './layout.ts';
export { excerpt, type Listing, listing, passage } from './listing.ts';
export { createStepper, type Stepper } from './stepper.ts';
export { type Colors, onThemeChange, themeColors } from './theme.ts';
export { createView, type View, worldCanvas } from './view.ts';
/** What every figure module exports. */
export type Mount = (root: HTMLElement) => undefined | (() => void);

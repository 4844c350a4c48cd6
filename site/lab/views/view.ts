// A view that shows pictures: flat scenes on a canvas, solid ones in three dimensions, with one interface.
import { density } from '../../shared/density.ts';
import { makePalette, type Palette } from '../../shared/palette.ts';
import type { Picture } from '../worker/messages.ts';

export interface LabView {
  /** The element that is shown or hidden. */
  readonly element: HTMLElement;
  /** Shows all of another scene. */
  fit(world: readonly number[]): void;
  /** Shows a picture, which is kept until the next. */
  show(picture: Picture): void;
  zoom(factor: number): void;
  /** Where the view looks, as in the URL; undefined while everything is shown. */
  look: readonly number[] | undefined;
  /** Whether most cells of the picture are too small on the screen to be told apart. */
  readonly cellsTooSmall: boolean;
  /** What is at a place on the screen: a point or a ray in the world, and how near a click must be to a box. */
  place(clientX: number, clientY: number): { place: number[]; reach: number };
}

/** Calls `clicked` for a click or tap that was not a drag. */
export function onClick(element: HTMLElement, clicked: (x: number, y: number) => void): void {
  const still = 6;
  let from = { x: 0, y: 0 };
  element.addEventListener('pointerdown', (event) => {
    from = { x: event.clientX, y: event.clientY };
  });
  element.addEventListener('click', (event) => {
    if (Math.hypot(event.clientX - from.x, event.clientY - from.y) > still) return;
    clicked(event.clientX, event.clientY);
  });
}

/** Calls `resized` with the size of an element in device pixels now and whenever it changes. */
export function onSize(element: HTMLElement, resized: (width: number, height: number) => void): void {
  let was = '';
  const look = () => {
    const width = Math.max(1, Math.round(element.clientWidth * density()));
    const height = Math.max(1, Math.round(element.clientHeight * density()));
    if (was === `${width} ${height}`) return;
    was = `${width} ${height}`;
    resized(width, height);
  };
  new ResizeObserver(look).observe(element);
  look();
}

/** Calls `changed` with the colours of an element now and whenever the page turns light or dark. */
export function onPalette(element: HTMLElement, changed: (palette: Palette, style: CSSStyleDeclaration) => void): void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const look = () => {
    const style = getComputedStyle(element);
    changed(makePalette(dark.matches, style.getPropertyValue('--page').trim()), style);
  };
  dark.addEventListener('change', look);
  look();
}

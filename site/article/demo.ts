// What the demos have in common: their look, and places for the picture and for the source.
import { columns } from './kit/index.ts';
import './demos.css';

/** Makes two places: for the picture with its controls, and for the source. */
export function demoColumns(root: HTMLElement): [picture: HTMLElement, source: HTMLElement] {
  root.classList.add('demo');
  return columns(root);
}

// Where the parts of a figure go.
import { element } from './dom.ts';

/** Two places side by side where there is room, one above the other on a phone. */
export function columns(root: HTMLElement): [left: HTMLElement, right: HTMLElement] {
  const left = element('div');
  const right = element('div');
  root.append(element('div', { class: 'columns' }, left, right));
  return [left, right];
}

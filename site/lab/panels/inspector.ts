// The box that was clicked: its place, its partners, and the number of its cells; and the hottest cells.
import { formatCount } from '../../shared/format.ts';
import type { Chosen, HotCell, Picture } from '../worker/messages.ts';
import { partOf } from './parts.ts';

const digits = new Intl.NumberFormat('en', { maximumSignificantDigits: 6, useGrouping: false });

const many = (count: number, what: string) => `${formatCount(count)} ${what}${count === 1 ? '' : 's'}`;

/** Shows what a picture says about the chosen box; `choose` is called with another one, or none. */
export function createInspector(root: HTMLElement, choose: (id: number | undefined) => void) {
  let was = '';
  const link = (text: string, label: string, act: () => void) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'link';
    button.textContent = text;
    button.setAttribute('aria-label', label);
    button.addEventListener('click', act);
    return button;
  };
  const line = (...children: (Node | string)[]) => {
    const place = document.createElement('p');
    place.append(...children);
    return place;
  };
  const show = (part: string, chosen: Chosen | undefined, wanted: number | undefined, hottest: readonly HotCell[]) => {
    root.replaceChildren();
    root.hidden = wanted === undefined && hottest.length === 0;
    if (wanted !== undefined) {
      const title = document.createElement('h2');
      title.append(
        `Box ${wanted}`,
        link('Close', 'Close the box', () => choose(undefined)),
      );
      root.append(title);
      if (!chosen) root.append(line('It is not in this frame.'));
    }
    if (chosen) {
      const axes = chosen.box.length / 2;
      const sides = Array.from(
        { length: axes },
        (_, a) => `${digits.format(chosen.box[a])} to ${digits.format(chosen.box[a + axes])}`,
      );
      root.append(line(sides.map((side, a) => `${'xyz'[a]} ${side}`).join(', ')));
      root.append(
        line(
          `In ${many(chosen.cells, part)}, ${many(chosen.partnerCount, 'pair')}${chosen.partnerCount ? ' with' : ''}`,
        ),
      );
      const partners = line(...chosen.partners.map((id) => link(String(id), `Box ${id}`, () => choose(id))));
      partners.className = 'partners';
      if (chosen.partnerCount > chosen.partners.length) partners.append('…');
      root.append(partners);
    }
    if (hottest.length > 0) {
      root.append(line(`Hottest ${part}s: ${hottest.map(({ boxes }) => formatCount(boxes)).join(', ')} boxes`));
    }
  };
  return (picture: Picture, wanted: number | undefined): void => {
    // Rebuilt only if something has changed, so that links do not move under the finger.
    const { chosen, hottest } = picture;
    const part = partOf(picture.stats.technique);
    const now = JSON.stringify([part, wanted, chosen, hottest.map(({ boxes }) => boxes)]);
    if (now === was) return;
    was = now;
    if (root.contains(document.activeElement) && chosen) root.tabIndex = -1;
    show(part, chosen, wanted, hottest);
  };
}

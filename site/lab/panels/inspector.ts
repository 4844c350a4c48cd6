// The box that was clicked: its place, its partners, and the number of its cells; and the hottest cells.
import { formatCount } from '../../shared/format.ts';
import type { Chosen, HotCell, Picture } from '../worker/messages.ts';
import { partOf } from './parts.ts';

const digits = new Intl.NumberFormat('en', { maximumSignificantDigits: 6, useGrouping: false });

const many = (count: number, what: string) => `${formatCount(count)} ${what}${count === 1 ? '' : 's'}`;

function link(text: string, label: string, act: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'link';
  button.textContent = text;
  button.setAttribute('aria-label', label);
  button.addEventListener('click', act);
  return button;
}

function placeOf({ box }: Chosen): string {
  const axes = box.length / 2;
  const sides = Array.from({ length: axes }, (_, a) => `${digits.format(box[a])} to ${digits.format(box[a + axes])}`);
  return sides.map((side, a) => `${'xyz'[a]} ${side}`).join(', ');
}

/** Links to the partners. Each stays the same element while the box has that partner. */
function createPartners(choose: (id: number) => void) {
  const root = document.createElement('p');
  root.className = 'partners';
  const links = new Map<number, HTMLButtonElement>();
  const more = document.createTextNode('');
  root.append(more);
  const show = (partners: readonly number[], count: number) => {
    root.hidden = partners.length === 0;
    const now = new Set(partners);
    for (const [id, button] of links) {
      if (now.has(id)) continue;
      button.remove();
      links.delete(id);
    }
    let next = root.firstChild;
    for (const id of partners) {
      const button = links.get(id) ?? link(String(id), `Box ${id}`, () => choose(id));
      links.set(id, button);
      if (button === next) next = next.nextSibling;
      else root.insertBefore(button, next);
    }
    more.data = count > partners.length ? '…' : '';
  };
  return { root, show };
}

/** Shows what a picture says about the chosen box; `choose` is called with another one, or none. */
export function createInspector(root: HTMLElement, choose: (id: number | undefined) => void) {
  let was = '';
  let open = false;
  const title = document.createElement('h2');
  const name = document.createElement('span');
  title.append(
    name,
    link('Close', 'Close the box', () => choose(undefined)),
  );
  const [place, counts, heat] = ['', '', ''].map(() => document.createElement('p'));
  const partners = createPartners(choose);
  root.append(title, place, counts, partners.root, heat);
  root.tabIndex = -1;
  addEventListener('keydown', ({ key }) => {
    if (key === 'Escape' && open && root.checkVisibility()) choose(undefined);
  });

  const write = (line: HTMLElement, text: string) => {
    line.textContent = text;
    line.hidden = text === '';
  };
  const show = (part: string, chosen: Chosen | undefined, wanted: number | undefined, hottest: readonly HotCell[]) => {
    open = wanted !== undefined;
    title.hidden = !open;
    root.hidden = !open && hottest.length === 0;
    name.textContent = `Box ${wanted}`;
    write(place, chosen ? placeOf(chosen) : open ? 'It is not in this frame.' : '');
    const pairs = chosen && `${many(chosen.partnerCount, 'pair')}${chosen.partnerCount ? ' with' : ''}`;
    write(counts, chosen ? `In ${many(chosen.cells, part)}, ${pairs}` : '');
    partners.show(chosen?.partners ?? [], chosen?.partnerCount ?? 0);
    const boxes = hottest.map((cell) => formatCount(cell.boxes)).join(', ');
    write(heat, boxes && `Hottest ${part}s: ${boxes} boxes`);
  };
  return (picture: Picture, wanted: number | undefined): void => {
    const { chosen, hottest } = picture;
    const part = partOf(picture.stats.technique);
    const now = JSON.stringify([part, wanted, chosen, hottest.map(({ boxes }) => boxes)]);
    if (now === was) return;
    was = now;
    // Written in place, so that a button can be pressed and keeps the focus while the scene moves.
    const focused = root.contains(document.activeElement);
    show(part, chosen, wanted, hottest);
    // The partner that had it may be gone; the focus stays near.
    if (focused && !root.hidden && !root.contains(document.activeElement)) root.focus({ preventScroll: true });
  };
}

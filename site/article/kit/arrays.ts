// The arrays that a grid consists of, as code writes them: one line for each column.
import { element } from './dom.ts';

/**
 * Shows the arrays of a grid in place of those shown before.
 * @param columns what each cell of each column holds; undefined for a cell or a column that does not exist
 */
export function showArrays(
  place: HTMLElement,
  columns: readonly (readonly (string | undefined)[] | undefined)[],
): void {
  const lines = columns.flatMap((column, index) => {
    const cells = column?.map((held) => element('span', { class: held ? 'slot full' : 'slot' }, held ?? '·'));
    const shown = cells ?? [element('span', { class: 'nothing' }, 'empty')];
    return [element('code', {}, `grid[${index}]`), element('span', { class: 'array' }, ...shown)];
  });
  place.replaceChildren(...lines);
}

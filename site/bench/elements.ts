// Small pieces of the page, made by script.

/** The element with this id, which must exist. */
export const find = <E extends HTMLElement = HTMLElement>(id: string): E => document.querySelector<E>(`#${id}`)!;

export function make<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  properties: Partial<HTMLElementTagNameMap[Name]> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

/** Cells that are not numbers are words, aligned left. */
export function table(header: readonly string[], rows: readonly (readonly string[])[]): HTMLTableElement {
  const isWords = header.map((_, k) => rows.some((row) => row[k] !== '' && !/^[-+\d]/.test(row[k])));
  const line = (name: 'th' | 'td', cells: readonly string[]) =>
    make('tr', {}, ...cells.map((cell, k) => make(name, { className: isWords[k] ? 'words' : '' }, cell)));
  return make(
    'table',
    {},
    make('thead', {}, line('th', header)),
    make('tbody', {}, ...rows.map((row) => line('td', row))),
  );
}

/** A table that scrolls if it is too wide, by keyboard too. */
export const scrolling = (label: string, ...rest: Parameters<typeof table>): HTMLElement =>
  make('section', { className: 'scroll', tabIndex: 0, ariaLabel: label }, table(...rest));

/** Replaces the options of a menu and keeps the choice, if it still exists. */
export function fillMenu(
  menu: HTMLSelectElement,
  options: readonly (readonly [value: string, text: string])[],
  preferred: string,
): void {
  const before = menu.options.length > 0 ? menu.value : preferred; // the value may be empty, and chosen
  menu.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  const wanted = [before, preferred].find((value) => options.some(([each]) => each === value));
  menu.value = wanted ?? options[0]?.[0] ?? '';
}

/** Disables the options of a menu that lead nowhere, and says in each why. */
export function allow(menu: HTMLSelectElement, leads: (value: string) => boolean, why: string): void {
  for (const option of menu.options) {
    option.dataset.name ??= option.text;
    option.disabled = !leads(option.value);
    option.text = option.disabled ? `${option.dataset.name}: ${why}` : option.dataset.name;
  }
}

// Making elements, in one call each.

type Attributes = Readonly<Record<string, string | number | boolean>>;

/** An element with attributes and children. An attribute that is false is left out. */
export function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== false) made.setAttribute(key, value === true ? '' : String(value));
  }
  made.append(...children);
  return made;
}

/** An id that nothing else on the page has. */
export const uniqueId = (prefix: string): string => `${prefix}-${++ids}`;
let ids = 0;

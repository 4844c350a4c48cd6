// The address of the page, which holds the state of the lab. It is written a moment after a change: browsers limit how
// often that is allowed.
const delay = 300;

export class Address {
  readonly #query: () => string;
  #pending: ReturnType<typeof setTimeout> | undefined;

  /** @param query the query string of the present state */
  constructor(query: () => string) {
    this.#query = query;
  }

  writeSoon(): void {
    clearTimeout(this.#pending);
    this.#pending = setTimeout(() => this.write(), delay);
  }

  /** Writes at once, and returns the whole address. */
  write(): string {
    clearTimeout(this.#pending);
    history.replaceState(null, '', `?${this.#query()}`);
    return location.href;
  }
}

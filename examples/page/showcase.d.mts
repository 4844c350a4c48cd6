/** What a showcase returns: see showcase.mjs. */
export interface Demo {
  readonly contenders: Readonly<Record<string, string>>;
  use(key: string): void;
  race(key: string): number;
  step(): boolean;
  settle(): void;
  stop?(): void;
}

export type Show = (stage: HTMLElement, page: { wake(): void; say(text: string): void }) => Demo;

export function runShowcase(show: Show, stage: HTMLElement, controls: HTMLElement): Demo;

// The colours of the figures: the page's own CSS variables, read again when light turns to dark, or the page is
// printed, which is light.

const names = {
  page: '--page',
  surface: '--surface',
  line: '--line',
  text: '--text',
  muted: '--muted',
  accent: '--accent',
  onAccent: '--on-accent',
  /** A box that collides with nothing. */
  box: '--box',
  /** A box that collides. */
  hit: '--hit',
  /** A cell that has to be visited. */
  cell: '--cell',
  /** The lines of a grid. */
  grid: '--grid',
  /** What the current step is about. */
  now: '--now',
} as const;

export type Colors = Readonly<Record<keyof typeof names, string>>;

const dark = matchMedia('screen and (prefers-color-scheme: dark)');
let colors: Colors | undefined;

export function themeColors(): Colors {
  if (colors) return colors;
  const style = getComputedStyle(document.documentElement);
  const read = Object.entries(names).map(([key, variable]) => [key, style.getPropertyValue(variable).trim()]);
  colors = Object.fromEntries(read) as Colors;
  return colors;
}

/** `changed` draws at once: no frame comes before the page is printed. */
export function onThemeChange(changed: () => void): void {
  dark.addEventListener('change', () => {
    colors = undefined;
    changed();
  });
}

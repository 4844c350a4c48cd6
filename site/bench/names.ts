// Where the names of a chart's lines stand: beside the ends of their lines, those of lines that end together in one
// column, apart from each other and above the lines that go on. All in pixels, with y downwards from the top of the plot.

/** Of a line of text, and between its letters on average. */
export const lineHeight = 14;
const letter = 6.9;
/** From the end of a line to its name: with a leader, and without. */
const [far, near] = [30, 9];
/** A name that stands this close to its line's end needs no leader. */
const beside = 3;

export const textWidth = (text: string): number => letter * text.length;

export interface Line {
  name: string;
  /** From left to right. */
  points: readonly (readonly [x: number, y: number])[];
}

export interface Place {
  name: string;
  /** The left end and the middle of the text. */
  x: number;
  y: number;
  /** The end of the line. */
  end: readonly [x: number, y: number];
  leader: boolean;
}

/** The share of the width that names need on the right, if `share` of the plot's width is left of their line's end. */
export function roomFor(ends: readonly { name: string; share: number }[], width: number): number {
  return Math.max(
    0,
    ...ends.map(({ name, share }) => width - (width - far - textWidth(name)) / Math.max(share, Number.EPSILON)),
  );
}

/**
 * Places names, the column furthest right first.
 * @param named the names to place; the other lines are only avoided
 * @param bottom of the plot
 */
export function placeNames(lines: readonly Line[], named: ReadonlySet<string>, bottom: number): Place[] {
  const columns = new Map<number, Line[]>();
  for (const line of lines) {
    if (!named.has(line.name)) continue;
    const [x] = endOf(line);
    columns.set(x, [...(columns.get(x) ?? []), line]);
  }
  const placed: Place[] = [];
  for (const [x, column] of [...columns].sort(([a], [b]) => b - a)) {
    const passing = lines.filter((line) => endOf(line)[0] > x);
    const limit = (name: string) => {
      const right = x + far + textWidth(name);
      return Math.min(
        bottom,
        ...passing.map((line) => highest(line, x, right)),
        ...placed.filter((place) => place.x < right).map(({ y }) => y - lineHeight / 2),
      );
    };
    placed.push(...placeColumn(column, limit));
  }
  return placed;
}

const endOf = ({ points }: Line) => points[points.length - 1];

/** The least y of a line between two places. */
function highest({ points }: Line, from: number, to: number): number {
  let least = Number.POSITIVE_INFINITY;
  for (let k = 1; k < points.length; k++) {
    const [[x0, y0], [x1, y1]] = [points[k - 1], points[k]];
    if (x1 < from || x0 > to) continue;
    for (const x of [Math.max(from, x0), Math.min(to, x1)]) {
      least = Math.min(least, y0 + ((y1 - y0) * (x - x0)) / Math.max(x1 - x0, Number.EPSILON));
    }
  }
  return least;
}

/** One column of names, from the lowest to the highest, none lower than its limit. */
function placeColumn(column: readonly Line[], limit: (name: string) => number): Place[] {
  const sorted = [...column].sort((a, b) => endOf(b)[1] - endOf(a)[1]);
  let free = Number.POSITIVE_INFINITY;
  const at = apart(sorted.map((line) => endOf(line)[1])).map((y, k) => {
    const mine = Math.min(y, free, limit(sorted[k].name) - lineHeight / 2);
    free = mine - lineHeight;
    return mine;
  });
  const leader = sorted.some((line, k) => Math.abs(endOf(line)[1] - at[k]) > beside);
  return sorted.map((line, k) => {
    const end = endOf(line);
    return { name: line.name, x: end[0] + (leader ? far : near), y: at[k], end, leader };
  });
}

/** Moves places, which fall, as little as possible until all are a line of text apart: those that touch move together. */
function apart(wanted: readonly number[]): number[] {
  const groups: { sum: number; size: number }[] = [];
  wanted.forEach((y, k) => {
    let group = { sum: y + k * lineHeight, size: 1 };
    for (let last = groups.at(-1); last && last.sum / last.size < group.sum / group.size; last = groups.at(-1)) {
      group = { sum: group.sum + last.sum, size: group.size + last.size };
      groups.pop();
    }
    groups.push(group);
  });
  return groups
    .flatMap(({ sum, size }) => Array.from({ length: size }, () => sum / size))
    .map((y, k) => y - k * lineHeight);
}

/** Leaves out marks whose labels would touch: the ends of an axis stay, then powers of ten, then what still fits. */
export function thin(marks: readonly { value: number; label: string; x: number }[]): number[] {
  const rank = (k: number) =>
    k === marks.length - 1 || k === 0 ? 0 : Number.isInteger(Math.log10(marks[k].value)) ? 1 : 2;
  const kept: number[] = [];
  const order = marks.map((_, k) => k).sort((a, b) => rank(a) - rank(b) || b - a);
  for (const k of order) {
    const fits = kept.every((other) => {
      const room = (textWidth(marks[k].label) + textWidth(marks[other].label)) / 2 + letter;
      return Math.abs(marks[k].x - marks[other].x) >= room;
    });
    if (fits) kept.push(k);
  }
  return kept.sort((a, b) => a - b).map((k) => marks[k].value);
}

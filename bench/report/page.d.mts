export interface PageFigures {
  titles: string[];
  motions: string[][];
  goals: string[][];
}
export function figuresOf(record: { rows: readonly object[] }): PageFigures;

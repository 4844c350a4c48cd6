export function autoAgainstBest(row: object): { best: string; ratio: number; within: boolean } | undefined;

export interface Result {
  name: string;
  peer: string;
  figures?: { median: number };
}

export function autoAgainstBest(race: {
  results: Result[];
}): { best: string; slower: number; within: boolean } | undefined;

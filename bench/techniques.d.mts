export interface Result {
  name: string;
  peer: string;
  figures?: { median: number };
  atWork?: number;
}

export interface Duel {
  ms: number;
  rounds: number;
  against: { name: string; ms: number; ratio: number }[];
}

export function autoAgainstBest(race: {
  duel?: Duel;
  results: Result[];
}): { best: string; slower: number; within: boolean } | undefined;

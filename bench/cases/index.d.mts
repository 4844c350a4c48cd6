export interface Case {
  name: string;
  scene?: string;
  recording?: string;
  bestNativeMs?: number;
}
export function loadCases(traces?: string): Map<string, Case>;

import type { Case } from './cases.mjs';

export function figures(
  of: { full?: object; techniques?: object; coherence?: object },
  cases: Map<string, Case>,
): string;

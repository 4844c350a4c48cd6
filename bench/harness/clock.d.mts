export function clocked(work: () => void): number;

export function clocked(work: () => unknown): { wall: number; atWork: number };

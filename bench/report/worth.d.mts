export function adviceOf(row: object): string;

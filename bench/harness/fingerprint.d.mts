export const checkedFrames: number;
export function fingerprint(pairs: ArrayLike<number>): string;

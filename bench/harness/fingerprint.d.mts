export function fingerprint(pairs: ArrayLike<number>): string;
export function fingerprintOfBoxes(boxes: ArrayLike<number>): string;

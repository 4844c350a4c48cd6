// Replaces Node's 'buffer', which box-intersect's pool of arrays imports, though it never gets one.
export const Buffer = { isBuffer: () => false };

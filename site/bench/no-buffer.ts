// In place of Node's 'buffer', which box-intersect's pool of arrays asks for, though it is never given one.
export const Buffer = { isBuffer: () => false };

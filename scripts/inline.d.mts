export function inline(bytes: Uint8Array): { alphabet: string; order: string; text: string };

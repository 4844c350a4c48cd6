export function inline(wasm: Uint8Array): { alphabet: string; order: string; text: string; size: number };

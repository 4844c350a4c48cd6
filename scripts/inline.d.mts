export function inline(wasm: Uint8Array, owners?: number[]): { text: string; ends: number[] }[];

export const folders: string[];
export function expectedFiles(): Map<string, string>;

export function bundle(entry: string, output: string): Promise<string>;

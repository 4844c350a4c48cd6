export interface Addresses {
  version?: string;
  repository?: { url: string };
  homepage?: string;
  bugs?: { url: string };
}
export function placeholders(manifest: Addresses): string[];
export function readmeForNpm(text: string, manifest: Addresses, isFolder: (path: string) => boolean): string;

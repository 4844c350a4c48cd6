// Colyseus 0.18 needs Node 22 or later. Where this is an older one, the package `node` has a newer one.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const isNewer = Number(process.versions.node.split('.')[0]) >= 22;

/** A Node to run the example with, or why there is none. */
export function findNode() {
  if (!existsSync(path('node_modules/@colyseus/core'))) {
    return { missing: 'Colyseus is not installed: npm ci --prefix examples/world-colyseus' };
  }
  if (isNewer) return { node: process.execPath };
  const node = path('node_modules/node/bin/node');
  if (existsSync(node)) return { node };
  return {
    missing: `Colyseus 0.18 needs Node 22 or later, and this is ${process.version}; the package "node" brings one: npm ci --prefix examples/world-colyseus, and where scripts of packages are not run, npm rebuild node after it`,
  };
}

/** Goes on in a newer Node, if this one is too old. Ends the process where there is none. */
export async function needNewerNode() {
  const { node, missing } = findNode();
  if (missing) {
    console.error(missing);
    process.exit(1);
  }
  if (node === process.execPath) return;
  const child = spawn(node, process.argv.slice(1), { stdio: 'inherit' });
  for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => child.kill(signal));
  process.exit(await new Promise((resolve) => child.on('close', (code) => resolve(code ?? 1))));
}

// Colyseus 0.18 needs Node 22 or later. If this Node is older, the package `node` has a newer one.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';

const isNewer = Number(process.versions.node.split('.')[0]) >= 22;

/** A Node to run the example with, or why there is none. */
export function findNode() {
  if (isNewer) return { node: process.execPath };
  try {
    const program = process.platform === 'win32' ? 'node.exe' : 'node';
    return { node: createRequire(import.meta.url).resolve(`node/bin/${program}`) };
  } catch {
    return {
      missing: `Colyseus 0.18 needs Node 22 or later, and this is ${process.version}; the package "node" brings one: npm install, and where scripts of packages are not run, npm rebuild node after it`,
    };
  }
}

/** Continues in a newer Node if this one is too old. Ends the process if there is none. */
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

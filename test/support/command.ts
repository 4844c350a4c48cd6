// Runs the command `broadphase` in this process, and collects what it prints.
import type { Terminal } from '../../src/cli/arguments.ts';
import { main } from '../../src/cli/main.ts';

/** @param terminal what differs from a file of unlimited width */
export async function runCommand(argv: string[], terminal: Partial<Terminal> = {}) {
  let [out, err] = ['', ''];
  const code = await main(argv, {
    out: (text) => {
      out += text;
    },
    err: (text) => {
      err += text;
    },
    interactive: false,
    columns: 80,
    tableColumns: Infinity,
    colour: false,
    ...terminal,
  });
  return { code, out, err };
}

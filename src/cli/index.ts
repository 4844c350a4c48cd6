#!/usr/bin/env node
// The executable; also a thread of `broadphase join`.
import { isMainThread, workerData } from 'node:worker_threads';
import { serve, workerMark } from './join/worker.ts';
import { main } from './main.ts';

if (!isMainThread && workerData?.mark === workerMark) serve();
else await command();

async function command(): Promise<void> {
  // A reader that has seen enough, such as `head`, is no error.
  for (const stream of [process.stdout, process.stderr]) {
    stream.on('error', (error: NodeJS.ErrnoException) => {
      if (error.code === 'EPIPE') process.exit(0);
      throw error;
    });
  }

  process.exitCode = await main(process.argv.slice(2), {
    out: (text) => void process.stdout.write(text),
    err: (text) => void process.stderr.write(text),
    interactive: Boolean(process.stderr.isTTY) && process.env.TERM !== 'dumb',
    // A window may say 0; and what is piped is read in lines of 80.
    columns: process.stdout.columns || process.stderr.columns || 80,
    tableColumns: process.stdout.columns || Infinity,
    // NO_COLOR, FORCE_COLOR and TERM are heeded by Node.
    colour: Boolean(process.stdout.isTTY) && process.stdout.hasColors(),
  });
}

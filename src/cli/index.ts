#!/usr/bin/env node
// The executable; also a thread of `broadphase join`.
import { WriteStream } from 'node:tty';
import { isMainThread, workerData } from 'node:worker_threads';
import { exitCode } from './arguments.ts';
import { serve, workerMark } from './join/worker.ts';
import { main } from './main.ts';

if (!isMainThread && workerData?.mark === workerMark) serve();
else await command();

async function command(): Promise<void> {
  process.stdout.on('error', (error: NodeJS.ErrnoException) => {
    // A reader that closes the pipe early, such as `head`, is not an error.
    if (error.code === 'EPIPE') process.exit(0);
    const message = `broadphase: cannot write to standard output: ${error.message}\n`;
    process.stderr.write(message, () => process.exit(exitCode.files));
  });
  process.stderr.on('error', (error: NodeJS.ErrnoException) =>
    process.exit(error.code === 'EPIPE' ? 0 : exitCode.files),
  );

  process.exitCode = await main(process.argv.slice(2), {
    out: (text) => void process.stdout.write(text),
    err: (text) => void process.stderr.write(text),
    interactive: Boolean(process.stderr.isTTY) && process.env.TERM !== 'dumb',
    // A terminal may report 0 columns; piped output gets lines of 80.
    columns: process.stdout.columns || process.stderr.columns || 80,
    tableColumns: process.stdout.columns || Infinity,
    // Node respects NO_COLOR, FORCE_COLOR and TERM, but asks only terminals.
    colour: (process.stdout.isTTY || process.env.FORCE_COLOR !== undefined) && WriteStream.prototype.hasColors(),
  });
}

// Runs the browser tests in the Chromium of this machine. If there is none, says so; only in CI is that a failure.
import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { chromium } from './chromium.mjs';

if (chromium) {
  const playwright = fileURLToPath(import.meta.resolve('@playwright/test/cli'));
  const run = spawnSync(process.execPath, [playwright, 'test', ...process.argv.slice(2)], {
    stdio: 'inherit',
    env: { ...process.env, CHROMIUM: chromium },
  });
  if (run.error) throw run.error;
  process.exit(run.status ?? 1);
}

const required = Boolean(process.env.CI);
console[required ? 'error' : 'log'](
  'browser tests: skipped, no Chromium found. Install it (Debian: apt-get install chromium) or set CHROMIUM to its path.',
);
process.exit(required ? 1 : 0);

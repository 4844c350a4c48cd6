// Browser tests: the built site, what `npm start` serves, and the examples' pages, in the Chromium of this machine (CHROMIUM, or Debian's),
// with what it would send home turned off. Start them with `npm run test:browser`, which finds the browser.
import { defineConfig } from '@playwright/test';
import { builtPort, examplesPort, startPort } from './test/browser/ports.ts';

export default defineConfig({
  testDir: 'test/browser',
  outputDir: 'test-results',
  workers: 1,
  timeout: 60_000,
  retries: process.env.CI ? 1 : 0, // a busy machine may be late for a gesture; the report names what failed once
  forbidOnly: Boolean(process.env.CI),
  reporter: [['list']],
  use: {
    baseURL: `http://localhost:${builtPort}/`,
    video: 'off',
    trace: 'off',
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
      args: [
        '--headless=new',
        '--no-sandbox',
        '--disable-gpu',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
      ],
    },
  },
  webServer: [
    {
      command: `npx vite build site --logLevel warn && npx vite preview site --port ${builtPort} --strictPort`,
      url: `http://localhost:${builtPort}/`,
      timeout: 240_000,
    },
    {
      command: `npm start -- --port ${startPort} --strictPort`,
      url: `http://localhost:${startPort}/`,
      timeout: 240_000,
    },
    {
      command: `npx vite examples --port ${examplesPort} --strictPort`,
      url: `http://localhost:${examplesPort}/`,
      timeout: 240_000,
    },
  ],
});

// Browser tests: the built site, in the Chromium of this machine (CHROMIUM, or Debian's), with what it would send
// home turned off. Start them with `npm run test:browser`, which finds the browser.
import { defineConfig } from '@playwright/test';

const port = 41873;

export default defineConfig({
  testDir: 'test/browser',
  outputDir: 'test-results',
  workers: 1,
  timeout: 60_000,
  forbidOnly: Boolean(process.env.CI),
  reporter: [['list']],
  use: {
    baseURL: `http://localhost:${port}/`,
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
  webServer: {
    command: `npx vite build site --logLevel warn && npx vite preview site --port ${port} --strictPort`,
    url: `http://localhost:${port}/`,
    timeout: 240_000,
  },
});

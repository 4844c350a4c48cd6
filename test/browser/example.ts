// An example with a page, served by the command that its README names. Skipped where the packages of the examples are
// not installed.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { type Page, test } from '@playwright/test';
import { examplesPort } from './ports.ts';

export const examples = fileURLToPath(new URL('../../examples', import.meta.url));

/** Skips a test where the packages are missing; in CI they must be there. */
export function needExamples(): void {
  const installed = Boolean(process.env.CI) || existsSync(`${examples}/node_modules/phaser`);
  test.skip(!installed, 'npm ci --prefix examples brings what it needs');
}

/** Opens examples/<folder>; gives the list that errors and failed requests will be in. */
export async function openExample(page: Page, folder: string, search = ''): Promise<string[]> {
  needExamples();
  const faults: string[] = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('requestfailed', (request) => faults.push(`${request.failure()?.errorText} ${request.url()}`));
  page.on('response', (response) => response.status() >= 400 && faults.push(`${response.status()} ${response.url()}`));
  await page.goto(`http://localhost:${examplesPort}/${folder}/${search}`, { timeout: 90_000 });
  return faults;
}

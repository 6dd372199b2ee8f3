// SPDX-License-Identifier: Apache-2.0
// Pictures of a report beside references, which are grids of mean colours (references.json):
//   SKEIN_WRITE_REFERENCES=1 npx vitest run tests/browser/references   writes them anew; look at the
// pages first.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { fixture } from '../fixture';
import { gridDifference, gridOf, launch, MISSING, open, reportFile } from './page';

const FILE = join(__dirname, 'references.json');
const WRITES = process.env.SKEIN_WRITE_REFERENCES === '1';
const [COLUMNS, ROWS] = [16, 12];
/** Fonts and the smoothing of lines change a cell by less. */
const TOLERANCE = 6;
/** And by more in few cells; of charts, which are half letters, in more. */
const MOST_DIFFERENT = 0.05;
const MOST_DIFFERENT_OF_CHARTS = 0.15;

interface Case {
  name: string;
  view: string;
  element: string;
  theme: 'light' | 'dark';
  keys: string[];
  seek?: string;
}

const CASES: Case[] = [
  { name: 'overview', view: 'flights', element: '.pane', theme: 'light', keys: [], seek: '4' },
  { name: 'overview, dark', view: 'flights', element: '.pane', theme: 'dark', keys: [], seek: '4' },
  { name: 'followed with its ghost', view: 'flights', element: '.pane', theme: 'light', keys: ['2'],
    seek: '4' },
  { name: 'cockpit', view: 'flights', element: '.pane', theme: 'light', keys: ['4'], seek: '9' },
  { name: 'strip charts', view: 'flights', element: '.strips .charts', theme: 'light', keys: [],
    seek: '4' },
  { name: 'training', view: 'training', element: '.charts', theme: 'light', keys: [] },
];

describe.skipIf(MISSING !== '')('pictures of a report', () => {
  let browser: Browser;
  const taken: Record<string, string[]> = {};
  const known: Record<string, string[]> = existsSync(FILE)
    ? JSON.parse(readFileSync(FILE, 'utf8')) as Record<string, string[]> : {};

  beforeAll(async () => {
    browser = await launch();
    const address = reportFile(fixture('seed', 1));
    for (const { name, view, element, theme, keys, seek } of CASES) {
      const { page } = await open(browser, `${address}#${view}`, { colorScheme: theme });
      for (const key of keys) await page.keyboard.press(key);
      if (seek) await page.locator('.scrubber').fill(seek);
      await page.waitForTimeout(500);
      const shot = await page.locator(element).first().screenshot();
      taken[name] = await gridOf(page, shot, COLUMNS, ROWS);
      await page.close();
    }
    if (WRITES) writeFileSync(FILE, `${JSON.stringify(taken, null, 1)}\n`);
  }, 300000);
  afterAll(async () => browser?.close());

  it.skipIf(WRITES).each(CASES.map(({ name }) => name))('%s is as its reference', (name) => {
    const most = /charts|training/.test(name) ? MOST_DIFFERENT_OF_CHARTS : MOST_DIFFERENT;
    expect(gridDifference(taken[name], known[name], TOLERANCE)).toBeLessThan(most);
  });

  it('tells one from another', () => {
    for (const [a, b] of [['overview', 'overview, dark'], ['overview', 'followed with its ghost'],
      ['overview', 'cockpit']]) {
      expect(gridDifference(taken[a], taken[b], TOLERANCE)).toBeGreaterThan(MOST_DIFFERENT);
    }
  });
});

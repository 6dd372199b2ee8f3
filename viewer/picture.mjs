// SPDX-License-Identifier: Apache-2.0
// A picture of a report, made by Chromium:
//   node picture.mjs REPORT.html OUT.png [JSON]
// JSON: view, seek (s), keys (pressed in turn), choose (label: value of a select), theme, width,
// height, whole (of the page, not of the window).
import { resolve } from 'node:path';
import { launchChromium } from './chromium.mjs';

const [report, out, text = '{}'] = process.argv.slice(2);
const asked = {
  theme: 'light', width: 1200, height: 900, keys: [], choose: {}, whole: false, ...JSON.parse(text),
};
const browser = await launchChromium();
const page = await browser.newPage({
  viewport: { width: asked.width, height: asked.height }, colorScheme: asked.theme,
});
await page.goto(`file://${resolve(report)}${asked.view ? `#${asked.view}` : ''}`);
await page.waitForSelector('main > *');
for (const [label, value] of Object.entries(asked.choose)) {
  await page.locator('label', { hasText: label }).locator('select').selectOption(value);
}
for (const key of asked.keys) await page.keyboard.press(key);
if (asked.seek !== undefined) await page.locator('.scrubber').fill(String(asked.seek));
// No ring about what was last used.
await page.evaluate(() => document.activeElement?.blur());
await page.waitForTimeout(1500);
await page.screenshot({ path: out, fullPage: asked.whole });
await browser.close();

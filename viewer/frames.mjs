// SPDX-License-Identifier: Apache-2.0
// How long a report takes for a frame while all its flights play, in headless Chromium:
//   node frames.mjs REPORT.html [FRAMES] [WIDTHxHEIGHT]
// Once drawn, by software if there is no GPU; and once with the drawing calls left out: what then
// remains is the page's own work on the processor.
import { existsSync } from 'node:fs';
import { resolve } from 'node:path';
import { launchChromium } from './chromium.mjs';

const [report, frames = '300', size = '1280x900'] = process.argv.slice(2);
if (!report || !existsSync(report)) {
  console.error('frames.mjs: error: no such report: node frames.mjs REPORT.html [FRAMES] [SIZE]');
  process.exit(2);
}
const [width, height] = size.split('x').map(Number);
const browser = await launchChromium();

const session = await browser.newBrowserCDPSession();

/** Frames at the beginning, in which shaders are compiled. */
const WARM_UP = 20;

/** Runs in the page, before its own script: times what is done for each frame. */
function timeFrames(isDrawn) {
  const { requestAnimationFrame: request } = window;
  const times = { work: [], between: [], calls: 0, before: 0 };
  window.frameTimes = times;
  window.requestAnimationFrame = (act) => request((now) => {
    const begin = performance.now();
    act(now);
    times.work.push(performance.now() - begin);
    if (times.before) times.between.push(now - times.before);
    times.before = now;
  });
  for (const name of ['drawArrays', 'drawElements', 'drawElementsInstanced', 'drawArraysInstanced']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function counted(...args) {
      times.calls += 1;
      if (isDrawn) draw.apply(this, args);
    };
  }
}

function percentile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)].toFixed(1);
}

const shown = (values) =>
  `median ${percentile(values, 0.5)} ms, 95th percentile ${percentile(values, 0.95)} ms`;

/** Processor time so far, s: of the processes of pages, and of the one that draws. */
async function processTimes() {
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  const of = (kind) => processInfo.filter(({ type }) => type.toLowerCase() === kind)
    .reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  return { page: of('renderer'), drawing: of('gpu') };
}

async function measure(isDrawn) {
  const page = await browser.newPage({ viewport: { width, height } });
  page.setDefaultTimeout(600000);
  await page.addInitScript(timeFrames, isDrawn);
  await page.goto(`file://${resolve(report)}#flights`);
  await page.waitForSelector('.pane canvas', { timeout: 60000 });
  await page.locator('label', { hasText: 'episode' }).locator('select').selectOption('-1');
  // Slowly, so that it plays on to the last frame that is timed.
  await page.locator('.player select').selectOption('0.25');
  await page.locator('.scrubber').fill('8');
  await page.locator('button[aria-label^="play"]').click();
  const reach = async (count) => {
    let done = 0;
    while (done < count) {
      await page.waitForTimeout(300);
      done = await page.evaluate(() => window.frameTimes.work.length);
    }
    return { done, ...await processTimes() };
  };
  const begin = await reach(WARM_UP);
  const end = await reach(begin.done + Number(frames));
  const result = await page.evaluate(() => window.frameTimes);
  await page.close();
  return {
    between: result.between.slice(WARM_UP), work: result.work.slice(WARM_UP),
    page_ms: (1000 * (end.page - begin.page)) / (end.done - begin.done),
    drawing_ms: (1000 * (end.drawing - begin.drawing)) / (end.done - begin.done),
    calls: Math.round(result.calls / result.work.length),
  };
}

const alone = await measure(false);
console.log(`${frames} frames of ${size}, ${alone.calls} drawing calls each`);
console.log(`the page's own work:         ${shown(alone.work)}; `
  + `processor time ${alone.page_ms.toFixed(1)} ms`);
const drawn = await measure(true);
console.log(`drawn, from frame to frame:  ${shown(drawn.between)}; `
  + `processor time ${drawn.drawing_ms.toFixed(0)} ms more to draw`);
await browser.close();

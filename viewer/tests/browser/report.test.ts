// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from 'node:fs';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { fixture, HOSTILE } from '../fixture';
import { difference, drawnShare, launch, MISSING, open, reportFile } from './page';

const PANE = '.pane canvas';
const PLAY = '.player button:is([aria-label="play"], [aria-label="stop"])';
const PATIENCE = { timeout: 20000 };

describe.skipIf(MISSING !== '')('a report opened from disk', () => {
  let browser: Browser;
  let plain: string;
  beforeAll(async () => {
    browser = await launch();
    plain = reportFile(fixture('seed', 3));
  });
  afterAll(async () => browser?.close());

  const timeShown = async (page: Page) => parseFloat((await page.textContent('.time')) ?? '');
  /** Frames of a loaded machine take their time. */
  const showsTime = (page: Page, isRight: (time: number) => boolean) =>
    expect.poll(async () => isRight(await timeShown(page)), PATIENCE).toBe(true);

  it('draws every view, in both themes, without errors or requests', async () => {
    for (const colorScheme of ['light', 'dark'] as const) {
      const { page, errors, requests } = await open(browser, plain, { colorScheme });
      expect(await drawnShare(page, PANE)).toBeGreaterThan(0.02);
      for (const view of ['training', 'metrics', 'configuration']) {
        await page.click(`nav a[href="#${view}"]`);
        await page.waitForSelector(`main.${view} > *`);
        expect(await drawnShare(page, 'main')).toBeGreaterThan(0.01);
      }
      expect(errors).toEqual([]);
      expect(requests).toEqual([]);
      await page.close();
    }
  });

  it('plays, stops, and is scrubbed', async () => {
    const { page } = await open(browser, plain);
    const before = await page.locator(PANE).screenshot();
    await page.click(PLAY);
    await showsTime(page, (time) => time > 0.2);
    await page.click(PLAY);
    await page.waitForTimeout(300);
    const played = await timeShown(page);
    expect(await difference(page, before, await page.locator(PANE).screenshot()))
      .toBeGreaterThan(0.0005);
    await page.waitForTimeout(400);
    expect(await timeShown(page)).toBe(played);
    await page.locator('.scrubber').fill('5');
    await showsTime(page, (time) => time === 5);
    await page.locator('.strips .u-over').first().click();
    await showsTime(page, (time) => Math.abs(time - 6) < 0.5);
    await page.close();
  });

  it('shows the same time alike', async () => {
    const { page } = await open(browser, plain);
    const shot = async () => {
      await page.waitForTimeout(300);
      return page.locator(PANE).screenshot();
    };
    await page.locator('.scrubber').fill('4');
    const first = await shot();
    await page.locator('.scrubber').fill('9');
    const later = await shot();
    await page.locator('.scrubber').fill('4');
    expect(await difference(page, first, await shot())).toBeLessThan(0.001);
    expect(await difference(page, first, later)).toBeGreaterThan(0.001);
    await page.close();
  });

  it('is flown by keys', async () => {
    const { page, errors } = await open(browser, plain);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Shift+ArrowLeft');
    await showsTime(page, (time) => time === 1.9);
    const camera = page.locator('label', { hasText: 'camera' }).locator('select');
    for (const [key, name] of [['2', 'follow'], ['3', 'chase'], ['4', 'cockpit'], ['c', 'overview']]) {
      await page.keyboard.press(key);
      expect(await camera.inputValue()).toBe(name);
      await expect.poll(() => drawnShare(page, PANE), PATIENCE).toBeGreaterThan(0.005);
    }
    await page.keyboard.press('n');
    expect(await page.locator('label', { hasText: 'episode' }).locator('select').inputValue())
      .toBe('1');
    await page.keyboard.press('s');
    expect(await page.locator('.pane').count()).toBe(2);
    await page.locator(PANE).first().focus();
    await page.keyboard.press('End');
    await expect.poll(() => page.textContent('.hud'), PATIENCE).toContain('target reached');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('leaves Space to the button, box or summary that has the focus', async () => {
    const { page, errors } = await open(browser, plain);
    const isPlaying = async () => (await page.textContent(PLAY)) === '⏸';
    const box = page.locator('label', { hasText: 'side by side' }).locator('input');
    await box.focus();
    await page.keyboard.press('Space');
    expect(await box.isChecked()).toBe(true);
    expect(await page.locator('.pane').count()).toBe(2);
    for (const key of ['Space', 'Enter']) {
      await page.locator('.keys summary').focus();
      await page.keyboard.press(key);
      expect(await page.locator('.keys').getAttribute('open')).toBe(key === 'Space' ? '' : null);
      await page.locator(PANE).first().focus();
      await page.keyboard.press('End');
      await showsTime(page, (time) => time > 11);
      await page.locator('button[aria-label^="to the beginning"]').focus();
      await page.keyboard.press(key);
      await showsTime(page, (time) => time === 0);
    }
    await page.locator('nav a[href="#flights"]').focus();
    await page.keyboard.press('Space');
    await page.waitForTimeout(300);
    expect(await isPlaying()).toBe(false);
    // Nothing else does anything of its own.
    for (const element of ['.scrubber', '.pane canvas']) {
      await page.locator(element).first().focus();
      await page.keyboard.press('Space');
      await expect.poll(isPlaying, PATIENCE).toBe(true);
      await page.keyboard.press('Space');
      await expect.poll(isPlaying, PATIENCE).toBe(false);
    }
    expect(errors).toEqual([]);
    await page.close();
  });

  it('goes from target to target of a mission', async () => {
    const { page, errors } = await open(browser, plain);
    const reads = (text: string) =>
      expect.poll(() => page.textContent('.hud'), PATIENCE).toContain(text);
    expect(await page.textContent('.hud')).not.toContain('target 1');
    await page.keyboard.press('f');
    await reads('target 1 of 2 (0 reached)');
    await page.keyboard.press(']');
    await showsTime(page, (time) => time === 5);
    await reads('target 2 of 2');
    await page.locator(PANE).focus();
    await page.keyboard.press('End');
    await reads('target 2 of 2 (1 reached)');
    await page.keyboard.press('[');
    await showsTime(page, (time) => time === 5);
    await page.keyboard.press('[');
    await showsTime(page, (time) => time === 0);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('smooths the curves of a training by a slider', async () => {
    const { page, errors } = await open(browser, `${plain}#training`);
    const chart = page.locator('.chart', { hasText: 'success in training' });
    const slider = page.locator('label', { hasText: 'smoothing' }).locator('input');
    await slider.fill('0');
    const rough = await chart.screenshot();
    await slider.fill('100');
    expect(await difference(page, rough, await chart.screenshot())).toBeGreaterThan(0.0005);
    const hold = page.locator('.chart', { hasText: 'hold' });
    expect(await hold.count()).toBe(1);
    // Evaluations stay as they are.
    const smooth = await hold.screenshot();
    await slider.fill('0');
    expect(await difference(page, smooth, await hold.screenshot())).toBe(0);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('shows the same control steps in all charts of a training, enlarged too', async () => {
    const { page, errors } = await open(browser, `${plain}#training`);
    /** Where in each chart the one x lies that the pointer is at. */
    const places = () => page.evaluate(() => [...document.querySelectorAll('.chart')].map((chart) => {
      const line = chart.querySelector<HTMLElement>('.u-cursor-x') as HTMLElement;
      const { width } = (chart.querySelector('.u-over') as Element).getBoundingClientRect();
      return new DOMMatrix(line.style.transform).e / width;
    }));
    const box = async (k: number) => {
      const over = page.locator('.chart .u-over').nth(k);
      await over.scrollIntoViewIfNeeded();
      return await over.boundingBox() as { x: number; y: number; width: number; height: number };
    };
    const point = async (k: number, share: number) => {
      const { x, y, width, height } = await box(k);
      await page.mouse.move(x + share * width, y + height / 2);
    };
    /** The pointer's place is rounded to pixels. */
    const expectsAll = async (share: number) => expect.poll(async () =>
      Math.max(...(await places()).map((place) => Math.abs(place - share))), PATIENCE)
      .toBeLessThan(0.006);
    const steps = () => page.locator('.chart .u-legend .u-value').first().textContent();
    const holds = await page.locator('.chart').evaluateAll((charts) =>
      charts.findIndex((chart) => chart.textContent?.startsWith('hold')));
    await point(0, 0.5);
    await expectsAll(0.5);
    const middle = await steps();
    // Where the chart of the hold, which begins later, has nothing.
    await point(0, 0.02);
    await page.mouse.down();
    await point(0, 0.12);
    await page.mouse.up();
    await point(0, 0.8);
    await expectsAll(0.8);
    expect(await steps()).not.toBe(middle);
    // What is enlarged stays, whatever is drawn anew.
    const enlarged = await steps();
    await page.locator('label', { hasText: 'smoothing' }).locator('input').fill('60');
    await page.locator('label', { hasText: 'over seeds' }).locator('input').uncheck();
    await point(0, 0.8);
    await expectsAll(0.8);
    expect(await steps()).toBe(enlarged);
    const { x, y, width, height } = await box(holds);
    await page.mouse.dblclick(x + width / 3, y + height / 2);
    await point(0, 0.5);
    await expectsAll(0.5);
    expect(await steps()).toBe(middle);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('shows paired differences from the agent that is chosen', async () => {
    const { page, errors } = await open(browser, `${plain}#metrics`);
    const row = (name: string) => page.locator('table.metrics tr', { hasText: name })
      .locator('td').allTextContents();
    const bold = () => page.locator('td.better').allTextContents();
    expect(await row('success')).toEqual(['100.0 ± 6.0', '90.0 ± 6.0', '-10.0 ± 3.0', '95.0 ± 6.0',
      '-5.0 ± 3.0']);
    expect(await bold()).toEqual([]);
    expect(await page.textContent('main')).toContain('less that of seed in');
    await page.locator('label', { hasText: 'differences from' }).locator('select')
      .selectOption('1');
    expect(await row('success')).toEqual(['100.0 ± 6.0 better', '+10.0 ± 3.0', '90.0 ± 6.0',
      '95.0 ± 6.0 better', '+5.0 ± 3.0']);
    expect(await row('Mach')).toEqual(['0.8 ± 0.0', '-0.1 ± 0.0', '0.9 ± 0.0', '1.0 ± 0.0',
      '+0.1 ± 0.0']);
    expect(await bold()).toEqual(['100.0 ± 6.0', '95.0 ± 6.0', '15.0 ± 2.0', '19.0 ± 2.0']
      .map((value) => `${value} better`));
    // Which is said, and not seen.
    const said = await page.locator('td.better .unseen').first().boundingBox();
    expect(said?.width).toBe(1);
    expect(await page.textContent('main')).toContain('less that of autopilot:aggressive in');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('keeps the time in the charts that it shows a part of', async () => {
    const { page } = await open(browser, plain);
    await page.locator('label', { hasText: 'charts show' }).locator('select').selectOption('2');
    await page.locator('.scrubber').fill('7');
    await showsTime(page, (time) => time === 7);
    await page.locator('.strips .u-over').first().click();
    // In the middle of a chart of 2 s is the same time.
    await showsTime(page, (time) => Math.abs(time - 7) < 0.1);
    await page.close();
  });

  it('hands out what is in view as files', async () => {
    const { page, errors } = await open(browser, plain);
    const saved = async (face: string) => {
      const [file] = await Promise.all([page.waitForEvent('download'),
        page.locator('button', { hasText: face }).click()]);
      return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
    };
    const table = await saved('save data');
    expect(table.name).toBe('flights.csv');
    const lines = table.bytes.toString('utf8').split('\r\n');
    expect(lines[0].startsWith('agent,episode,time_s,north_ft')).toBe(true);
    expect(lines.length).toBe(2 * 600 + 2);
    const rewards = lines.slice(1, 4).map((line) =>
      line.split(',')[lines[0].split(',').indexOf('reward')]);
    expect(rewards).toEqual(['', '-2', '-2']);
    const picture = await saved('save picture');
    expect(picture.name).toBe('flights.png');
    expect(picture.bytes.subarray(1, 4).toString()).toBe('PNG');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('finds the worst flight, and goes to its moment', async () => {
    const { page, errors } = await open(browser, plain);
    await page.locator('.finder summary').click();
    const rows = page.locator('.finder tbody tr');
    await expect.poll(() => rows.count(), PATIENCE).toBe(6);
    await page.locator('.finder th button', { hasText: 'peak nz' }).click();
    expect(await page.locator('.finder th[aria-sort]').textContent()).toBe('peak nz, g');
    const peak = rows.nth(5).locator('button[aria-label^="peak nz"]');
    const said = await peak.getAttribute('aria-label') ?? '';
    expect(said).toBe('peak nz, g: 4.99 at 11.98 s');
    await peak.focus();
    await page.keyboard.press('Enter');
    await showsTime(page, (time) => time === 11.98);
    expect(await page.locator('label', { hasText: 'episode' }).locator('select').inputValue())
      .toBe('2');
    await expect.poll(() => page.textContent('.hud'), PATIENCE).toContain('autopilot:aggressive');
    expect(await page.textContent('.hud')).toContain('nz 5.0 g');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('hands out trainings and metrics as files', async () => {
    const { page, errors } = await open(browser, `${plain}#training`);
    const saved = async (face: string) => {
      const [file] = await Promise.all([page.waitForEvent('download'),
        page.locator('button', { hasText: face }).click()]);
      return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
    };
    const curves = await saved('save data');
    expect(curves.name).toBe('training.csv');
    expect(curves.bytes.toString('utf8').split('\r\n').length).toBe(2 * 60 + 2);
    const picture = await saved('save picture');
    expect(picture.name).toBe('training.png');
    expect(picture.bytes.subarray(1, 4).toString()).toBe('PNG');
    await page.click('nav a[href="#metrics"]');
    const metrics = await saved('save data');
    expect(metrics.name).toBe('metrics.csv');
    expect(metrics.bytes.toString('utf8')).toContain('"seed",success_rate,"success, %",100,94,106,100');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('charts of many flights are of all agents, and say that they are of the first episodes', async () => {
    const { page, errors } = await open(browser, reportFile(fixture('seed', 7)));
    const said = page.locator('.charted');
    expect(await said.isVisible()).toBe(false);
    await page.locator('label', { hasText: 'episode' }).locator('select').selectOption('-1');
    expect(await said.textContent()).toBe('charts: 12 of the 14 flights in view');
    // The last flights, which no chart holds, are longer.
    await page.locator('.scrubber').fill('19.9');
    await showsTime(page, (time) => time === 19.9);
    const [line, over] = await Promise.all(['.now', '.u-over'].map((part) =>
      page.locator(`.strips .chart ${part}`).first().boundingBox()));
    expect(line && over && line.x > over.x + over.width / 2).toBe(true);
    expect(line && over && line.x <= over.x + over.width).toBe(true);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('keeps what is shown in another theme', async () => {
    const { page, errors } = await open(browser, plain, { colorScheme: 'light' });
    const theme = page.locator('header button');
    const episode = page.locator('label', { hasText: 'episode' }).locator('select');
    const shot = async () => {
      await page.waitForTimeout(400);
      return page.locator(PANE).screenshot();
    };
    await episode.selectOption('1');
    await page.locator('.scrubber').fill('4');
    const home = await shot();
    const { x, y } = await page.locator(PANE).boundingBox() as { x: number; y: number };
    await page.mouse.move(x + 400, y + 300);
    await page.mouse.down();
    await page.mouse.move(x + 520, y + 340, { steps: 3 });
    await page.mouse.up();
    const turned = await shot();
    expect(await difference(page, home, turned)).toBeGreaterThan(0.005);
    await theme.click();
    expect(await difference(page, turned, await shot())).toBeGreaterThan(0.5);
    expect(await episode.inputValue()).toBe('1');
    expect(await timeShown(page)).toBe(4);
    // What the reader's system prefers is asked for where nothing else was chosen.
    await page.evaluate(() => { delete document.documentElement.dataset.theme; });
    await page.emulateMedia({ colorScheme: 'dark' });
    expect(await difference(page, turned, await shot())).toBeGreaterThan(0.5);
    await page.emulateMedia({ colorScheme: 'light' });
    expect(await difference(page, turned, await shot())).toBeLessThan(0.002);
    expect(await timeShown(page)).toBe(4);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('keeps the part and the lines of a training in another theme', async () => {
    const { page, errors } = await open(browser, `${plain}#training`, { colorScheme: 'light' });
    await page.locator('label', { hasText: 'over seeds' }).locator('input').uncheck();
    const chart = page.locator('.chart').first();
    const canvas = chart.locator('canvas');
    const over = await chart.locator('.u-over').boundingBox() as
      { x: number; y: number; width: number; height: number };
    const point = (share: number) =>
      page.mouse.move(over.x + share * over.width, over.y + over.height / 2);
    await chart.locator('.u-series th').nth(1).click();
    const line = chart.locator('.u-legend .u-series').nth(1);
    await point(0.2);
    await page.mouse.down();
    await point(0.4);
    await page.mouse.up();
    await page.mouse.move(0, 0);
    const enlarged = await canvas.screenshot();
    await page.locator('header button').click();
    expect(await difference(page, enlarged, await canvas.screenshot())).toBeGreaterThan(0.5);
    expect(await line.getAttribute('class')).toContain('u-off');
    await page.locator('header button').click();
    await page.mouse.move(0, 0);
    expect(await difference(page, enlarged, await canvas.screenshot())).toBeLessThan(0.002);
    await page.locator('button', { hasText: 'whole' }).click();
    expect(await difference(page, enlarged, await canvas.screenshot())).toBeGreaterThan(0.005);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('hides lines by the keyboard, and says so', async () => {
    const { page, errors } = await open(browser, `${plain}#training`);
    await page.locator('label', { hasText: 'over seeds' }).locator('input').uncheck();
    const chart = page.locator('.chart').first();
    const name = chart.getByRole('button', { name: 'seed-1' });
    expect(await name.getAttribute('aria-pressed')).toBe('true');
    for (const [key, pressed] of [['Enter', 'false'], ['Space', 'true']]) {
      await name.focus();
      await page.keyboard.press(key);
      expect(await name.getAttribute('aria-pressed')).toBe(pressed);
      expect(await chart.locator('.u-series.u-off').count()).toBe(pressed === 'true' ? 0 : 1);
    }
    expect(errors).toEqual([]);
    await page.close();
  });

  it('marks lines by their dashes, areas by their own colours', async () => {
    const { page } = await open(browser, reportFile(fixture('seed', 0, 0, [1, 2, 3, 4, 5])));
    await page.locator('label', { hasText: 'over seeds' }).locator('input').uncheck();
    const marksOf = (title: string) => page.locator('.chart', { hasText: title }).first()
      .locator('.u-legend .u-marker').evaluateAll((marks) => marks.slice(1).map((mark) => {
        const { borderTopStyle, borderTopColor, backgroundColor } = getComputedStyle(mark);
        return [borderTopStyle, borderTopColor, backgroundColor];
      }));
    const lines = await marksOf('return of an episode');
    expect(lines.map(([style]) => style)).toEqual(['solid', 'solid', 'solid', 'solid', 'dashed']);
    expect(lines[4][1]).toBe(lines[0][1]);
    const areas = await marksOf('how episodes end');
    expect(areas.map(([, edge]) => edge)).toEqual(areas.map(([, , ground]) => ground));
    expect(areas[0][1]).toBe('rgb(154, 154, 154)');
    await page.close();
  });

  it('leaves the keys that scroll to the page, but for windows and player', async () => {
    const { page } = await open(browser, plain, { viewport: { width: 1280, height: 500 } });
    await page.locator('.scrubber').fill('5');
    await showsTime(page, (time) => time === 5);
    await page.locator('nav a[href="#flights"]').focus();
    await page.keyboard.press('End');
    await expect.poll(() => page.evaluate(() => scrollY), PATIENCE).toBeGreaterThan(100);
    await page.waitForTimeout(300);
    expect(await timeShown(page)).toBe(5);
    const play = page.locator(PLAY);
    expect(await play.getAttribute('aria-label')).toBe('play');
    await play.focus();
    await page.keyboard.press('Home');
    await showsTime(page, (time) => time === 0);
    await page.keyboard.press('ArrowUp');
    expect(await page.locator('.player select').inputValue()).toBe('2');
    await page.keyboard.press('Enter');
    await expect.poll(() => play.getAttribute('aria-label'), PATIENCE).toBe('stop');
    await page.close();
  });

  it('is printed on white, without what is pressed', async () => {
    const { page } = await open(browser, plain, { colorScheme: 'dark' });
    await page.click('header button');
    await page.click('header button');
    expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('dark');
    await page.emulateMedia({ media: 'print', colorScheme: null });
    const colourOf = (name: string) => page.evaluate((property) =>
      getComputedStyle(document.body)[property as 'color'], name);
    expect(await colourOf('backgroundColor')).toBe('rgb(255, 255, 255)');
    expect(await colourOf('color')).toBe('rgb(0, 0, 0)');
    for (const pressed of ['nav', '.player', '.controls', 'header button']) {
      expect(await page.locator(pressed).first().isVisible()).toBe(false);
    }
    expect(await page.locator('.strips .chart').first().isVisible()).toBe(true);
    await page.close();
  });

  it('fits a phone of 360 px, and is touched', async () => {
    const { page, errors } = await open(browser, plain,
      { viewport: { width: 360, height: 740 }, hasTouch: true });
    for (const view of ['flights', 'training', 'metrics', 'configuration']) {
      await page.tap(`nav a[href="#${view}"]`);
      await page.waitForSelector(`main.${view} > *`);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
    }
    await page.tap('nav a[href="#flights"]');
    await page.tap(PLAY);
    await showsTime(page, (time) => time > 0.1);
    expect(await drawnShare(page, PANE)).toBeGreaterThan(0.02);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('takes nothing that a run contains for script', async () => {
    const { page, errors, requests } = await open(browser, reportFile(fixture(HOSTILE, 1)));
    for (const view of ['flights', 'training', 'metrics', 'configuration']) {
      await page.click(`nav a[href="#${view}"]`);
      await page.waitForSelector(`main.${view} > *`);
      expect(await page.textContent('body')).toContain('window.hacked=1');
    }
    expect(await page.evaluate(() => 'hacked' in window)).toBe(false);
    expect(await page.locator('img, script[src]').count()).toBe(0);
    expect(errors).toEqual([]);
    expect(requests).toEqual([]);
    await page.close();
  });

  it('runs no script but its own, whatever gets into the page', async () => {
    const { page } = await open(browser, plain);
    await page.evaluate(() => {
      const script = document.createElement('script');
      script.textContent = 'window.hacked = 1';
      document.body.append(script);
      const frame = document.createElement('div');
      frame.innerHTML = '<img src="data:," onerror="window.hacked = 1">';
      document.body.append(frame);
    });
    await page.waitForTimeout(200);
    expect(await page.evaluate(() => 'hacked' in window)).toBe(false);
    await page.close();
  });

  it('says what is wrong with data that is damaged', async () => {
    const damaged = await browser.newPage();
    await damaged.goto(reportFile(Buffer.from('no pack')));
    await damaged.waitForSelector('.error');
    expect(await damaged.textContent('.error')).toContain('cannot be shown');
    await damaged.close();
  });

  it('shows all but the space where the browser has no WebGL', async () => {
    const page = await browser.newPage();
    await page.addInitScript(() => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function get(this: HTMLCanvasElement, kind: string) {
        return kind.startsWith('webgl') ? null : getContext.call(this, kind as '2d');
      } as typeof getContext;
    });
    await page.goto(plain);
    await page.waitForSelector('.strips .u-over');
    expect(await page.textContent('.scale')).toContain('no WebGL');
    await page.click('nav a[href="#training"]');
    await page.waitForSelector('main.training > *');
    await page.close();
  });
});

// SPDX-License-Identifier: Apache-2.0
// A report whose data a server gives, as skein report --watch does.
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { fixture } from '../fixture';
import { launch, livePage, MISSING, open } from './page';

/** A few refreshes, of a loaded machine. */
const PATIENCE = { timeout: 30000 };

/** Gives the page and `data`; counts how often it has given these. */
class DataServer {
  served = 0;
  private server: Server | null = null;
  private port = 0;
  private failure = '';

  constructor(private data: Buffer) {}

  get address(): string {
    return `http://127.0.0.1:${this.port}/`;
  }

  give(data: Buffer): void {
    this.data = data;
    this.served = 0;
  }

  /** Answers that there are no data. */
  fail(reason: string): void {
    this.failure = reason;
  }

  /** On the port that it had, if it had one. */
  async start(): Promise<void> {
    this.server = createServer((request, response) => {
      response.setHeader('Connection', 'close');
      if (request.url === '/') {
        response.setHeader('Content-Type', 'text/html; charset=utf-8');
        response.end(livePage());
      } else if (this.failure) {
        response.statusCode = 503;
        response.end(this.failure);
      } else {
        response.end(this.data);
        this.served += 1;
      }
    });
    await new Promise<void>((resolve) => {
      this.server?.listen(this.port, '127.0.0.1', () => resolve());
    });
    this.port = (this.server?.address() as AddressInfo).port;
  }

  async stop(): Promise<void> {
    await new Promise((resolve) => { this.server?.close(resolve); });
  }

  /** Until the page has taken the data: it has asked for them again. */
  async isTaken(): Promise<void> {
    await expect.poll(() => this.served, PATIENCE).toBeGreaterThan(1);
  }
}

describe.skipIf(MISSING !== '')('a report that is watched', () => {
  let browser: Browser;
  let server: DataServer;
  beforeAll(async () => { browser = await launch(); });
  afterAll(async () => browser?.close());
  beforeEach(async () => {
    server = new DataServer(fixture('first', 1));
    await server.start();
  });
  afterEach(async () => server.stop());

  const timeShown = async (page: Page) => parseFloat((await page.textContent('.time')) ?? '');

  it('does not begin a flight again that is being looked at', async () => {
    const { page, errors } = await open(browser, server.address);
    await page.locator('.scrubber').fill('5');
    await expect.poll(() => timeShown(page), PATIENCE).toBe(5);
    server.give(fixture('second', 1));
    await server.isTaken();
    expect(await timeShown(page)).toBe(5);
    expect(await page.textContent('main')).not.toContain('second');
    // What is said of the data is always of the last ones.
    expect(await page.textContent('.notes')).toContain('second: a remark');
    expect(await page.textContent('h1')).toBe('second-1, second-2');
    expect(await page.title()).toBe('second-1, second-2 – Skein');
    // Who goes to another view and comes back sees what is fresh.
    await page.click('nav a[href="#configuration"]');
    await page.waitForSelector('main.configuration > *');
    expect(await page.textContent('main')).toContain('second-1');
    await page.click('nav a[href="#flights"]');
    await page.waitForSelector('main.flights > *');
    expect(await page.textContent('main')).toContain('second');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('renews the other views', async () => {
    const { page, errors } = await open(browser, `${server.address}#configuration`);
    expect(await page.textContent('main')).toContain('first-1');
    server.give(fixture('second', 1));
    await expect.poll(() => page.textContent('main'), PATIENCE).toContain('second-1');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('keeps what a reader of the curves has chosen', async () => {
    server.give(fixture('first', 0));
    const { page, errors } = await open(browser, `${server.address}#training`);
    const seeds = page.locator('label', { hasText: 'over seeds' }).locator('input');
    const slider = page.locator('label', { hasText: 'smoothing' }).locator('input');
    await seeds.uncheck();
    await slider.fill('60');
    const chart = page.locator('.chart').first();
    const over = chart.locator('.u-over');
    const { x, y, width, height } = await over.boundingBox() as
      { x: number; y: number; width: number; height: number };
    const point = (share: number) => page.mouse.move(x + share * width, y + height / 2);
    const values = () => chart.locator('.u-value').allTextContents();
    await point(0.5);
    await expect.poll(async () => (await values())[0], PATIENCE).toMatch(/ M$/);
    const [middle] = await values();
    // A part whose middle is not that of the whole.
    await point(0.25);
    await page.mouse.down();
    await point(0.5);
    await page.mouse.up();
    const lines = chart.locator('.u-legend .u-series');
    await lines.nth(1).locator('th').click();
    await point(0.5);
    await expect.poll(async () => (await values())[0], PATIENCE).toMatch(/ M$/);
    const [steps, , second] = await values();
    expect(steps).not.toBe(middle);
    server.give(fixture('first', 0, 7));
    // What is measured is new, where the pointer is still.
    await expect.poll(async () => (await values())[2], PATIENCE).not.toBe(second);
    expect((await values())[0]).toBe(steps);
    expect(await lines.nth(1).getAttribute('class')).toContain('u-off');
    expect(await slider.inputValue()).toBe('60');
    expect(await seeds.isChecked()).toBe(false);
    expect(errors).toEqual([]);
    await page.close();
  });

  it('offers the mean over seeds once there is more than one', async () => {
    server.give(fixture('first', 0, 0, [1]));
    const { page, errors } = await open(browser, `${server.address}#training`);
    const seeds = page.locator('label', { hasText: 'over seeds' });
    const legend = () => page.locator('.chart').first().locator('.u-legend').textContent();
    expect(await seeds.isVisible()).toBe(false);
    expect(await legend()).not.toContain('mean of');
    server.give(fixture('first', 0));
    await expect.poll(() => seeds.isVisible(), PATIENCE).toBe(true);
    expect(await seeds.locator('input').isChecked()).toBe(true);
    expect(await legend()).toContain('mean of first-1, first-2');
    await seeds.locator('input').uncheck();
    expect(await legend()).not.toContain('mean of');
    expect(errors).toEqual([]);
    await page.close();
  });

  it('keeps the whole of a configuration', async () => {
    const { page } = await open(browser, `${server.address}#configuration`);
    const whole = page.locator('label', { hasText: 'all settings' }).locator('input');
    await whole.check();
    server.give(fixture('second', 1));
    await expect.poll(() => page.textContent('main'), PATIENCE).toContain('second-1');
    expect(await whole.isChecked()).toBe(true);
    expect(await page.textContent('main')).toContain('env.task');
    await page.close();
  });

  it('stays where it is when flights come that were not there', async () => {
    server.give(fixture('first', 0));
    const { page } = await open(browser, server.address);
    expect(await page.locator('main.training').count()).toBe(1);
    server.give(fixture('second', 1));
    await server.isTaken();
    expect(await page.locator('nav a[href="#flights"]').count()).toBe(1);
    expect(await page.locator('main.training').count()).toBe(1);
    await page.close();
  });

  it('says what is the matter with data that cannot be shown', async () => {
    const { page } = await open(browser, server.address);
    server.give(Buffer.from('no data'));
    const status = () => page.textContent('.status');
    await expect.poll(status, PATIENCE).toMatch(/^cannot be shown: ./);
    server.give(fixture('first', 1));
    await expect.poll(status, PATIENCE).toBe('');
    await page.close();
  });

  it('says since when the server does not answer, and why, until it does', async () => {
    const { page } = await open(browser, server.address);
    const status = () => page.textContent('.status');
    expect(await status()).toBe('');
    await server.stop();
    await expect.poll(status, PATIENCE).toMatch(/^no answer since [0-2]\d:[0-5]\d: .*fetch/);
    expect(await page.locator('.status').isVisible()).toBe(true);
    server.fail('runs/a: gone');
    await server.start();
    await expect.poll(status, PATIENCE).toMatch(/^no answer since [0-2]\d:[0-5]\d: runs\/a: gone$/);
    server.fail('');
    await expect.poll(status, PATIENCE).toBe('');
    expect(await page.locator('.status').isVisible()).toBe(false);
    await page.close();
  });
});

// SPDX-License-Identifier: Apache-2.0
// A report in headless Chromium, drawn by software, from disk.
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { type Browser, chromium, type Page } from 'playwright-core';

const CHROMIUM = [process.env.SKEIN_CHROMIUM, '/usr/bin/chromium', '/usr/bin/google-chrome']
  .find((path) => path && existsSync(path));
const TEMPLATE = process.env.SKEIN_REPORT_TEMPLATE ?? join(__dirname, '../../dist/report.html');

/** Why pages cannot be tested here; empty if they can. */
export const MISSING = !CHROMIUM ? 'no Chromium' : !existsSync(TEMPLATE) ? `no ${TEMPLATE}` : '';

export async function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: CHROMIUM,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--disable-accelerated-2d-canvas', '--disable-gpu-rasterization'],
  });
}

/** Writes a report with this data; returns its address. */
export function reportFile(deflated: Buffer): string {
  const path = join(mkdtempSync(join(tmpdir(), 'skein-')), 'report.html');
  const page = readFileSync(TEMPLATE, 'utf8');
  writeFileSync(path, page.replace('SKEIN-REPORT-DATA', () => deflated.toString('base64')));
  return `file://${path}`;
}

/** The page as a server that gives its data sends it (src/report/report_page.h of Skein). */
export function livePage(): string {
  return readFileSync(TEMPLATE, 'utf8').replace('SKEIN-REPORT-DATA', '')
    .replace("connect-src 'none'", "connect-src 'self'");
}

export interface Opened {
  page: Page;
  /** What the console said that is an error, and every request that left the page. */
  errors: string[];
  requests: string[];
}

export async function open(
  browser: Browser, address: string, options: Parameters<Browser['newPage']>[0] = {},
): Promise<Opened> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  const opened: Opened = { page, errors: [], requests: [] };
  page.on('console', (message) => {
    if (message.type() === 'error') opened.errors.push(message.text());
  });
  page.on('pageerror', (error) => opened.errors.push(String(error)));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) opened.requests.push(request.url());
  });
  await page.goto(address);
  await page.waitForSelector('main > *');
  return opened;
}

/** The pixels of screenshots, decoded by the browser. */
async function pixelsOf(page: Page, shots: Buffer[]): Promise<Uint8Array[]> {
  const decoded = await page.evaluate((images) => Promise.all(images.map(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const pen = canvas.getContext('2d') as OffscreenCanvasRenderingContext2D;
    pen.drawImage(image, 0, 0);
    const { data: bytes } = pen.getImageData(0, 0, image.width, image.height);
    let text = '';
    for (let i = 0; i < bytes.length; i += 8192) {
      text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    }
    return btoa(text);
  })), shots.map((shot) => shot.toString('base64')));
  return decoded.map((text) => Uint8Array.from(Buffer.from(text, 'base64')));
}

/** The share of pixels of a screenshot of `selector` that differ from its most frequent colour. */
export async function drawnShare(page: Page, selector: string): Promise<number> {
  const [bytes] = await pixelsOf(page, [await page.locator(selector).first().screenshot()]);
  const pixels = new Uint32Array(bytes.buffer);
  const counts = new Map<number, number>();
  for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
  return 1 - Math.max(...counts.values()) / pixels.length;
}

/** The share of pixels in which two screenshots differ by more than a tolerance. */
export async function difference(page: Page, a: Buffer, b: Buffer): Promise<number> {
  const [first, second] = await pixelsOf(page, [a, b]);
  if (first.length !== second.length) return 1;
  let different = 0;
  for (let i = 0; i < first.length; i += 4) {
    const gap = Math.max(...[0, 1, 2].map((k) => Math.abs(first[i + k] - second[i + k])));
    if (gap > 24) different += 1;
  }
  return different / (first.length / 4);
}

/** The mean colours of a screenshot's cells, `columns` by `rows`, as "rrggbb": what of it does not
 * depend on how a version of the browser smooths lines and letters. */
export async function gridOf(
  page: Page, shot: Buffer, columns: number, rows: number,
): Promise<string[]> {
  const [bytes] = await pixelsOf(page, [shot]);
  // Of a PNG's header.
  const [width, height] = [shot.readUInt32BE(16), shot.readUInt32BE(20)];
  const sums = new Float64Array(4 * columns * rows);
  for (let y = 0; y < height; y += 1) {
    const row = Math.floor((y * rows) / height);
    for (let x = 0; x < width; x += 1) {
      const cell = 4 * (row * columns + Math.floor((x * columns) / width));
      const pixel = 4 * (y * width + x);
      for (let k = 0; k < 3; k += 1) sums[cell + k] += bytes[pixel + k];
      sums[cell + 3] += 1;
    }
  }
  return Array.from({ length: rows }, (_, row) => Array.from({ length: columns }, (__, column) => {
    const cell = 4 * (row * columns + column);
    return [0, 1, 2].map((k) => Math.round(sums[cell + k] / sums[cell + 3]).toString(16)
      .padStart(2, '0')).join('');
  }).join(' '));
}

/** The share of cells of two grids that differ by more than a tolerance, 0 to 255. */
export function gridDifference(a: string[], b: string[], tolerance: number): number {
  const partsOf = (grid: string[]) => grid.flatMap((row) => row.split(' ')).map((cell) =>
    [0, 2, 4].map((k) => parseInt(cell.slice(k, k + 2), 16)));
  const [first, second] = [partsOf(a), partsOf(b)];
  if (first.length !== second.length) return 1;
  const different = first.filter((cell, i) =>
    cell.some((part, k) => Math.abs(part - second[i][k]) > tolerance));
  return different.length / first.length;
}

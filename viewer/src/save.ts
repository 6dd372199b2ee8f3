// SPDX-License-Identifier: Apache-2.0
// Files that a reader takes from the page: tables as CSV, pictures as PNG.
import { el } from './dom';
import { styleColour } from './palette';

/** Hands a file to the browser's downloads. */
function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  el('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** Hands a table, the text of a CSV, to the browser's downloads under this name. */
export function saveTable(name: string, csv: string): void {
  download(name, new Blob([csv], { type: 'text/csv' }));
}

/** Hands a canvas as it is now to the downloads, as PNG; nothing if it has no width or height. */
export function savePicture(name: string, canvas: HTMLCanvasElement): void {
  canvas.toBlob((blob) => {
    if (blob) download(name, blob);
  });
}

/** A cell of a number: of so many digits, a whole one of all; blank where there is none. */
export function cellOf(value: number | null | undefined, digits = 6): number | string {
  if (value == null || !Number.isFinite(value)) return '';
  return Number.isInteger(value) ? value : Number(value.toPrecision(digits));
}

/** Text that may hold commas or quotes, quoted (RFC 4180). */
export function quoted(text: string): string {
  return `"${text.replace(/"/g, '""')}"`;
}

/** Rows of cells as CSV. */
export function csvOf(rows: (number | string)[][]): string {
  return rows.map((row) => `${row.join(',')}\r\n`).join('');
}

export interface Key {
  name: string;
  colour: string;
  dash: number[];
}

export interface Picture {
  title: string;
  canvas: HTMLCanvasElement;
  /** Whose its lines are, by their colours and dashes. */
  keys?: Key[];
}

const GAP = 12;
const LINE = 18;
const COLUMNS = 3;
const SWATCH = 22;

/** Pictures of one size beside one another, in as many rows as it takes; lengths in pixels. */
interface Block {
  pictures: Picture[];
  columns: number;
  width: number;
  height: number;
  head: number;
}

function blockOf(pictures: Picture[], columns: number, width: number, line: number): Block {
  const height = Math.max(0, ...pictures.map(({ canvas }) =>
    (width * canvas.height) / Math.max(canvas.width, 1)));
  const hasKeys = pictures.some(({ keys }) => keys && keys.length > 0);
  return { pictures, columns, width, height, head: line * (hasKeys ? 2 : 1) };
}

function heightOf({ pictures, columns, height, head }: Block, gap: number): number {
  return Math.ceil(pictures.length / columns) * (height + head + gap);
}

/** A picture's title, and below it its keys as far as there is room. */
function drawHead(
  pen: CanvasRenderingContext2D, { title, keys }: Picture, left: number, top: number, width: number,
): void {
  const scale = devicePixelRatio;
  pen.font = `600 ${13 * scale}px system-ui, sans-serif`;
  pen.fillStyle = styleColour('--text');
  pen.fillText(title, left, top + 12 * scale, width);
  pen.font = `${11 * scale}px system-ui, sans-serif`;
  const [swatch, base] = [SWATCH * scale, top + (LINE + 12) * scale];
  let x = left;
  for (const { name, colour, dash } of keys ?? []) {
    const needed = swatch + pen.measureText(name).width + 12 * scale;
    if (x > left && x + needed > left + width) break;
    pen.strokeStyle = colour;
    pen.lineWidth = 3 * scale;
    pen.setLineDash(dash.map((length) => length * scale));
    pen.beginPath();
    pen.moveTo(x, base - 3.5 * scale);
    pen.lineTo(x + swatch - 4 * scale, base - 3.5 * scale);
    pen.stroke();
    pen.fillStyle = styleColour('--text');
    pen.fillText(name, x + swatch, base, left + width - x - swatch);
    x += needed;
  }
}

/** The windows beside one another, the charts below, with their titles. */
export function montage(windows: Picture[], charts: Picture[]): HTMLCanvasElement {
  const scale = devicePixelRatio;
  const [gap, line] = [GAP * scale, LINE * scale];
  const chartWidth = charts[0]?.canvas.width ?? 400 * scale;
  const width = COLUMNS * (chartWidth + gap) + gap;
  const beside = Math.max(windows.length, 1);
  const blocks = [blockOf(windows, beside, (width - gap) / beside - gap, line),
    blockOf(charts, COLUMNS, chartWidth, line)];
  const height = gap + blocks.reduce((sum, block) => sum + heightOf(block, gap), 0);
  const page = el('canvas', { width, height: Math.round(height) });
  const pen = page.getContext('2d') as CanvasRenderingContext2D;
  pen.fillStyle = styleColour('--ground');
  pen.fillRect(0, 0, page.width, page.height);
  let top = gap;
  for (const block of blocks) {
    block.pictures.forEach((picture, i) => {
      const left = gap + (i % block.columns) * (block.width + gap);
      const at = top + Math.floor(i / block.columns) * (block.height + block.head + gap);
      const { canvas } = picture;
      drawHead(pen, picture, left, at, block.width);
      pen.drawImage(canvas, left, at + block.head, block.width,
        (block.width * canvas.height) / Math.max(canvas.width, 1));
    });
    top += heightOf(block, gap);
  }
  return page;
}

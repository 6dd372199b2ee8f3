// SPDX-License-Identifier: Apache-2.0
// What is in view as files: flights as a table, the view and its charts as one picture.
import { el } from '../dom';
import { styleColour } from '../palette';
import { type FlightRecord, rounded } from './record';

/** Hands a file to the browser's downloads. */
export function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  el('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** A cell; blank where there is no number. */
function cellOf(value: number): number | string {
  return Number.isFinite(value) ? Number(value.toPrecision(6)) : '';
}

/** Every row of some flights as CSV: agent, episode, time_s, then the columns of any of them. Cells
 * with commas or quotes are quoted (RFC 4180). */
export function csvOf(records: FlightRecord[], agents: string[]): string {
  const names = [...new Set(records.flatMap((record) => record.names))];
  const lines = [['agent', 'episode', 'time_s', ...names].join(',')];
  for (const record of records) {
    const quoted = `"${agents[record.agent].replace(/"/g, '""')}"`;
    const columns = names.map((name) => (record.has(name) ? record.column(name) : null));
    for (let row = 0; row < record.rows; row += 1) {
      const cells = columns.map((column) => (column ? cellOf(column[row]) : ''));
      lines.push([quoted, record.episode, rounded(record.timeOf(row)), ...cells].join(','));
    }
  }
  return `${lines.join('\r\n')}\r\n`;
}

interface Picture {
  title: string;
  canvas: HTMLCanvasElement;
}

const GAP = 12;
const TITLE_HEIGHT = 18;
const COLUMNS = 3;

/** The windows beside one another, the charts below, with their titles. */
export function montage(windows: Picture[], charts: Picture[]): HTMLCanvasElement {
  const scale = devicePixelRatio;
  const [gap, title] = [GAP * scale, TITLE_HEIGHT * scale];
  const chartWidth = charts[0]?.canvas.width ?? 400 * scale;
  const chartHeight = charts[0]?.canvas.height ?? 0;
  const width = COLUMNS * (chartWidth + gap) + gap;
  const windowWidth = (width - gap) / Math.max(windows.length, 1) - gap;
  const windowHeight = Math.max(0, ...windows.map(({ canvas }) =>
    (windowWidth * canvas.height) / Math.max(canvas.width, 1)));
  const top = windowHeight + title + 2 * gap;
  const rows = Math.ceil(charts.length / COLUMNS);
  const page = el('canvas', { width, height: Math.round(top + rows * (chartHeight + title + gap)) });
  const pen = page.getContext('2d') as CanvasRenderingContext2D;
  pen.fillStyle = styleColour('--ground');
  pen.fillRect(0, 0, page.width, page.height);
  pen.fillStyle = styleColour('--text');
  pen.font = `600 ${13 * scale}px system-ui, sans-serif`;
  windows.forEach(({ title: text, canvas }, i) => {
    const left = gap + i * (windowWidth + gap);
    pen.fillText(text, left, gap + 12 * scale, windowWidth);
    pen.drawImage(canvas, left, gap + title, windowWidth,
      (windowWidth * canvas.height) / Math.max(canvas.width, 1));
  });
  charts.forEach(({ title: text, canvas }, i) => {
    const left = gap + (i % COLUMNS) * (chartWidth + gap);
    const at = top + Math.floor(i / COLUMNS) * (chartHeight + title + gap);
    pen.fillText(text, left, at + 12 * scale, chartWidth);
    pen.drawImage(canvas, left, at + title);
  });
  return page;
}

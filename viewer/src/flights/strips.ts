// SPDX-License-Identifier: Apache-2.0
// Strip charts over the time of the flights in view.
import uPlot from 'uplot';
import { axis, Chart, formatted, tickText } from '../chart';
import { choice, el, tick } from '../dom';
import { colourOf, dashOf, faded, styleColour } from '../palette';
import type { Picture } from '../save';
import type { FlightRecord } from './record';
import { dataOf, isCommand, isWrapped, reading, type Strip, titleOf, wrapsOf } from './strip_list';

/** How much of the time the charts show, s. */
const SPANS: [string, string][] = [['Infinity', 'whole'], ['20', '20 s'], ['5', '5 s'], ['2', '2 s']];
const MOST_READOUTS = 4;

/** Half of what is left out around a wrap: a chart of minutes has many rows in a pixel. */
const WRAP_PIXELS = 1.5;

/** No line goes across the chart where an angle goes on from 180 to -180 degrees. */
function gapsOfWraps(
  plot: uPlot, line: number, from: number, to: number, gaps: uPlot.Series.Gaps,
): uPlot.Series.Gaps {
  const xOf = (row: number) => plot.valToPos(plot.data[0][row], 'x', true);
  const wraps = wrapsOf(plot.data[line], from, to)
    .map((row): [number, number] => [xOf(row) - WRAP_PIXELS, xOf(row + 1) + WRAP_PIXELS]);
  return [...gaps, ...wraps].sort(([a], [b]) => a - b);
}

function seriesOf(records: FlightRecord[], strip: Strip, agents: string[]): uPlot.Series[] {
  return records.flatMap((record) => strip.columns.map((column, k) => ({
    label: k === 0 ? agents[record.agent] : titleOf(column),
    stroke: k === 0 ? colourOf(record.agent) : faded(colourOf(record.agent), 0.75),
    width: 1.4, dash: k === 0 ? dashOf(record.agent) : [5, 4], points: { show: false },
    paths: isCommand(column) ? uPlot.paths.stepped?.({ align: -1 }) : undefined,
    ...(isWrapped(column) ? { gaps: gapsOfWraps } : {}),
    scale: k > 0 && strip.secondAxis ? 'second' : 'y',
    value: (_: uPlot, v: number | null) => formatted(v),
  })));
}

/** Shades what lies within the tolerance, under the curves. */
function shadeTolerance(plot: uPlot, tolerance: number): void {
  const { ctx, bbox } = plot;
  const top = Math.max(plot.valToPos(tolerance, 'y', true), bbox.top);
  const bottom = Math.min(plot.valToPos(-tolerance, 'y', true), bbox.top + bbox.height);
  if (bottom <= top) return;
  ctx.save();
  ctx.fillStyle = styleColour('--band');
  ctx.fillRect(bbox.left, top, bbox.width, bottom - top);
  ctx.restore();
}

/** A dotted line across. */
function drawMark(plot: uPlot, time: number, colour: string): void {
  const { ctx, bbox } = plot;
  const x = Math.round(plot.valToPos(time, 'x', true));
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  ctx.save();
  ctx.strokeStyle = colour;
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([2, 3]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

interface Drawn {
  chart: Chart;
  strip: Strip;
  /** A line over the chart at the time shown: moved, so that nothing is drawn for it. */
  line: HTMLElement;
  /** Beside the title, what the first records are worth then. */
  values: { record: FlightRecord; place: HTMLElement }[];
}

export class Strips {
  readonly element = el('section', { class: 'strips', 'aria-label': 'strip charts' });
  private readonly charts: Drawn[] = [];
  private readonly grid = el('div', { class: 'charts' });
  private now = 0;
  /** The time that the pointer is at. */
  private pointed: number | null = null;
  private span = Infinity;
  private end = 0;
  private records: FlightRecord[] = [];

  constructor(
    private readonly strips: Strip[], private readonly agents: string[],
    private readonly seek: (time: number) => void,
  ) {
    const ticks = strips.map((strip) => tick(
      strip.title.replace(', and dashed ', ' | ').replace(' (right)', ''), strip.isOn, (isOn) => {
        strip.isOn = isOn;
        this.draw(this.records, this.end);
      }));
    const span = choice('charts show', SPANS, 'Infinity', (value) => {
      this.span = Number(value);
      this.mark(this.now);
    });
    this.element.append(el('div', { class: 'controls' }, span,
      el('details', { class: 'picker' }, el('summary', {}, 'which charts'), ...ticks)), this.grid);
  }

  /** Charts of these records, from 0 to `end`, s, which is that of all flights in view. */
  draw(records: FlightRecord[], end: number): void {
    this.records = records;
    this.end = end;
    this.stop();
    this.grid.replaceChildren();
    for (const strip of this.strips) {
      const own = records.filter((record) => record.has(strip.columns[0]));
      if (!strip.isOn || own.length === 0) continue;
      const chart = this.chart(strip, own);
      const line = el('div', { class: 'now' });
      chart.plot.over.append(line);
      const values = own.slice(0, MOST_READOUTS).map((record) => {
        const place = el('span');
        place.style.color = colourOf(record.agent);
        return { record, place };
      });
      chart.readout.append(...values.map(({ place }) => place));
      this.charts.push({ chart, strip, line, values });
    }
    this.mark(this.now);
  }

  private chart(strip: Strip, records: FlightRecord[]): Chart {
    const secondsOf = (time: number) => `${tickText(time)} s`;
    const inSeconds: uPlot.Axis.DynamicValues = (_, times) => times.map(secondsOf);
    const axes = [axis({ size: 26, space: 50, values: inSeconds }), axis({ size: 46 })];
    if (strip.secondAxis) {
      axes.push(axis({ scale: 'second', side: 1, size: 40, grid: { show: false } }));
    }
    const chart = new Chart(this.grid, {
      title: strip.title, height: 130, group: 'strips', legend: false, axes, drag: false,
      nameX: 'time', formatX: (x) => `${x.toFixed(1)} s`, tickX: secondsOf,
      series: seriesOf(records, strip, this.agents),
      hooks: {
        drawClear: [(plot) => {
          if (strip.tolerance !== undefined) shadeTolerance(plot, strip.tolerance);
        }],
        draw: [(plot) => this.drawMarks(plot, records)],
        setCursor: [(plot) => this.point(plot)],
        setSize: [() => this.mark(this.now)],
      },
    }, dataOf(records, strip));
    this.scrubs(chart);
    return chart;
  }

  /** When targets were reached. */
  private drawMarks(plot: uPlot, records: FlightRecord[]): void {
    for (const record of records) {
      for (const time of record.reached) {
        drawMark(plot, time, faded(colourOf(record.agent), 0.5));
      }
    }
  }

  /** Values at the pointer, if there is one over a chart. */
  private point(plot: uPlot): void {
    const { left } = plot.cursor;
    const pointed = left === undefined || left < 0 ? null : plot.posToVal(left, 'x');
    if (pointed === this.pointed) return;
    this.pointed = pointed;
    this.readOut();
  }

  /** A press on a chart, and what it is dragged along, is a time. */
  private scrubs(chart: Chart): void {
    const { over } = chart.plot;
    over.classList.add('scrubs');
    const go = (event: PointerEvent) => {
      if (event.buttons === 0) return;
      const { left } = over.getBoundingClientRect();
      this.seek(chart.plot.posToVal(event.clientX - left, 'x'));
    };
    over.addEventListener('pointerdown', (event) => {
      over.setPointerCapture(event.pointerId);
      go(event);
    });
    over.addEventListener('pointermove', go);
  }

  /** Marks the time; where the charts show a part of it they go along. */
  mark(time: number): void {
    this.now = time;
    const span = Math.min(this.span, this.end);
    const from = Math.min(Math.max(time - span / 2, 0), this.end - span);
    for (const { chart, line } of this.charts) {
      const { min, max } = chart.plot.scales.x;
      if (span > 0 && (min !== from || max !== from + span)) {
        chart.plot.setScale('x', { min: from, max: from + span });
      }
      const share = span > 0 ? (time - from) / span : 0;
      line.style.transform = `translateX(${(share * chart.plot.bbox.width) / devicePixelRatio}px)`;
    }
    this.readOut();
  }

  private readOut(): void {
    const time = this.pointed ?? this.now;
    for (const { strip, values } of this.charts) {
      for (const { record, place } of values) {
        place.textContent = ` ${strip.columns.filter((column) => record.has(column))
          .map((column) => reading(column, record.value(column, time))).join(' ┆ ')}`;
      }
    }
  }

  /** The charts' pictures, with their titles. */
  pictures(): Picture[] {
    return this.charts.map(({ chart, strip }) => {
      const { keys, ...picture } = chart.picture();
      // Of each flight its solid line; the title says what is dashed.
      return { ...picture, keys: keys?.filter((_, i) => i % strip.columns.length === 0) };
    });
  }

  stop(): void {
    this.charts.splice(0).forEach(({ chart }) => chart.stop());
  }
}

// SPDX-License-Identifier: Apache-2.0
// Strip charts of what an engineer reads, over the time of the flights in view.
import type uPlot from 'uplot';
import { axis, Chart, formatted } from '../chart';
import { el, tick } from '../dom';
import { colourOf, faded, styleColour } from '../palette';
import type { FlightSet } from '../report';
import type { FlightRecord } from './record';

export interface Strip {
  title: string;
  /** Columns in one chart: the first solid, the second dashed, on an axis of its own if of another
   * unit. */
  columns: string[];
  isOn: boolean;
  tolerance?: number;
  secondAxis?: boolean;
}

const UNITS: [RegExp, string][] = [
  [/_deg_s$/, 'deg/s'], [/_deg$/, 'deg'], [/_fps$/, 'ft/s'], [/_ft$/, 'ft'], [/_g$/, 'g'],
];

/** "true_airspeed_fps" is "true airspeed, ft/s". */
export function titleOf(column: string): string {
  const found = UNITS.find(([pattern]) => pattern.test(column));
  const name = column.replace(found ? found[0] : /$^/, '').replace(/_/g, ' ');
  return found ? `${name}, ${found[1]}` : name;
}

/** The charts that a set of flights has. */
export function stripsOf(set: FlightSet, record: FlightRecord): Strip[] {
  const errors = set.targets.map((target) => ({
    title: titleOf(`error_${target.column}`), columns: [`error_${target.column}`], isOn: true,
    tolerance: target.tolerance,
  }));
  const one = (column: string, isOn: boolean): Strip =>
    ({ title: titleOf(column), columns: [column], isOn });
  const pair = (command: string, surface: string, isOn: boolean): Strip => ({
    title: `${titleOf(command)}, and dashed ${titleOf(surface)}`, columns: [command, surface],
    isOn, secondAxis: true,
  });
  return [
    ...errors,
    { title: 'normal load factor, g', columns: ['load_factor_g'], isOn: true },
    one('alpha_deg', true), one('beta_deg', true), one('roll_deg', true),
    pair('action_pitch', 'elevator_deg', true), pair('action_roll', 'aileron_deg', true),
    pair('action_yaw', 'rudder_deg', false), pair('action_throttle', 'power', true),
    one('p_deg_s', true), one('q_deg_s', false), one('r_deg_s', false),
    one('pitch_deg', false), one('yaw_deg', false), one('true_airspeed_fps', true),
    one('mach', false), one('altitude_ft', true), one('lateral_load_factor_g', false),
    one('leading_edge_flap_deg', false), one('reward', false),
    ...['action_target_pitch', 'action_target_yaw', 'action_target_speed'].map((c) => one(c, false)),
  ].filter((strip) => strip.columns.every((column) => record.has(column)));
}

function seriesOf(records: FlightRecord[], strip: Strip, agents: string[]): uPlot.Series[] {
  return records.flatMap((record) => strip.columns.map((column, k) => ({
    label: k === 0 ? agents[record.agent] : titleOf(column),
    stroke: k === 0 ? colourOf(record.agent) : faded(colourOf(record.agent), 0.75),
    width: 1.4, dash: k === 0 ? undefined : [5, 4], points: { show: false },
    scale: k > 0 && strip.secondAxis ? 'second' : 'y',
    value: (_: uPlot, v: number | null) => formatted(v),
  })));
}

/** The columns over one time axis, that of the longest flight. */
function dataOf(records: FlightRecord[], strip: Strip): uPlot.AlignedData {
  const longest = records.reduce((a, b) => (a.duration > b.duration ? a : b));
  const xs = Array.from({ length: longest.rows }, (_, i) => i * longest.interval);
  const lines = records.flatMap((record) => strip.columns.map((column) => {
    // A command of the row at time 0 is not there: what follows stands for it.
    const first = column.startsWith('action_') || column === 'reward' ? record.interval : 0;
    return xs.map((x) => (x > record.duration ? null : record.value(column, Math.max(x, first))));
  }));
  return [xs, ...lines];
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

function drawNow(plot: uPlot, time: number): void {
  const { ctx, bbox } = plot;
  const x = Math.round(plot.valToPos(time, 'x', true));
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  ctx.save();
  ctx.strokeStyle = styleColour('--text');
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

export class Strips {
  readonly element = el('section', { class: 'strips', 'aria-label': 'strip charts' });
  private readonly charts: { chart: Chart; strip: Strip }[] = [];
  private readonly grid = el('div', { class: 'charts' });
  private now = 0;
  private drawn = -1;

  constructor(
    private readonly strips: Strip[], private readonly agents: string[],
    private readonly seek: (time: number) => void,
  ) {
    const ticks = strips.map((strip) => tick(strip.title.replace(/, and dashed.*/, ' | surface'),
      strip.isOn, (isOn) => {
        strip.isOn = isOn;
        this.draw(this.records);
      }));
    this.element.append(
      el('details', { class: 'picker' }, el('summary', {}, 'charts'), ...ticks), this.grid);
  }

  private records: FlightRecord[] = [];

  draw(records: FlightRecord[]): void {
    this.records = records;
    this.stop();
    this.grid.replaceChildren();
    for (const strip of this.strips) {
      if (strip.isOn) this.charts.push({ chart: this.chart(strip, records), strip });
    }
  }

  private chart(strip: Strip, records: FlightRecord[]): Chart {
    const axes = [axis({ size: 26, space: 50 }), axis({ size: 46 })];
    if (strip.secondAxis) {
      axes.push(axis({ scale: 'second', side: 1, size: 40, grid: { show: false } }));
    }
    const chart = new Chart(this.grid, {
      title: strip.title, height: 130, group: 'strips', legend: false, axes, drag: false,
      nameX: 'time', formatX: (x) => `${x.toFixed(1)} s`, series: seriesOf(records, strip, this.agents),
      hooks: {
        drawClear: [(plot) => {
          if (strip.tolerance !== undefined) shadeTolerance(plot, strip.tolerance);
        }],
        draw: [(plot) => drawNow(plot, this.now)],
      },
    }, dataOf(records, strip));
    this.scrubs(chart);
    return chart;
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

  /** Marks the time, ten times a second at most while it runs. */
  mark(time: number, isHurried: boolean): void {
    this.now = time;
    if (isHurried && Math.abs(performance.now() - this.drawn) < 100) return;
    this.drawn = performance.now();
    for (const { chart, strip } of this.charts) {
      chart.plot.redraw(false, false);
      chart.readout.replaceChildren(...this.records.slice(0, 4).map((record) => {
        const value = el('span', {}, ` ${formatted(record.value(strip.columns[0], time))}`);
        value.style.color = colourOf(record.agent);
        return value;
      }));
    }
  }

  stop(): void {
    this.charts.splice(0).forEach(({ chart }) => chart.stop());
  }
}

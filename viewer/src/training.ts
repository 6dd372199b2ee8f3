// SPDX-License-Identifier: Apache-2.0
// Curves of trainings: runs overlaid, those of one configuration as mean and range over their seeds.
import type uPlot from 'uplot';
import { Chart } from './chart';
import { el, slider, tick } from './dom';
import { colourOf, dashOf, faded } from './palette';
import type { ReportPack, Run } from './report';
import { at, band, formatCount, type Series, shares, smoothed, union, weightOf } from './series';
import { type Limits, limitsOf, SharedRange } from './shared_range';

interface Curve {
  title: string;
  /** By env_steps, of a run; null if the run does not have it. */
  of: (run: Run, pack: ReportPack) => ArrayLike<number> | null;
  isShare?: boolean;
}

function column(name: string): Curve['of'] {
  return (run, pack) => (run.metrics[name] ? pack.array(run.metrics[name]) : null);
}

/** Control steps a second of each iteration. */
function stepsPerSecond(run: Run, pack: ReportPack): ArrayLike<number> | null {
  const needed = ['env_steps', 'rollout_s', 'update_s'];
  if (needed.some((name) => !run.timing[name])) return null;
  const [steps, rollout, update] = needed.map((name) => pack.array(run.timing[name]));
  return steps.map((value, i) => (value - (i > 0 ? steps[i - 1] : 0)) / (rollout[i] + update[i]));
}

const CURVES: Curve[] = [
  { title: 'return of an episode', of: column('return_mean') },
  { title: 'success in training', of: column('success_rate'), isShare: true },
  { title: 'success of the mean action', of: column('evaluation_success_rate'), isShare: true },
  { title: 'hold: share of it within tolerances', of: column('evaluation_hold_within'),
    isShare: true },
  { title: 'entropy', of: column('entropy') },
  { title: 'log standard deviation of actions', of: column('log_std_mean') },
  { title: 'policy loss', of: column('policy_loss') },
  { title: 'value loss', of: column('value_loss') },
  { title: 'explained variance of the value', of: column('explained_variance') },
  { title: 'approximate KL divergence', of: column('approximate_kl') },
  { title: 'clip fraction', of: column('clip_fraction') },
  { title: 'gradient norm, actor', of: column('actor_gradient_norm') },
  { title: 'gradient norm, critic', of: column('critic_gradient_norm') },
  { title: 'learning rate', of: column('learning_rate') },
  { title: 'change of action between policy steps', of: column('action_change') },
  { title: 'control steps a second', of: stepsPerSecond },
];

export interface Line {
  name: string;
  xs: ArrayLike<number>;
  ys: Series;
  repetition: number;
}

/** Every run's line of a curve, without the points at which it has no value. */
function linesOf(curve: Curve, pack: ReportPack, smoothing: number): Line[] {
  const lines: Line[] = [];
  for (const run of pack.document.runs) {
    const values = curve.of(run, pack);
    if (!values || !run.metrics.env_steps) continue;
    const steps = pack.array(run.metrics.env_steps);
    const kept = Array.from({ length: Math.min(steps.length, values.length) }, (_, i) => i)
      .filter((i) => Number.isFinite(values[i]));
    if (kept.length === 0) continue;
    lines.push({
      name: run.name,
      xs: kept.map((i) => steps[i]),
      ys: smoothed(kept.map((i) => values[i]), smoothing),
      repetition: run.repetition,
    });
  }
  return lines;
}

interface Drawn {
  data: uPlot.AlignedData;
  series: uPlot.Series[];
  bands: uPlot.Band[];
}

type Shown = (value: number | null) => string;

/** A line a run. */
function overlaid(lines: Line[], shown: Shown): Drawn {
  const xs = union(lines.map((line) => line.xs));
  return {
    data: [xs, ...lines.map((line) => xs.map((x) => at(line.xs, line.ys, x)))],
    series: lines.map((line, i) => ({
      label: line.name, stroke: colourOf(i), dash: dashOf(Math.floor(i / 8)), width: 1.6,
      spanGaps: true, points: { show: false }, value: (_, value) => shown(value),
    })),
    bands: [],
  };
}

/** Mean and range of the lines of each repetition. */
function overSeeds(lines: Line[], shown: Shown): Drawn {
  const xs = union(lines.map((line) => line.xs));
  const drawn: Drawn = { data: [xs], series: [], bands: [] };
  const data: (number[] | Series)[] = [xs];
  [...new Set(lines.map((line) => line.repetition))].forEach((repetition, i) => {
    const own = lines.filter((line) => line.repetition === repetition);
    const over = band(own.map((line) => xs.map((x) => at(line.xs, line.ys, x))));
    const colour = colourOf(i);
    // In the legend the mean says the edges.
    const edge = { stroke: 'transparent', points: { show: false }, spanGaps: true, class: 'edge' };
    const first = data.length;
    data.push(over.high, over.low, over.mean);
    const value: uPlot.Series.Value = (plot, mean, _, row) => {
      const of = (k: number) => shown((row === null ? null : plot.data[k][row]) ?? null);
      return own.length > 1 ? `${shown(mean)} (${of(first + 1)} to ${of(first)})` : shown(mean);
    };
    drawn.series.push(edge, edge, {
      label: `mean of ${own.map((line) => line.name).join(', ')}`, stroke: colour, width: 2,
      spanGaps: true, points: { show: false }, value,
    });
    drawn.bands.push({ series: [first, first + 1], fill: faded(colour, 0.25) });
  });
  drawn.data = data as uPlot.AlignedData;
  return drawn;
}

const percentOf: Shown = (value) => (value === null ? '–' : `${(100 * value).toFixed(1)} %`);
const numberOf: Shown = (value) => (value === null ? '–' : value.toPrecision(4));

function drawnOf(curve: Curve, lines: Line[], isOverSeeds: boolean): Drawn {
  const shown = curve.isShare ? percentOf : numberOf;
  return isOverSeeds ? overSeeds(lines, shown) : overlaid(lines, shown);
}

function drawCurve(
  place: HTMLElement, curve: Curve, drawn: Drawn, range: SharedRange,
): Chart {
  return new Chart(place, {
    title: curve.title, height: 190, group: 'training', range, nameX: 'control steps',
    formatX: formatCount,
    series: drawn.series, bands: drawn.bands,
    scales: curve.isShare ? { y: { range: [0, 1] } } : undefined,
  }, drawn.data);
}

/** "ended_low_speed" is "low speed". */
export function nameOfEnd(column: string): string {
  return column.replace(/^ended_/, '').replace(/_/g, ' ');
}

/** How the episodes of a run ended over time: shares, one on top of the other. */
function drawEnds(
  place: HTMLElement, run: Run, pack: ReportPack, range: SharedRange,
): Chart | null {
  const all = Object.keys(run.metrics).filter((name) => name.startsWith('ended_'));
  const names = all.filter((name) => pack.array(run.metrics[name]).some((value) => value > 0));
  if (names.length === 0) return null;
  names.sort((a, b) => Number(b === 'ended_target_reached') - Number(a === 'ended_target_reached'));
  const parts = shares(names.map((name) => pack.array(run.metrics[name])));
  const tops: Series[] = [];
  parts.forEach((part, k) => {
    tops.push(part.map((v, i) => (v === null ? null : v + (k > 0 ? (tops[k - 1][i] ?? 0) : 0))));
  });
  const order = names.map((_, k) => names.length - 1 - k);
  return new Chart(place, {
    title: `how episodes end: ${run.name}`, height: 190, group: 'training', range,
    nameX: 'control steps', formatX: formatCount,
    scales: { y: { range: [0, 1] } },
    series: order.map((k) => ({
      label: nameOfEnd(names[k]), stroke: colourOf(k), width: 1, points: { show: false },
      fill: colourOf(k), spanGaps: true,
      value: (_: uPlot, __: number, ___: number, i: number | null) =>
        percentOf(i === null ? null : parts[k][i]),
    })),
  }, [Array.from(pack.array(run.metrics.env_steps)), ...order.map((k) => tops[k])]);
}

/** From the first to the last iteration of all runs, in control steps. */
export function stepsOf(pack: ReportPack): Limits {
  return limitsOf(pack.document.runs.flatMap(({ metrics }) =>
    (metrics.env_steps ? [pack.array(metrics.env_steps)] : [])));
}

class TrainingView {
  private readonly curves = new Map<Curve, Chart>();
  private readonly others: Chart[] = [];
  private readonly grid = el('div', { class: 'charts' });
  private readonly range: SharedRange;
  private position = 20;
  private isOverSeeds: boolean;

  constructor(place: HTMLElement, private readonly pack: ReportPack) {
    const { runs } = pack.document;
    this.range = new SharedRange(stepsOf(pack));
    const hasSeeds = new Set(runs.map((run) => run.repetition)).size < runs.length;
    this.isOverSeeds = hasSeeds;
    const smoothing = slider('smoothing', 0, 100, this.position, (position) => {
      this.position = position;
      this.smooth();
    });
    const seeds = tick('mean and range over seeds', hasSeeds, (isOn) => {
      this.isOverSeeds = isOn;
      this.draw();
    });
    place.append(
      el('div', { class: 'controls' }, smoothing, hasSeeds ? seeds : null,
        el('span', { class: 'hint' }, 'All charts show the same control steps: drag over one to '
          + 'enlarge a part in all, double-click to go back.')),
      this.grid,
    );
    this.draw();
  }

  private linesOf(curve: Curve): Line[] {
    return linesOf(curve, this.pack, weightOf(this.position));
  }

  private draw(): void {
    this.stop();
    this.grid.replaceChildren();
    for (const curve of CURVES) {
      const lines = this.linesOf(curve);
      if (lines.length === 0) continue;
      const drawn = drawnOf(curve, lines, this.isOverSeeds);
      this.curves.set(curve, drawCurve(this.grid, curve, drawn, this.range));
    }
    for (const run of this.pack.document.runs) {
      const chart = drawEnds(this.grid, run, this.pack, this.range);
      if (chart) this.others.push(chart);
    }
    if (this.grid.childElementCount === 0) this.grid.append(el('p', {}, 'There is no iteration yet.'));
  }

  /** The same charts, with the part that they show. */
  private smooth(): void {
    for (const [curve, chart] of this.curves) {
      chart.plot.setData(drawnOf(curve, this.linesOf(curve), this.isOverSeeds).data);
    }
  }

  stop(): void {
    [...this.curves.values(), ...this.others].forEach((chart) => chart.stop());
    this.curves.clear();
    this.others.length = 0;
  }
}

/** The view; returns what ends it. */
export function showTraining(place: HTMLElement, pack: ReportPack): () => void {
  const view = new TrainingView(place, pack);
  return () => view.stop();
}

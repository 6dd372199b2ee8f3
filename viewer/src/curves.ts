// SPDX-License-Identifier: Apache-2.0
// What the charts of trainings are made of: the curves, a line of each run's, and their colours,
// which are the same in every chart.
import type uPlot from 'uplot';
import { colourOf, dashOf, endColourOf, faded } from './palette';
import { nameOfEnd, type ReportPack, type Run } from './report';
import { at, band, type Series, smoothed, union } from './series';

export interface Curve {
  title: string;
  /** By env_steps, of a run; null if the run does not have it. */
  of: (run: Run, pack: ReportPack) => ArrayLike<number> | null;
  isShare?: boolean;
  /** Of evaluations: few values, each of many episodes, which are never smoothed. */
  isEvaluation?: boolean;
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

export const CURVES: Curve[] = [
  { title: 'return of an episode', of: column('return_mean') },
  { title: 'success in training', of: column('success_rate'), isShare: true },
  { title: 'success of the mean action', of: column('evaluation_success_rate'), isShare: true,
    isEvaluation: true },
  { title: 'hold: share of it within tolerances', of: column('evaluation_hold_within'),
    isShare: true, isEvaluation: true },
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
  /** As it is drawn, and as it was measured. */
  ys: Series;
  measured: Series;
  /** Of its run among all runs, whether or not they have this curve. */
  run: number;
  repetition: number;
}

/** Every run's line of a curve, without the points at which it has no value. */
export function linesOf(curve: Curve, pack: ReportPack, smoothing: number): Line[] {
  const lines: Line[] = [];
  pack.document.runs.forEach((run, index) => {
    const values = curve.of(run, pack);
    if (!values || !run.metrics.env_steps) return;
    const steps = pack.array(run.metrics.env_steps);
    const kept = Array.from({ length: Math.min(steps.length, values.length) }, (_, i) => i)
      .filter((i) => Number.isFinite(values[i]));
    if (kept.length === 0) return;
    const measured = kept.map((i) => values[i]);
    lines.push({
      name: run.name,
      xs: kept.map((i) => steps[i]),
      ys: smoothed(measured, curve.isEvaluation ? 0 : smoothing),
      measured,
      run: index,
      repetition: run.repetition,
    });
  });
  return lines;
}

export interface Drawn {
  data: uPlot.AlignedData;
  series: uPlot.Series[];
  bands: uPlot.Band[];
}

export type Shown = (value: number | null) => string;

/** The value of a row; none where the pointer is at none. */
function inRow(values: Series, row: number | null): number | null {
  return row === null ? null : values[row] ?? null;
}

/** A line a run; values that are few, with their points, so that one alone is seen. */
function overlaid(lines: Line[], shown: Shown, arePoints: boolean): Drawn {
  const xs = union(lines.map((line) => line.xs));
  return {
    data: [xs, ...lines.map((line) => xs.map((x) => at(line.xs, line.ys, x)))],
    series: lines.map((line) => {
      const measured = xs.map((x) => at(line.xs, line.measured, x));
      return {
        label: line.name, stroke: colourOf(line.run), dash: dashOf(line.run),
        width: 1.6, spanGaps: true, points: { show: arePoints },
        value: (_, __, ___, row) => shown(inRow(measured, row)),
      };
    }),
    bands: [],
  };
}

/** Mean and range of the lines of each repetition. */
function overSeeds(lines: Line[], shown: Shown, arePoints: boolean): Drawn {
  const xs = union(lines.map((line) => line.xs));
  const drawn: Drawn = { data: [xs], series: [], bands: [] };
  const data: (number[] | Series)[] = [xs];
  for (const repetition of new Set(lines.map((line) => line.repetition))) {
    const own = lines.filter((line) => line.repetition === repetition);
    const over = band(own.map((line) => xs.map((x) => at(line.xs, line.ys, x))));
    const measured = band(own.map((line) => xs.map((x) => at(line.xs, line.measured, x))));
    const colour = colourOf(repetition);
    // In the legend the mean says the edges.
    const edge = { stroke: 'transparent', points: { show: false }, spanGaps: true, class: 'edge' };
    const first = data.length;
    data.push(over.high, over.low, over.mean);
    const value: uPlot.Series.Value = (_, __, ___, row) => {
      const [mean, low, high] = [measured.mean, measured.low, measured.high]
        .map((values) => shown(inRow(values, row)));
      return own.length > 1 ? `${mean} (${low} to ${high})` : mean;
    };
    drawn.series.push(edge, edge, {
      label: `mean of ${own.map((line) => line.name).join(', ')}`, stroke: colour, width: 2,
      dash: dashOf(repetition), spanGaps: true, points: { show: arePoints }, value,
    });
    drawn.bands.push({ series: [first, first + 1], fill: faded(colour, 0.25) });
  }
  drawn.data = data as uPlot.AlignedData;
  return drawn;
}

export const percentOf: Shown = (value) =>
  (value === null ? '–' : `${(100 * value).toFixed(1)} %`);
const numberOf: Shown = (value) => (value === null ? '–' : value.toPrecision(4));

/** The lines of a curve; smoothing is drawn, and legends say what was measured. */
export function drawnOf(curve: Curve, lines: Line[], isOverSeeds: boolean): Drawn {
  const shown = curve.isShare ? percentOf : numberOf;
  const arePoints = (curve.isEvaluation ?? false) || lines.some(({ xs }) => xs.length === 1);
  return isOverSeeds ? overSeeds(lines, shown, arePoints) : overlaid(lines, shown, arePoints);
}

export interface End {
  column: string;
  name: string;
  colour: string;
}

const FIRST_ENDS = ['ended_target_reached', 'ended_time_limit'];

/** The kinds of ends that runs count, from the lowest of a stack on: the same for each run. */
export function endKindsOf(runs: Run[]): End[] {
  const counted = [...new Set(runs.flatMap(({ metrics }) => Object.keys(metrics)))]
    .filter((name) => name.startsWith('ended_'));
  const first = FIRST_ENDS.filter((name) => counted.includes(name));
  return [...first, ...counted.filter((name) => !first.includes(name))].map((column) => {
    const end = column.replace(/^ended_/, '');
    return { column, name: nameOfEnd(end, false), colour: endColourOf(end) };
  });
}

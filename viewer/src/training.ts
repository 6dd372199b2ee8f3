// SPDX-License-Identifier: Apache-2.0
// Curves of trainings: runs overlaid, those of one configuration as mean and range over their seeds.
import type uPlot from 'uplot';
import { Chart, TICK_DIGITS } from './chart';
import {
  CURVES, type Drawn, drawnOf, type End, endKindsOf, linesOf, percentOf,
} from './curves';
import { button, el, slider, tick } from './dom';
import { styleColour } from './palette';
import type { ReportPack, Run } from './report';
import { montage, savePicture, saveTable } from './save';
import { formatCount, type Series, shares, weightOf } from './series';
import type { Shown } from './shown';
import { trainingCsv } from './tables';
import { type Limits, limitsOf, SharedRange } from './shared_range';

interface Part extends Drawn {
  title: string;
  isShare: boolean;
}

/** How the episodes of a run ended over time: shares, one on top of the other. */
export function endsPartOf(run: Run, all: End[], pack: ReportPack): Part | null {
  const countsOf = ({ column }: End) =>
    (run.metrics[column] ? pack.array(run.metrics[column]) : new Float32Array());
  const ends = all.filter((end) => countsOf(end).some((count) => count > 0));
  if (ends.length === 0) return null;
  const parts = shares(ends.map(countsOf));
  const tops: Series[] = [];
  parts.forEach((part, k) => {
    tops.push(part.map((v, i) => (v === null ? null : v + (k > 0 ? (tops[k - 1][i] ?? 0) : 0))));
  });
  const order = ends.map((_, k) => ends.length - 1 - k);
  return {
    title: `how episodes end: ${run.name}`, isShare: true, bands: [],
    series: order.map((k) => ({
      // Between areas is a line of the ground's colour.
      label: ends[k].name, stroke: styleColour('--ground'), width: 1, points: { show: false },
      fill: ends[k].colour, spanGaps: true,
      value: (_: uPlot, __: number, ___: number, i: number | null) =>
        percentOf(i === null ? null : parts[k][i]),
    })),
    data: [Array.from(pack.array(run.metrics.env_steps)), ...order.map((k) => tops[k])],
  };
}

/** From the first to the last iteration of all runs, in control steps. */
export function stepsOf(pack: ReportPack): Limits {
  return limitsOf(pack.document.runs.flatMap(({ metrics }) =>
    (metrics.env_steps ? [pack.array(metrics.env_steps)] : [])));
}

/** Whether there are runs of one configuration, to be shown as mean and range. */
function hasSeeds({ document: { runs } }: ReportPack): boolean {
  return new Set(runs.map((run) => run.repetition)).size < runs.length;
}

/** What charts are of: the same of two packs if the second only has other numbers. */
function subjectsOf(parts: Part[]): string {
  return JSON.stringify(parts.map(({ title, series }) => [title, series.map(({ label }) => label)]));
}

class TrainingView implements Shown {
  private parts: Part[] = [];
  private charts: Chart[] = [];
  private readonly grid = el('div', { class: 'charts' });
  private readonly range: SharedRange;
  private position = 20;
  private isOverSeeds = true;
  private readonly seeds: HTMLElement;

  constructor(place: HTMLElement, private pack: ReportPack) {
    this.range = new SharedRange(stepsOf(pack));
    const smoothing = slider('smoothing', 0, 100, this.position, (position) => {
      this.position = position;
      this.draw();
    });
    this.seeds = tick('mean and range over seeds', this.isOverSeeds, (isOn) => {
      this.isOverSeeds = isOn;
      this.draw();
    });
    place.append(
      el('div', { class: 'controls' }, smoothing, this.seeds,
        button('whole', 'all control steps in all charts', () => this.range.showAll()),
        button('save picture', 'the charts as they are, as PNG', () => this.savePicture()),
        button('save data', 'what was measured, a row for every iteration of every run, as CSV',
          () => this.saveData()),
        el('span', { class: 'hint' }, 'Smoothing leaves evaluations and legends as they are. All '
          + 'charts show the same control steps: drag over one to enlarge a part in all, double-click '
          + 'or "whole" to go back. A press on a name in a legend hides its line.')),
      this.grid,
    );
    this.draw();
  }

  private partsOf(): Part[] {
    const { runs } = this.pack.document;
    const weight = weightOf(this.position);
    const isOverSeeds = this.isOverSeeds && hasSeeds(this.pack);
    const curves = CURVES.flatMap((curve) => {
      const lines = linesOf(curve, this.pack, weight);
      return lines.length === 0 ? [] : [{ title: curve.title, isShare: curve.isShare ?? false,
        ...drawnOf(curve, lines, isOverSeeds) }];
    });
    const kinds = endKindsOf(runs);
    const ends = runs.map((run) => endsPartOf(run, kinds, this.pack)).filter((part) => part !== null);
    return [...curves, ...ends];
  }

  /** Numbers of what is drawn already go into its charts, which keep the pointer, the part that
   * they show, and which lines are hidden. */
  private draw(): void {
    this.seeds.hidden = !hasSeeds(this.pack);
    const before = subjectsOf(this.parts);
    this.parts = this.partsOf();
    if (this.charts.length > 0 && subjectsOf(this.parts) === before) {
      this.charts.forEach((chart, k) => chart.renew(this.parts[k].series, this.parts[k].data));
      return;
    }
    this.stop();
    this.grid.replaceChildren();
    this.charts = this.parts.map((part) => new Chart(this.grid, {
      title: part.title, height: 190, group: 'training', range: this.range,
      nameX: 'control steps', formatX: (x) => formatCount(x),
      tickX: (x) => formatCount(x, TICK_DIGITS), series: part.series, bands: part.bands,
      scales: part.isShare ? { y: { range: [0, 1] } } : undefined,
    }, part.data));
    if (this.charts.length === 0) this.grid.append(el('p', {}, 'There is no iteration yet.'));
  }

  renew(pack: ReportPack): void {
    this.pack = pack;
    this.range.renew(stepsOf(pack));
    this.draw();
  }

  /** Charts have the colours that they were made with. */
  recolour(): void {
    const scroll = scrollY;
    const hidden = this.charts.map((chart) => chart.hidden);
    this.stop();
    this.draw();
    this.charts.forEach((chart, k) => chart.hide(hidden[k]));
    scrollTo(0, scroll);
  }

  private savePicture(): void {
    savePicture('training.png', montage([], this.charts.map((chart) => chart.picture())));
  }

  private saveData(): void {
    saveTable('training.csv', trainingCsv(this.pack));
  }

  stop(): void {
    this.charts.splice(0).forEach((chart) => chart.stop());
  }
}

/** Puts the curves of the pack's trainings, and what they are saved and smoothed by, into `place`. */
export function showTraining(place: HTMLElement, pack: ReportPack): Shown {
  return new TrainingView(place, pack);
}

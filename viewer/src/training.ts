// SPDX-License-Identifier: Apache-2.0
// Curves of trainings: runs overlaid, those of one configuration as mean and range over their seeds.
import type uPlot from 'uplot';
import { Chart } from './chart';
import {
  type Curve, CURVES, type Drawn, drawnOf, type End, endKindsOf, type Line, linesOf, percentOf,
} from './curves';
import { el, slider, tick } from './dom';
import type { ReportPack, Run } from './report';
import { formatCount, type Series, shares, weightOf } from './series';
import { type Limits, limitsOf, SharedRange } from './shared_range';

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

/** How the episodes of a run ended over time: shares, one on top of the other. */
function drawEnds(
  place: HTMLElement, run: Run, all: End[], pack: ReportPack, range: SharedRange,
): Chart | null {
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
  return new Chart(place, {
    title: `how episodes end: ${run.name}`, height: 190, group: 'training', range,
    nameX: 'control steps', formatX: formatCount,
    scales: { y: { range: [0, 1] } },
    series: order.map((k) => ({
      label: ends[k].name, stroke: ends[k].colour, width: 1, points: { show: false },
      fill: ends[k].colour, spanGaps: true,
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
        el('span', { class: 'hint' }, 'Smoothing leaves evaluations and legends as they are. All '
          + 'charts show the same control steps: drag over one to enlarge a part in all, double-click '
          + 'to go back.')),
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
    const { runs } = this.pack.document;
    const ends = endKindsOf(runs);
    for (const run of runs) {
      const chart = drawEnds(this.grid, run, ends, this.pack, this.range);
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

// SPDX-License-Identifier: Apache-2.0
// What the charts of one view show of their common x axis.

export interface Limits {
  min: number;
  max: number;
}

/** What is asked of a chart's plot (uPlot's). */
export interface Ranged {
  setScale(key: 'x', limits: Limits): void;
}

/** From the least to the greatest number of all arrays; from 0 if that is one number, or none. */
export function limitsOf(arrays: ArrayLike<number>[]): Limits {
  let [min, max] = [Infinity, -Infinity];
  for (const values of arrays) {
    for (let i = 0; i < values.length; i += 1) {
      if (!Number.isFinite(values[i])) continue;
      min = Math.min(min, values[i]);
      max = Math.max(max, values[i]);
    }
  }
  if (min < max) return { min, max };
  return { min: 0, max: max > 0 ? max : 1 };
}

/** One range for all plots that have joined, whatever part of it each has values in. */
export class SharedRange {
  private readonly plots = new Set<Ranged>();
  private shown: Limits;

  constructor(private whole: Limits) {
    this.shown = whole;
  }

  get limits(): Limits {
    return this.shown;
  }

  join(plot: Ranged): void {
    this.plots.add(plot);
  }

  leave(plot: Ranged): void {
    this.plots.delete(plot);
  }

  /** Shows a part of the whole in all plots; nothing happens if it has no width. */
  show({ min, max }: Limits): void {
    const part = { min: Math.max(min, this.whole.min), max: Math.min(max, this.whole.max) };
    if (!(part.min < part.max)) return;
    this.shown = part;
    for (const plot of this.plots) plot.setScale('x', { ...part });
  }

  showAll(): void {
    this.show(this.whole);
  }

  /** The whole is another one: shown if the whole was, or if nothing of the part that was shown is
   * in it; else that part stays. */
  renew(whole: Limits): void {
    const { min, max } = this.shown;
    const wasWhole = min === this.whole.min && max === this.whole.max;
    this.whole = whole;
    const isOutside = min >= whole.max || max <= whole.min;
    this.show(wasWhole || isOutside ? whole : this.shown);
  }
}

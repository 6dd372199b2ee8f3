// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { inflate, unpack } from '../src/pack';
import type { ReportDocument } from '../src/report';
import { type Limits, limitsOf, SharedRange } from '../src/shared_range';
import { stepsOf } from '../src/training';
import { fixture } from './fixture';

/** A plot that remembers what it was told to show. */
class Plot {
  readonly told: Limits[] = [];

  setScale(_: 'x', limits: Limits): void {
    this.told.push(limits);
  }
}

describe('limits', () => {
  it('hold all numbers of all arrays', () => {
    expect(limitsOf([[3, 5], [], [NaN, 1, 4, Infinity]])).toEqual({ min: 1, max: 5 });
  });
  it('have a width, whatever there is', () => {
    expect(limitsOf([[7]])).toEqual({ min: 0, max: 7 });
    expect(limitsOf([[0, 0]])).toEqual({ min: 0, max: 1 });
    expect(limitsOf([])).toEqual({ min: 0, max: 1 });
  });
  it('of a training are those of all its iterations', async () => {
    const pack = unpack<ReportDocument>(await inflate(fixture('seed', 0)));
    expect(stepsOf(pack)).toEqual({ min: 5e5, max: 3e7 });
  });
});

describe('a shared range', () => {
  it('shows a part in all plots, and all of it again', () => {
    const range = new SharedRange({ min: 0, max: 10 });
    const plots = [new Plot(), new Plot()];
    plots.forEach((plot) => range.join(plot));
    range.show({ min: 2, max: 4 });
    expect(range.limits).toEqual({ min: 2, max: 4 });
    range.showAll();
    expect(range.limits).toEqual({ min: 0, max: 10 });
    for (const { told } of plots) expect(told).toEqual([{ min: 2, max: 4 }, { min: 0, max: 10 }]);
  });
  it('goes no farther than the whole, and has a width', () => {
    const range = new SharedRange({ min: 0, max: 10 });
    range.show({ min: -5, max: 4 });
    expect(range.limits).toEqual({ min: 0, max: 4 });
    range.show({ min: 3, max: 3 });
    range.show({ min: 11, max: 12 });
    range.show({ min: NaN, max: 3 });
    expect(range.limits).toEqual({ min: 0, max: 4 });
  });
  it('grows with the whole, unless a part is shown', () => {
    const range = new SharedRange({ min: 0, max: 10 });
    range.renew({ min: 0, max: 12 });
    expect(range.limits).toEqual({ min: 0, max: 12 });
    range.show({ min: 2, max: 4 });
    range.renew({ min: 0, max: 14 });
    expect(range.limits).toEqual({ min: 2, max: 4 });
    range.showAll();
    expect(range.limits).toEqual({ min: 0, max: 14 });
  });
  it('shows the whole where this shrinks below the part that is shown', () => {
    const range = new SharedRange({ min: 0, max: 10 });
    const plot = new Plot();
    range.join(plot);
    range.show({ min: 4, max: 8 });
    range.renew({ min: 0, max: 6 });
    expect(range.limits).toEqual({ min: 4, max: 6 });
    range.renew({ min: 0, max: 3 });
    expect(range.limits).toEqual({ min: 0, max: 3 });
    expect(plot.told.at(-1)).toEqual({ min: 0, max: 3 });
    range.renew({ min: 0, max: 5 });
    expect(range.limits).toEqual({ min: 0, max: 5 });
  });
  it('leaves plots alone that are gone', () => {
    const range = new SharedRange({ min: 0, max: 10 });
    const plot = new Plot();
    range.join(plot);
    range.leave(plot);
    range.show({ min: 2, max: 4 });
    expect(plot.told).toEqual([]);
  });
});

// SPDX-License-Identifier: Apache-2.0
// What curves do to numbers.
import type { Numbers } from './pack';

/** A value that is not there is null, as uPlot has it. */
export type Series = (number | null)[];

/**
 * Exponential moving average with the given weight of what was before, 0 to 1, free of the bias of
 * its beginning; gaps stay gaps.
 */
export function smoothed(values: ArrayLike<number>, weight: number): Series {
  const result: Series = [];
  let sum = 0;
  let mass = 0;
  for (let i = 0; i < values.length; i += 1) {
    if (!Number.isFinite(values[i])) {
      result.push(null);
      continue;
    }
    sum = weight * sum + (1 - weight) * values[i];
    mass = weight * mass + (1 - weight);
    result.push(sum / mass);
  }
  return result;
}

/** Weights of an average come close to one in steps that grow small: 0 to 100 is 0 to 0.99. */
export function weightOf(position: number): number {
  return position <= 0 ? 0 : 1 - 10 ** (-position / 50);
}

/** The value at x, linear between neighbours; null outside, and where no neighbour has one. */
export function at(xs: ArrayLike<number>, ys: ArrayLike<number | null>, x: number): number | null {
  const last = xs.length - 1;
  if (last < 0 || x < xs[0] || x > xs[last]) return null;
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle;
    else high = middle;
  }
  const left = ys[low];
  const right = ys[high];
  if (x === xs[low] || low === high) return left;
  if (x === xs[high]) return right;
  if (left === null || right === null) return null;
  return left + ((right - left) * (x - xs[low])) / (xs[high] - xs[low]);
}

export interface Band {
  mean: Series;
  low: Series;
  high: Series;
}

/** Mean and range of several curves, which are read at each of `xs`; null where one is missing. */
export function band(curves: Series[]): Band {
  const result: Band = { mean: [], low: [], high: [] };
  const length = Math.max(0, ...curves.map((curve) => curve.length));
  for (let i = 0; i < length; i += 1) {
    const values = curves.map((curve) => curve[i]).filter((v): v is number => v != null);
    const isWhole = values.length === curves.length && values.length > 0;
    result.mean.push(isWhole ? values.reduce((a, b) => a + b, 0) / values.length : null);
    result.low.push(isWhole ? Math.min(...values) : null);
    result.high.push(isWhole ? Math.max(...values) : null);
  }
  return result;
}

/** All different values of several sorted arrays, sorted. */
export function union(arrays: ArrayLike<number>[]): number[] {
  const all = new Set<number>();
  for (const values of arrays) for (let i = 0; i < values.length; i += 1) all.add(values[i]);
  return [...all].sort((a, b) => a - b);
}

/** Shares of their sum, column by column; null where nothing ended. */
export function shares(columns: Numbers[]): Series[] {
  return columns.map((column) =>
    Array.from(column, (value, i) => {
      const sum = columns.reduce((total, other) => total + other[i], 0);
      return sum > 0 ? value / sum : null;
    }));
}

/** "1.2 M", "300 k": of so many digits. */
export function formatCount(value: number, digits = 3): string {
  for (const [unit, name] of [[1e9, 'G'], [1e6, 'M'], [1e3, 'k']] as const) {
    if (Math.abs(value) >= unit) return `${Number((value / unit).toPrecision(digits))} ${name}`;
  }
  return `${Number(value.toPrecision(digits))}`;
}

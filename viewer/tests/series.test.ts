// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { at, band, formatCount, shares, smoothed, union, weightOf } from '../src/series';

describe('smoothing', () => {
  it('leaves a constant as it is, from its first value on', () => {
    smoothed([4, 4, 4, 4], 0.9).forEach((value) => expect(value).toBeCloseTo(4, 12));
  });
  it('does nothing with weight 0, and keeps gaps', () => {
    expect(smoothed([1, NaN, 3], 0)).toEqual([1, null, 3]);
  });
  it('grows with the slider, from none, and never stands still', () => {
    expect(weightOf(0)).toBe(0);
    for (let position = 1; position <= 100; position += 1) {
      expect(weightOf(position)).toBeGreaterThan(weightOf(position - 1));
    }
    expect(weightOf(100)).toBeCloseTo(0.99, 12);
  });
  it('stays within the values', () => {
    const values = [0, 10, 2, 8, 5];
    for (const value of smoothed(values, 0.7)) {
      expect(value).toBeGreaterThanOrEqual(0);
      expect(value).toBeLessThanOrEqual(10);
    }
  });
});

describe('reading a curve', () => {
  it('is linear between points and nothing outside', () => {
    expect(at([0, 10], [0, 5], 4)).toBe(2);
    expect(at([0, 10], [0, 5], 10)).toBe(5);
    expect(at([0, 10], [0, 5], 11)).toBeNull();
    expect(at([], [], 1)).toBeNull();
    expect(at([0, 10], [0, null], 4)).toBeNull();
  });
});

describe('a band', () => {
  it('holds its mean between its ends, and has nothing where a curve has none', () => {
    const over = band([[1, 2, null], [3, 6, 1]]);
    expect(over).toEqual({ mean: [2, 4, null], low: [1, 2, null], high: [3, 6, null] });
  });
  it('of no curve is empty', () => {
    expect(band([])).toEqual({ mean: [], low: [], high: [] });
  });
});

it('shares of the ends sum to one, where anything ended', () => {
  const [a, b] = shares([Float32Array.of(1, 0, 3), Float32Array.of(3, 0, 1)]);
  expect(a).toEqual([0.25, null, 0.75]);
  expect(b).toEqual([0.75, null, 0.25]);
});

it('a union is sorted and has every value once', () => {
  expect(union([[3, 1], [2, 3]])).toEqual([1, 2, 3]);
});

it('counts are short', () => {
  expect([0, 950, 12_345, 1e8].map((count) => formatCount(count)))
    .toEqual(['0', '950', '12.3 k', '100 M']);
  // Ticks near each other differ.
  expect([1.0005e7, 1.001e7, 1.0015e7].map((count) => formatCount(count, 10)))
    .toEqual(['10.005 M', '10.01 M', '10.015 M']);
});

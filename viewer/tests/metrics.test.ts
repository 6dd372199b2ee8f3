// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { isSpecial } from '../src/configuration';
import { formatEstimate, liesApart, nameOf } from '../src/metrics';

const SHARE = {
  key: 'success_rate', symbol: '', label: 'success, %', section: '', shown_per_unit: 100,
  decimals: 1, is_headline: true,
};
const estimate = (value: number | null, low: number | null, high: number | null) =>
  ({ value, low, high, count: 10 });

describe('a cell of the table', () => {
  it('has an interval, to one side where it lies to one side', () => {
    expect(formatEstimate(SHARE, estimate(0.5, 0.4, 0.6))).toBe('50.0 ± 10.0');
    expect(formatEstimate(SHARE, estimate(1, 0.996, 1))).toBe('100.0 (99.6, 100.0)');
    expect(formatEstimate(SHARE, estimate(0.5, null, null))).toBe('50.0');
    expect(formatEstimate(SHARE, estimate(null, null, null))).toBe('–');
    expect(formatEstimate(SHARE, undefined)).toBe('–');
  });
  it('is marked where intervals lie apart', () => {
    expect(liesApart(SHARE, estimate(1, 0.9, 1.1), estimate(2, 1.2, 2.8))).toBe(true);
    expect(liesApart(SHARE, estimate(1, 0.9, 1.3), estimate(2, 1.2, 2.8))).toBe(false);
    expect(liesApart(SHARE, estimate(1, null, null), estimate(2, 1.2, 2.8))).toBe(false);
  });
  it('is not marked beside one that prints the same', () => {
    const [low, high, below] = [1e-5, 3e-5, -2e-5].map((x) => estimate(x, x - 1e-6, x + 1e-6));
    expect([low, high, below].map((shown) => formatEstimate(SHARE, shown)))
      .toEqual(['0.0 ± 0.0', '0.0 ± 0.0', '0.0 ± 0.0']);
    expect(liesApart(SHARE, low, high)).toBe(false);
    expect(liesApart(SHARE, low, below)).toBe(false);
    expect(liesApart({ ...SHARE, decimals: 3 }, low, high)).toBe(true);
  });
});

it('rows of stick commands say which', () => {
  expect(nameOf({ ...SHARE, label: 'variation, 1/s', symbol: 'roll', section: 'stick actions' }))
    .toBe('variation, 1/s (roll)');
  expect(nameOf(SHARE)).toBe('success, %');
});

it('settings are shown that differ from the preset or between runs', () => {
  const same = { key: 'a', value: '1', help: '' };
  expect(isSpecial([same, same])).toBe(false);
  expect(isSpecial([same, { ...same, value: '2' }])).toBe(true);
  expect(isSpecial([{ ...same, preset: '3' }])).toBe(true);
  expect(isSpecial([same, undefined])).toBe(true);
});

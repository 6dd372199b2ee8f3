// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { formatDifference, isMarked } from '../src/metrics';
import { differenceOf, isBetter, referencesOf, sideOfZero } from '../src/paired';
import type { ComparedAgent, Comparison, Estimate, Quantity } from '../src/report';

const SHARE: Quantity = {
  key: 'success_rate', symbol: '', label: 'success, %', section: '', shown_per_unit: 100,
  decimals: 1, is_headline: true, better: 'higher',
};
const estimate = (value: number | null, low: number | null, high: number | null): Estimate =>
  ({ value, low, high, count: 10 });

/** Agents whose value is their number, with differences as the data have them. */
function comparisonOf(count: number, hasAll: boolean): Comparison {
  const paired = (value: number) => ({
    estimates: {
      success_rate: estimate(value, value - 0.3, value + 0.1),
      mach: estimate(value, value - 0.3, value + 0.1),
    },
    success_p_value: 0.06,
  });
  const agents: ComparedAgent[] = Array.from({ length: count }, (_, i) => ({
    name: `agent ${i}`, action_repeat: 1, terminations: {},
    estimates: { success_rate: estimate(i, i - 9, i + 9) },
    against_first: i > 0 ? paired(i) : undefined,
    against: hasAll ? Array.from({ length: i }, (_, earlier) => paired(i - earlier)) : undefined,
  }));
  return { task: 'heading', conditions: '', episodes: 10, seed: 1, quantities: [SHARE], agents };
}

describe('the difference of an agent from another', () => {
  it('is the one of the data, turned round where the other comes later', () => {
    const comparison = comparisonOf(3, true);
    expect(differenceOf(comparison, 2, 1, 'mach')).toEqual(estimate(1, 0.7, 1.1));
    expect(differenceOf(comparison, 1, 2, 'mach')).toEqual(estimate(-1, -1.1, -0.7));
    expect(differenceOf(comparison, 2, 2, 'mach')).toBeUndefined();
    expect(differenceOf(comparison, 2, 1, 'sideslip')).toBeUndefined();
  });
  it('is known from the first alone in data that have no others', () => {
    const comparison = comparisonOf(3, false);
    expect(differenceOf(comparison, 2, 0, 'mach')).toEqual(estimate(2, 1.7, 2.1));
    expect(differenceOf(comparison, 0, 2, 'mach')).toEqual(estimate(-2, -2.1, -1.7));
    expect(differenceOf(comparison, 2, 1, 'mach')).toBeUndefined();
  });
  it('has the p-value of success, which is none where its interval leaves out 0', () => {
    const comparison = comparisonOf(2, false);
    for (const [agent, reference] of [[1, 0], [0, 1]]) {
      const difference = differenceOf(comparison, agent, reference, 'success_rate');
      expect(difference?.p_value).toBe(0.06);
      expect(sideOfZero(difference)).toBe(0);
      expect(sideOfZero({ ...difference!, p_value: 0.04 })).toBe(agent > reference ? 1 : -1);
    }
  });
  it('is nothing where there is nothing, also turned round', () => {
    const comparison = comparisonOf(2, false);
    const none = estimate(null, null, null);
    comparison.agents[1].against_first = { estimates: { mach: none }, success_p_value: 1 };
    expect(differenceOf(comparison, 0, 1, 'mach')).toEqual(none);
  });
});

it('a reference is an agent that all others have a difference from', () => {
  expect(referencesOf(comparisonOf(3, true))).toEqual([0, 1, 2]);
  expect(referencesOf(comparisonOf(3, false))).toEqual([0]);
  expect(referencesOf(comparisonOf(2, false))).toEqual([0, 1]);
  expect(referencesOf(comparisonOf(1, true))).toEqual([]);
});

describe('a value', () => {
  const above = estimate(0.02, 0.01, 0.03);
  const below = estimate(-0.02, -0.03, -0.01);
  const about = estimate(0.02, -0.01, 0.05);

  it('is better where the interval of its difference lies on the better side of zero', () => {
    expect([above, below, about].map(sideOfZero)).toEqual([1, -1, 0]);
    expect([above, below, about].map((d) => isBetter(SHARE, d))).toEqual([true, false, false]);
    expect([above, below, about].map((d) => isBetter({ ...SHARE, better: 'lower' }, d)))
      .toEqual([false, true, false]);
    expect([above, below, about].map((d) => isBetter({ ...SHARE, better: '' }, d)))
      .toEqual([false, false, false]);
    expect(isBetter(SHARE, undefined)).toBe(false);
    expect(isBetter(SHARE, estimate(0.02, null, null))).toBe(false);
    expect(isBetter(SHARE, estimate(0.02, 0, 0.04))).toBe(false);
  });
  it('is bold by its difference, whether or not the intervals of the values lie apart', () => {
    const [first, near, far] = [0.5, 0.52, 0.9].map((x) => estimate(x, x - 0.1, x + 0.1));
    expect(isMarked(SHARE, first, near, above)).toBe(true);
    expect(isMarked(SHARE, first, far, about)).toBe(false);
  });
  it('is not bold beside one that prints the same, or by a difference that prints as zero', () => {
    const [first, other] = [0.50001, 0.50003].map((x) => estimate(x, x - 0.1, x + 0.1));
    const small = estimate(2e-5, 1e-5, 3e-5);
    expect(isMarked(SHARE, first, other, small)).toBe(false);
    expect(isMarked({ ...SHARE, decimals: 3 }, first, other, small)).toBe(true);
    expect(isMarked(SHARE, first, estimate(0.6, 0.5, 0.7), small)).toBe(false);
    expect(isMarked(SHARE, first, other, above)).toBe(false);
  });
});

it('a difference is shown with its sign', () => {
  expect(formatDifference(SHARE, estimate(0.02, 0.01, 0.03))).toBe('+2.0 ± 1.0');
  expect(formatDifference(SHARE, estimate(-0.02, -0.03, -0.01))).toBe('-2.0 ± 1.0');
  expect(formatDifference(SHARE, estimate(1e-6, -0.01, 0.01))).toBe('0.0 ± 1.0');
  expect(formatDifference(SHARE, estimate(0.02, 0.01, 0.05))).toBe('+2.0 (1.0, 5.0)');
  expect(formatDifference(SHARE, estimate(null, null, null))).toBe('–');
  expect(formatDifference(SHARE, undefined)).toBe('–');
});

// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { isSpecial } from '../src/configuration';
import { endsOf, formatEstimate, nameOf } from '../src/metrics';
import { areOfMissions, type ComparedAgent, type Quantity } from '../src/report';

const SHARE: Quantity = {
  key: 'success_rate', symbol: '', label: 'success, %', section: '', shown_per_unit: 100,
  decimals: 1, is_headline: true, better: 'higher',
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

it('missions that were flown to their end are not called by the time limit', () => {
  const agent = { terminations: { low_altitude: 1, target_reached: 0, time_limit: 2 } } as
    unknown as ComparedAgent;
  const conditions = 'f16 from 19000 to 20000 ft; still air; missions of 3 min';
  expect(endsOf(agent, areOfMissions(conditions))).toBe('low altitude 1, mission flown 2');
  expect(endsOf(agent, areOfMissions('f16; still air'))).toBe('low altitude 1, time limit 2');
});

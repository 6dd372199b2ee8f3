// SPDX-License-Identifier: Apache-2.0
import { afterAll, beforeAll, expect, it, vi } from 'vitest';

// uPlot asks the browser for its pixels when it is loaded.
beforeAll(() => {
  vi.stubGlobal('document', { documentElement: { dataset: { theme: 'light' } } });
  vi.stubGlobal('getComputedStyle', () => ({ getPropertyValue: () => '#000000' }));
  vi.stubGlobal('matchMedia', () => ({ addEventListener: () => undefined }));
});
afterAll(() => vi.unstubAllGlobals());

it('ticks have all their digits, however near each other they are', async () => {
  const { axis, formatted, tickText } = await import('../src/chart');
  const ticks = [149.5, 150, 150.5, 151, 0.1 + 0.2, 20250, 0, -0.5];
  expect(ticks.map(tickText)).toEqual(['149.5', '150', '150.5', '151', '0.3', '20250', '0', '-0.5']);
  expect([1.25e-5, 2e-5, 1234000, 2e6].map(tickText))
    .toEqual(['1.25e-5', '2e-5', '1.234e+6', '2e+6']);
  const values = axis().values as unknown as (plot: null, splits: (number | null)[]) => string[];
  expect(values(null, [100.25, 100.5, null])).toEqual(['100.25', '100.5', '']);
  // Legends are short.
  expect(formatted(149.53)).toBe('150');
});

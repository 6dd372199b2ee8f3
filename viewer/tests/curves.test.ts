// SPDX-License-Identifier: Apache-2.0
import type uPlot from 'uplot';
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';
import { CURVES, drawnOf, endKindsOf, linesOf } from '../src/curves';
import type { ArrayReference } from '../src/pack';
import { colourOf, dashOf, endColourOf } from '../src/palette';
import type { ReportPack, Run } from '../src/report';
import { weightOf } from '../src/series';

// Colours are those of the page's theme.
beforeAll(() => vi.stubGlobal('document', { documentElement: { dataset: { theme: 'light' } } }));
afterAll(() => vi.unstubAllGlobals());

/** Runs by their columns; every two are of one configuration. */
function packOf(runs: Record<string, number[]>[]): ReportPack {
  return {
    document: {
      runs: runs.map((metrics, i) =>
        ({ name: `run ${i}`, repetition: Math.floor(i / 2), metrics, timing: {} })),
    },
    array: (values: ArrayReference) => Float32Array.from(values as unknown as number[]),
  } as unknown as ReportPack;
}

const curveOf = (title: string) => {
  const found = CURVES.find((curve) => curve.title === title);
  if (!found) throw new Error(title);
  return found;
};
const RETURN = curveOf('return of an episode');
const EVALUATION = curveOf('success of the mean action');
const STEPS = { env_steps: [1, 2, 3, 4] };
const NOTHING = { evaluation_success_rate: [NaN, NaN, NaN, NaN] };
/** Two seeds, then two of another configuration; an evaluation is rare, and the first run's are
 * missing. */
const PACK = packOf([
  { ...STEPS, ...NOTHING, return_mean: [0, 8, 0, 8] },
  { ...STEPS, ...NOTHING, return_mean: [4, 12, 4, 12] },
  { ...STEPS, evaluation_success_rate: [NaN, 0, NaN, 1], return_mean: [0, 1, 2, 3] },
  { ...STEPS, evaluation_success_rate: [NaN, 1, NaN, 0.5], return_mean: [1, 2, 3, 4] },
]);
const DEFAULT = weightOf(20);

const legendOf = (series: uPlot.Series, row: number | null) =>
  (series.value as (...parts: unknown[]) => string)(null, null, 0, row);

describe('smoothing', () => {
  it('is of the lines of training, never of evaluations', () => {
    expect(linesOf(EVALUATION, PACK, DEFAULT).map((line) => line.ys)).toEqual([[0, 1], [1, 0.5]]);
    expect(linesOf(RETURN, PACK, DEFAULT)[0].ys[1]).not.toBe(8);
    expect(linesOf(RETURN, PACK, 0)[0].ys).toEqual([0, 8, 0, 8]);
  });
  it('is of every evaluation that there is', () => {
    const columns = CURVES.filter((curve) => !curve.isEvaluation).map(({ of }) => String(of({
      metrics: new Proxy({}, { get: (_, name) => name }), timing: {},
    } as unknown as Run, { array: (name: unknown) => name } as unknown as ReportPack)));
    expect(columns.filter((name) => name.startsWith('evaluation_'))).toEqual([]);
    expect(columns).toContain('return_mean');
  });
  it('changes no number of a legend', () => {
    const drawn = drawnOf(RETURN, linesOf(RETURN, PACK, DEFAULT), false);
    expect(legendOf(drawn.series[0], 1)).toBe('8.000');
    expect(legendOf(drawn.series[0], null)).toBe('–');
    expect(drawn.data[1][1]).not.toBe(8);
    const over = drawnOf(RETURN, linesOf(RETURN, PACK, DEFAULT), true);
    expect(legendOf(over.series[2], 1)).toBe('10.00 (8.000 to 12.00)');
    expect(over.data[3][1]).not.toBe(10);
  });
});

it('an evaluation that is alone is seen, as a point', () => {
  const drawnAs = (title: string, isOverSeeds: boolean) =>
    drawnOf(curveOf(title), linesOf(curveOf(title), PACK, 0), isOverSeeds).series
      .filter((series) => series.class !== 'edge').map(({ points }) => points?.show);
  expect(drawnAs(EVALUATION.title, false)).toEqual([true, true]);
  expect(drawnAs(EVALUATION.title, true)).toEqual([true]);
  expect(drawnAs(RETURN.title, false)).toEqual([false, false, false, false]);
});

it('a single iteration is seen, as a point', () => {
  const lines = linesOf(RETURN, PACK, 0)
    .map((line) => ({ ...line, xs: [line.xs[0]], ys: [line.ys[0]], measured: [line.ys[0]] }));
  expect(drawnOf(RETURN, lines, false).series.map(({ points }) => points?.show))
    .toEqual(lines.map(() => true));
});

describe('a run', () => {
  const coloursOf = (title: string, isOverSeeds: boolean) =>
    drawnOf(curveOf(title), linesOf(curveOf(title), PACK, 0), isOverSeeds).series
      .filter((series) => series.class !== 'edge').map((series) => series.stroke);

  it('has the same colour in every chart', () => {
    expect(coloursOf(RETURN.title, false)).toEqual([0, 1, 2, 3].map(colourOf));
    expect(coloursOf(EVALUATION.title, false)).toEqual([2, 3].map(colourOf));
  });
  it('has that of its configuration where seeds are one line', () => {
    expect(coloursOf(RETURN.title, true)).toEqual([0, 1].map(colourOf));
    expect(coloursOf(EVALUATION.title, true)).toEqual([1].map(colourOf));
  });
});

it('lines of one colour differ by their dashes, means over seeds too', () => {
  const many = packOf(Array.from({ length: 10 }, () => ({ ...STEPS, return_mean: [0, 1, 2, 3] })));
  const lines = linesOf(RETURN, many, 0);
  const looksOf = (isOverSeeds: boolean) => drawnOf(RETURN, lines, isOverSeeds).series
    .filter((series) => series.class !== 'edge')
    .map(({ stroke, dash }) => `${String(stroke)} ${String(dash)}`);
  expect(new Set(looksOf(false)).size).toBe(10);
  expect(new Set(looksOf(true)).size).toBe(5);
  expect(looksOf(true)[4]).toBe(`${colourOf(0)} ${String(dashOf(4))}`);
});

it('kinds of ends have the same order and colour for all runs', () => {
  const runs = packOf([
    { ended_low_speed: [1], ended_target_reached: [0], ended_time_limit: [3] },
    { ended_overload: [1], ended_low_speed: [0], ended_time_limit: [3] },
  ]).document.runs;
  const kinds = endKindsOf(runs);
  expect(kinds.map(({ name }) => name))
    .toEqual(['target reached', 'time limit', 'low speed', 'overload']);
  expect(kinds.map(({ colour }) => colour))
    .toEqual(['target_reached', 'time_limit', 'low_speed', 'overload'].map(endColourOf));
  // Whichever others there are.
  const [alone] = endKindsOf(packOf([{ ended_overload: [1] }]).document.runs);
  expect(alone.colour).toBe(kinds[3].colour);
  expect(endKindsOf([])).toEqual([]);
});

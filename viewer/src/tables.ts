// SPDX-License-Identifier: Apache-2.0
// The tables of a report as CSV, with every number as it was measured.
import type { Comparison, ReportPack } from './report';
import { cellOf, csvOf, quoted } from './save';

/** What tells every number of 32 bits from all others. */
const DIGITS = 9;

/** A row for every iteration of every run: run, seed, then the columns of any of them. */
export function trainingCsv(pack: ReportPack): string {
  const { runs } = pack.document;
  const names = [...new Set(runs.flatMap(({ metrics }) => Object.keys(metrics)))];
  const rows = runs.flatMap((run) => {
    const columns = names.map((name) => (run.metrics[name] ? pack.array(run.metrics[name]) : []));
    const count = Math.max(0, ...columns.map((column) => column.length));
    return Array.from({ length: count }, (_, row) =>
      [quoted(run.name), run.seed, ...columns.map((column) => cellOf(column[row], DIGITS))]);
  });
  return csvOf([['run', 'seed', ...names], ...rows]);
}

/** A row for every agent's value of a quantity, with its 95 % interval, in the unit that the label
 * says. */
export function metricsCsv(comparisons: Comparison[]): string {
  const rows = comparisons.flatMap(({ task, level, conditions, agents, quantities }) =>
    agents.flatMap((agent) => quantities.flatMap((quantity) => {
      const estimate = agent.estimates[quantity.key];
      if (estimate?.value == null) return [];
      const cells = [estimate.value, estimate.low, estimate.high].map((value) =>
        cellOf(value === null ? null : value * quantity.shown_per_unit, DIGITS));
      return [[quoted(task), quoted(level ?? ''), quoted(conditions), quoted(agent.name),
        quantity.key, quoted(quantity.label), ...cells, estimate.count]];
    })));
  return csvOf([['task', 'level', 'conditions', 'agent', 'quantity', 'label', 'value', 'low', 'high',
    'count'], ...rows]);
}

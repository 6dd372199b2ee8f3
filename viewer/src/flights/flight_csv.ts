// SPDX-License-Identifier: Apache-2.0
import { cellOf, csvOf, quoted } from '../save';
import { type FlightRecord, rounded } from './record';

/** Every row of some flights as CSV: agent, episode, time_s, then the columns of any of them. */
export function flightCsv(records: FlightRecord[], agents: string[]): string {
  const names = [...new Set(records.flatMap((record) => record.names))];
  const rows = records.flatMap((record) => {
    const agent = quoted(agents[record.agent]);
    const columns = names.map((name) => (record.has(name) ? record.column(name) : null));
    return Array.from({ length: record.rows }, (_, row) => [agent, record.episode,
      rounded(record.timeOf(row)), ...columns.map((column) => cellOf(column?.[row]))]);
  });
  return csvOf([['agent', 'episode', 'time_s', ...names], ...rows]);
}

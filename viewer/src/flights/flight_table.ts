// SPDX-License-Identifier: Apache-2.0
// The flights of a set as a table, by which the worst one is found.
import { button, el } from '../dom';
import { type Extreme, EXTREMES, extremeOf, type Moment, worstFirst } from './flight_summary';
import type { FlightRecord } from './record';

interface Row {
  record: FlightRecord;
  moments: (Moment | null)[];
}

type Order = (a: Row, b: Row) => number;

interface Column {
  name: string;
  /** What is worst, or first, comes first. */
  order: Order;
  cell: (row: Row) => Node | string;
}

/** Flights without a value come last. */
function byMoment(k: number, { measure }: Extreme): Order {
  const of = ({ moments }: Row) => measure(moments[k]?.value ?? NaN);
  return (a, b) => {
    const [first, second] = [of(a), of(b)];
    if (Number.isNaN(first) || Number.isNaN(second)) {
      return Number(Number.isNaN(first)) - Number(Number.isNaN(second));
    }
    return second - first;
  };
}

/** A press on a number goes to its moment, on an episode to its beginning. */
export class FlightTable {
  /** Closed at first; flights are searched for their peaks when it is opened. */
  readonly element = el('details', { class: 'finder' }, el('summary', {}, 'find a flight'));
  private readonly body = el('tbody');
  private readonly headings: HTMLTableCellElement[];
  private readonly columns: Column[];
  private readonly rows: Row[] = [];

  constructor(
    private readonly records: FlightRecord[], agents: string[],
    private readonly go: (record: FlightRecord, time: number) => void,
  ) {
    this.columns = [
      { name: 'episode', order: (a, b) => a.record.episode - b.record.episode,
        cell: ({ record }) => button(String(record.episode),
          `episode ${record.episode} of ${agents[record.agent]}`, () => this.go(record, 0)) },
      { name: 'agent', order: (a, b) => a.record.agent - b.record.agent,
        cell: ({ record }) => agents[record.agent] },
      { name: 'outcome', order: (a, b) => worstFirst(a.record, b.record),
        cell: ({ record }) => record.outcome() },
      { name: 'targets reached', order: (a, b) => a.record.reached.length - b.record.reached.length,
        cell: ({ record }) => String(record.reached.length) },
      { name: 'return', order: (a, b) => a.record.result - b.record.result,
        cell: ({ record }) => record.result.toFixed(1) },
      ...EXTREMES.map((extreme, k): Column => ({ name: extreme.name, order: byMoment(k, extreme),
        cell: (row) => this.momentCell(row, k, extreme) })),
    ];
    this.headings = this.columns.map(({ name }, k) => el('th', { scope: 'col' },
      button(name, `order by ${name}`, () => this.sort(k))));
    this.element.append(
      el('p', { class: 'hint' }, 'The flights of this page, the worst first. A heading orders them; '
        + 'an episode goes to its flight, a number to its moment.'),
      el('div', { class: 'wide' }, el('table', { class: 'metrics flights' },
        el('thead', {}, el('tr', {}, ...this.headings)), this.body)),
    );
    this.element.addEventListener('toggle', () => this.open());
  }

  private momentCell({ record, moments }: Row, k: number, extreme: Extreme): Node | string {
    const moment = moments[k];
    if (!moment) return '–';
    const text = moment.value.toFixed(extreme.decimals);
    return button(text, `${extreme.name}: ${text} at ${moment.time.toFixed(2)} s`,
      () => this.go(record, moment.time));
  }

  /** Extremes are looked for when they are asked for. */
  private open(): void {
    if (!this.element.open || this.rows.length > 0) return;
    this.rows.push(...this.records.map((record) =>
      ({ record, moments: EXTREMES.map((extreme) => extremeOf(record, extreme)) })));
    this.sort(this.columns.findIndex(({ name }) => name === 'outcome'));
  }

  private sort(chosen: number): void {
    this.headings.forEach((heading, k) => {
      if (k === chosen) heading.setAttribute('aria-sort', 'other');
      else heading.removeAttribute('aria-sort');
    });
    const sorted = [...this.rows].sort(this.columns[chosen].order);
    this.body.replaceChildren(...sorted.map((row) =>
      el('tr', {}, ...this.columns.map(({ cell }) => el('td', {}, cell(row))))));
  }
}

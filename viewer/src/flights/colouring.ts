// SPDX-License-Identifier: Apache-2.0
// How trails can be coloured, and the ramp that says it.
import { el } from '../dom';
import { ramp } from '../palette';
import type { FlightSet } from '../report';
import { niceStep } from './frames';
import type { FlightRecord } from './record';
import type { Colouring } from './trails';

export interface ColourScale {
  name: string;
  low: string;
  high: string;
  share: Colouring;
}

/** Off the target by so many tolerances is as bad as a colour can say. */
const MOST_TOLERANCES = 10;
/** A ramp has about so many readable steps, and its range is at least that share of its numbers. */
const STEPS = 10;
const LEAST_RANGE = 0.01;

/** The range of the numbers among `values` between ends that are quick to read. */
export function readableRange(values: Iterable<number>): [low: number, high: number] {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) return [0, 1];
  const least = LEAST_RANGE * Math.max(Math.abs(high), 1);
  const step = niceStep(Math.max(high - low, least) / STEPS);
  const isOne = low === high;
  const ends = [Math.floor(low / step) - Number(isOne), Math.ceil(high / step) + Number(isOne)];
  return ends.map((end) => Number((end * step).toPrecision(6))) as [number, number];
}

function* valuesOf(records: FlightRecord[], column: string): Iterable<number> {
  for (const record of records) if (record.has(column)) yield* record.column(column);
}

/** By a column, over its range among all records. */
function columnScale(
  name: string, column: string, unit: string, records: FlightRecord[],
): ColourScale {
  const [low, high] = readableRange(valuesOf(records, column));
  return { name, low: `${low} ${unit}`, high: `${high} ${unit}`,
    share: (record, row) => known((record.column(column)[row] - low) / (high - low)) };
}

/** A row without a number has its agent's colour. */
function known(share: number): number | null {
  return Number.isFinite(share) ? share : null;
}

/** Those of a set whose flights are `records`. */
export function colourScales(set: FlightSet, records: FlightRecord[]): ColourScale[] {
  return [
    { name: 'agent', low: '', high: '', share: () => null },
    columnScale('load factor', 'load_factor_g', 'g', records),
    { name: 'error', low: `${MOST_TOLERANCES} tolerances`, high: 'on target',
      share: (record, row) => {
        const worst = Math.max(...set.targets.map(({ column, tolerance }) =>
          Math.abs(record.column(`error_${column}`)[row]) / tolerance));
        return known(1 - worst / MOST_TOLERANCES);
      } },
    columnScale('true airspeed', 'true_airspeed_fps', 'ft/s', records),
  ];
}

/** The scale's ramp between its ends; nothing of one without. */
export function rampOf(scale: ColourScale): HTMLElement[] {
  if (!scale.low) return [];
  const bar = el('span', { class: 'ramp' });
  const stops = [0, 0.25, 0.5, 0.75, 1].map((share) =>
    `rgb(${ramp(share).map((part) => Math.round(255 * part)).join(',')})`);
  bar.style.background = `linear-gradient(to right, ${stops.join(',')})`;
  return [el('span', { class: 'key' }, `${scale.low} `, bar, ` ${scale.high}`)];
}

// SPDX-License-Identifier: Apache-2.0
// How trails can be coloured, and the ramp that says it.
import { el } from '../dom';
import { ramp } from '../palette';
import type { FlightSet } from '../report';
import type { Colouring } from './trails';

export interface ColourScale {
  name: string;
  low: string;
  high: string;
  share: Colouring;
}

/** Off the target by so many tolerances is as bad as a colour can say. */
const MOST_TOLERANCES = 10;

export function colourScales(set: FlightSet): ColourScale[] {
  return [
    { name: 'agent', low: '', high: '', share: () => null },
    { name: 'load factor', low: '0 g', high: '9 g',
      share: (record, row) => record.column('load_factor_g')[row] / 9 },
    { name: 'error', low: `${MOST_TOLERANCES} tolerances`, high: 'on target',
      share: (record, row) => {
        const worst = Math.max(...set.targets.map(({ column, tolerance }) =>
          Math.abs(record.column(`error_${column}`)[row]) / tolerance));
        return 1 - worst / MOST_TOLERANCES;
      } },
    { name: 'true airspeed', low: '400 ft/s', high: '1400 ft/s',
      share: (record, row) => (record.column('true_airspeed_fps')[row] - 400) / 1000 },
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

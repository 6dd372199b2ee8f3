// SPDX-License-Identifier: Apache-2.0
// The table of metrics: policies beside the autopilots, on the same episodes.
import { el, tick } from './dom';
import type { Comparison, Estimate, Quantity, ReportPack } from './report';

function number(quantity: Quantity, value: number): string {
  const text = (value * quantity.shown_per_unit).toFixed(quantity.decimals);
  return Number(text) === 0 ? text.replace('-', '') : text;
}

/** "15.83 ± 0.31"; where the interval lies to one side "100.0 (99.6, 100.0)". */
export function formatEstimate(quantity: Quantity, estimate: Estimate | undefined): string {
  if (!estimate || estimate.value === null) return '–';
  const value = number(quantity, estimate.value);
  if (estimate.low === null || estimate.high === null) return value;
  const below = estimate.value - estimate.low;
  const above = estimate.high - estimate.value;
  if (Math.abs(above - below) <= 0.02 * (above + below)) {
    return `${value} ± ${number(quantity, (above + below) / 2)}`;
  }
  return `${value} (${number(quantity, estimate.low)}, ${number(quantity, estimate.high)})`;
}

/** Whether the intervals of an agent and of the first lie apart, and the cells show it. */
export function liesApart(
  quantity: Quantity, first: Estimate | undefined, other: Estimate | undefined,
): boolean {
  if (first?.low == null || first.high == null || other?.low == null || other.high == null) {
    return false;
  }
  if (formatEstimate(quantity, first) === formatEstimate(quantity, other)) return false;
  return other.low > first.high || other.high < first.low;
}

function rowOf(comparison: Comparison, quantity: Quantity): HTMLTableRowElement {
  const first = comparison.agents[0].estimates[quantity.key];
  const cells = comparison.agents.map((agent, i) => {
    const estimate = agent.estimates[quantity.key];
    const apart = i > 0 && liesApart(quantity, first, estimate);
    return el('td', { class: apart ? 'apart' : '' }, formatEstimate(quantity, estimate));
  });
  return el('tr', {}, el('th', { scope: 'row' }, nameOf(quantity)), ...cells);
}

/** "|AOA| alpha, deg", "variation, 1/s (throttle)". */
export function nameOf(quantity: Quantity): string {
  if (!quantity.symbol) return quantity.label;
  return quantity.section ? `${quantity.label} (${quantity.symbol})`
    : `${quantity.symbol}  ${quantity.label}`;
}

function endsRow(comparison: Comparison): HTMLTableRowElement {
  const cells = comparison.agents.map((agent) => {
    const ends = Object.entries(agent.terminations).filter(([, count]) => count > 0);
    return el('td', {}, ends.map(([name, n]) => `${name.replace(/_/g, ' ')} ${n}`).join(', '));
  });
  return el('tr', {}, el('th', { scope: 'row' }, 'ended by'), ...cells);
}

function tableOf(comparison: Comparison, isWhole: boolean): HTMLElement {
  const body = el('tbody');
  let section = '';
  for (const quantity of comparison.quantities) {
    if (!isWhole && !quantity.is_headline) continue;
    if (comparison.agents.every((agent) => agent.estimates[quantity.key]?.value == null)) continue;
    if (quantity.section !== section && quantity.section) {
      const span = comparison.agents.length + 1;
      body.append(el('tr', {}, el('th', { colspan: span, class: 'section' }, quantity.section)));
    }
    section = quantity.section;
    body.append(rowOf(comparison, quantity));
  }
  body.append(endsRow(comparison));
  const names = comparison.agents.map((agent) => el('th', { scope: 'col' }, agent.name));
  return el('div', { class: 'wide' }, el('table', { class: 'metrics' },
    el('thead', {}, el('tr', {}, el('td'), ...names)), body));
}

function titleOf({ task, level, conditions }: Comparison): string {
  return `${task}${level ? `, ${level}` : ''}: ${conditions}`;
}

export function showMetrics(place: HTMLElement, pack: ReportPack): () => void {
  const tables = el('div');
  let isWhole = true;
  const draw = () => tables.replaceChildren(...pack.document.comparisons.flatMap((comparison) => [
    el('h2', {}, titleOf(comparison)),
    el('p', { class: 'hint' }, `The same ${comparison.episodes} episodes for all (seed `
      + `${comparison.seed}), policies with their mean action; values with 95 % intervals. `
      + 'Bold: the interval lies apart from that of the first column.'),
    tableOf(comparison, isWhole),
  ]));
  place.append(el('div', { class: 'controls' }, tick('all quantities', isWhole, (isOn) => {
    isWhole = isOn;
    draw();
  })), tables);
  draw();
  return () => undefined;
}

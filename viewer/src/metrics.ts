// SPDX-License-Identifier: Apache-2.0
// The table of metrics: policies beside the autopilots, on the same episodes.
import { button, choice, el, tick } from './dom';
import { type Difference, differenceOf, isBetter, referencesOf, sideOfZero } from './paired';
import {
  areOfMissions, type ComparedAgent, type Comparison, type Estimate, nameOfEnd, type Quantity,
  type ReportPack,
} from './report';
import { saveTable } from './save';
import type { Shown } from './shown';
import { metricsCsv } from './tables';

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

/** The same with its sign: "+0.42 ± 0.05". */
export function formatDifference(quantity: Quantity, difference: Estimate | undefined): string {
  const text = formatEstimate(quantity, difference);
  return parseFloat(text) > 0 ? `+${text}` : text;
}

/** Whether an agent's value is bold beside the reference's: it is better, and the cells show it. */
export function isMarked(
  quantity: Quantity, reference: Estimate | undefined, value: Estimate | undefined,
  difference: Difference | undefined,
): boolean {
  if (parseFloat(formatEstimate(quantity, difference)) === 0) return false;
  if (formatEstimate(quantity, reference) === formatEstimate(quantity, value)) return false;
  return isBetter(quantity, difference);
}

/** "|AOA| alpha, deg", "variation, 1/s (throttle)". */
export function nameOf(quantity: Quantity): string {
  if (!quantity.symbol) return quantity.label;
  return quantity.section ? `${quantity.label} (${quantity.symbol})`
    : `${quantity.symbol}  ${quantity.label}`;
}

/** "target reached 98, time limit 2". */
export function endsOf({ terminations }: ComparedAgent, isMission: boolean): string {
  return Object.entries(terminations).filter(([, count]) => count > 0)
    .map(([end, count]) => `${nameOfEnd(end, isMission)} ${count}`).join(', ');
}

function betterSide({ better }: Quantity): HTMLElement | null {
  if (!better) return null;
  return el('small', { title: `${better} is better` }, better === 'higher' ? ' ↑' : ' ↓');
}

/** A comparison's table; where `reference` is an agent, with the differences of the others. */
class MetricsTable {
  constructor(
    private readonly comparison: Comparison, private readonly reference: number | undefined,
    private readonly isWhole: boolean,
  ) {}

  element(): HTMLElement {
    return el('div', { class: 'wide' },
      el('table', { class: 'metrics' }, el('thead', {}, ...this.headings()), this.body()));
  }

  private columnsOf(agent: number): number {
    return this.reference === undefined || agent === this.reference ? 1 : 2;
  }

  private headings(): HTMLTableRowElement[] {
    const { agents } = this.comparison;
    const names = agents.map(({ name }, i) =>
      el('th', { scope: 'colgroup', colspan: this.columnsOf(i) }, name));
    const first = el('tr', {}, el('td'), ...names);
    if (this.reference === undefined) return [first];
    const parts = agents.flatMap((_, i) => (this.columnsOf(i) === 1 ? ['reference']
      : ['value', 'difference']));
    return [first, el('tr', { class: 'parts' }, el('td'),
      ...parts.map((part) => el('th', { scope: 'col' }, part)))];
  }

  private body(): HTMLElement {
    const { agents, quantities } = this.comparison;
    const body = el('tbody');
    let section = '';
    for (const quantity of quantities) {
      if (!this.isWhole && !quantity.is_headline) continue;
      if (agents.every((agent) => agent.estimates[quantity.key]?.value == null)) continue;
      if (quantity.section !== section && quantity.section) {
        const span = agents.reduce((sum, _, i) => sum + this.columnsOf(i), 1);
        body.append(el('tr', {}, el('th', { colspan: span, class: 'section' }, quantity.section)));
      }
      section = quantity.section;
      body.append(this.row(quantity));
    }
    body.append(this.endsRow());
    return body;
  }

  private row(quantity: Quantity): HTMLTableRowElement {
    const cells = this.comparison.agents.flatMap((_, i) => this.cells(quantity, i));
    return el('tr', {},
      el('th', { scope: 'row' }, nameOf(quantity), betterSide(quantity)), ...cells);
  }

  private cells(quantity: Quantity, agent: number): HTMLTableCellElement[] {
    const { agents } = this.comparison;
    const estimate = agents[agent].estimates[quantity.key];
    const value = formatEstimate(quantity, estimate);
    if (this.reference === undefined || agent === this.reference) return [el('td', {}, value)];
    const difference = differenceOf(this.comparison, agent, this.reference, quantity.key);
    const reference = agents[this.reference].estimates[quantity.key];
    const isBold = isMarked(quantity, reference, estimate, difference);
    return [
      el('td', { class: isBold ? 'better' : '' }, value,
        isBold ? el('span', { class: 'unseen' }, ' better') : null),
      el('td', {
        class: sideOfZero(difference) === 0 ? 'difference' : 'difference apart',
        title: difference && difference.count > 0 ? `${difference.count} episodes` : undefined,
      }, formatDifference(quantity, difference)),
    ];
  }

  private endsRow(): HTMLTableRowElement {
    const isMission = areOfMissions(this.comparison.conditions);
    const cells = this.comparison.agents.map((agent, i) =>
      el('td', { colspan: this.columnsOf(i) }, endsOf(agent, isMission)));
    return el('tr', { class: 'ends' }, el('th', { scope: 'row' }, 'ended by'), ...cells);
  }
}

function titleOf({ task, level, conditions }: Comparison): string {
  return `${task}${level ? `, ${level}` : ''}: ${conditions}`;
}

function explanation({ agents, episodes, seed }: Comparison, reference?: number): HTMLElement {
  return el('p', { class: 'hint' }, `The same ${episodes} episodes for all (seed ${seed}), `
    + 'policies with their mean action; 95 % intervals.',
    reference === undefined ? null : ` Differences are paired, an agent's value less that of `
      + `${agents[reference].name} in the same episode: a value is bold only where it is better `
      + '(↑ higher, ↓ lower) and the interval of its difference leaves out 0, and of success McNemar\'s test '
        + 'has p < 0.05, too (others are grey).');
}

/** What is chosen; it outlives the view. */
const chosen = { isWhole: true, references: new Map<string, string>() };

function partsOf(comparison: Comparison, redraw: () => void): (HTMLElement | null)[] {
  const { agents } = comparison;
  const title = titleOf(comparison);
  const references = referencesOf(comparison);
  const reference = references.find((i) => agents[i].name === chosen.references.get(title))
    ?? references[0];
  const choose = references.length < 2 ? null : el('div', { class: 'controls' },
    choice('differences from', references.map((i) => [String(i), agents[i].name]),
      String(reference), (value) => {
        chosen.references.set(title, agents[Number(value)].name);
        redraw();
      }));
  return [el('h2', {}, title), explanation(comparison, reference), choose,
    new MetricsTable(comparison, reference, chosen.isWhole).element()];
}

export function showMetrics(place: HTMLElement, pack: ReportPack): Shown {
  const tables = el('div');
  let { comparisons } = pack.document;
  const draw = () => tables.replaceChildren(...comparisons
    .flatMap((comparison) => partsOf(comparison, draw)).filter((part) => part !== null));
  place.append(el('div', { class: 'controls' }, tick('all quantities', chosen.isWhole, (isOn) => {
    chosen.isWhole = isOn;
    draw();
  }), button('save data', 'all values with their intervals, as CSV',
    () => saveTable('metrics.csv', metricsCsv(comparisons)))), tables);
  draw();
  return {
    stop: () => undefined,
    recolour: () => undefined,
    renew: (fresh) => {
      const isOther = JSON.stringify(fresh.document.comparisons) !== JSON.stringify(comparisons);
      comparisons = fresh.document.comparisons;
      if (isOther) draw();
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
// Paired differences between the agents of a comparison, as skein computes them
// (PairedDifferences in src/evaluation/comparison.h of Skein).
import type { Comparison, Estimate, Quantity } from './report';

/** The largest p-value that is a difference. */
const SIGNIFICANT = 0.05;

/** A paired difference; that of success has the p-value of McNemar's test. */
export interface Difference extends Estimate {
  p_value?: number;
}

function reversed({ value, low, high, ...rest }: Difference): Difference {
  const less = (x: number | null) => (x === null ? null : -x);
  return { value: less(value), low: less(high), high: less(low), ...rest };
}

/**
 * The agent's value of a quantity less the reference's, over the episodes of which both have one;
 * undefined where the data do not have it, and of an agent and itself.
 */
export function differenceOf(
  comparison: Comparison, agent: number, reference: number, key: string,
): Difference | undefined {
  const [earlier, later] = [Math.min(agent, reference), Math.max(agent, reference)];
  if (earlier === later) return undefined;
  const { against, against_first: first } = comparison.agents[later];
  const paired = against?.[earlier] ?? (earlier === 0 ? first : undefined);
  const estimate = paired?.estimates[key];
  if (!paired || !estimate) return undefined;
  const difference = key === 'success_rate'
    ? { ...estimate, p_value: paired.success_p_value } : estimate;
  return agent === later ? difference : reversed(difference);
}

/** The agents from which the data have the differences of all others. */
export function referencesOf(comparison: Comparison): number[] {
  const { agents, quantities } = comparison;
  const isKnown = (agent: number, reference: number) => agent === reference
    || quantities.some(({ key }) => differenceOf(comparison, agent, reference, key) !== undefined);
  return [...agents.keys()].filter((reference) =>
    agents.length > 1 && [...agents.keys()].every((agent) => isKnown(agent, reference)));
}

/**
 * 1 or -1 where the whole interval of a difference lies above or below zero, else 0; 0, too, where
 * McNemar's test, which is stricter of few episodes, sees none.
 */
export function sideOfZero(difference: Difference | undefined): -1 | 0 | 1 {
  if (difference?.low == null || difference.high == null) return 0;
  if ((difference.p_value ?? 0) >= SIGNIFICANT) return 0;
  if (difference.low > 0) return 1;
  return difference.high < 0 ? -1 : 0;
}

/** Whether a difference is one to the better, and not of chance (sideOfZero). */
export function isBetter(quantity: Quantity, difference: Difference | undefined): boolean {
  if (!quantity.better) return false;
  return sideOfZero(difference) === (quantity.better === 'higher' ? 1 : -1);
}

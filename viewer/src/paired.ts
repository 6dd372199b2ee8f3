// SPDX-License-Identifier: Apache-2.0
// Paired differences between the agents of a comparison, as skein computes them
// (PairedDifferences in src/evaluation/comparison.h of Skein).
import type { Comparison, Estimate, Quantity } from './report';

function reversed({ value, low, high, count }: Estimate): Estimate {
  const less = (x: number | null) => (x === null ? null : -x);
  return { value: less(value), low: less(high), high: less(low), count };
}

/**
 * The agent's value of a quantity less the reference's, over the episodes of which both have one;
 * undefined where the data do not have it, and of an agent and itself.
 */
export function differenceOf(
  comparison: Comparison, agent: number, reference: number, key: string,
): Estimate | undefined {
  const [earlier, later] = [Math.min(agent, reference), Math.max(agent, reference)];
  if (earlier === later) return undefined;
  const { against, against_first: first } = comparison.agents[later];
  const difference = (against?.[earlier] ?? (earlier === 0 ? first : undefined))?.estimates[key];
  return difference && (agent === later ? difference : reversed(difference));
}

/** The agents from which the data have the differences of all others. */
export function referencesOf(comparison: Comparison): number[] {
  const { agents, quantities } = comparison;
  const isKnown = (agent: number, reference: number) => agent === reference
    || quantities.some(({ key }) => differenceOf(comparison, agent, reference, key) !== undefined);
  return [...agents.keys()].filter((reference) =>
    agents.length > 1 && [...agents.keys()].every((agent) => isKnown(agent, reference)));
}

/** 1 or -1 where the whole interval of a difference lies above or below zero, else 0. */
export function sideOfZero(difference: Estimate | undefined): -1 | 0 | 1 {
  if (difference?.low == null || difference.high == null) return 0;
  if (difference.low > 0) return 1;
  return difference.high < 0 ? -1 : 0;
}

/** Whether a difference is one to the better, and its interval leaves out zero. */
export function isBetter(quantity: Quantity, difference: Estimate | undefined): boolean {
  if (!quantity.better) return false;
  return sideOfZero(difference) === (quantity.better === 'higher' ? 1 : -1);
}

// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { colourOf, dashOf, dashStyleOf, endColourOf, swatchOf } from '../src/palette';
import { contrast, leastDifference } from './colour_vision';

/** So far apart, ΔE*ab, are lines, which are thin; areas are larger, and have an edge between them. */
const APART = 30;
const AREAS_APART = 20;
/** Of graphics from their ground (WCAG 2.1, 1.4.11). */
const LEAST_CONTRAST = 3;
const COLOURS = 4;
const ENDS = ['target_reached', 'time_limit', 'low_altitude', 'overload', 'low_speed', 'high_speed',
  'extreme_state', 'non_finite'];

afterEach(() => vi.unstubAllGlobals());

function pairsOf(colours: string[]): [string, string][] {
  return colours.flatMap((a, i) => colours.slice(i + 1).map((b): [string, string] => [a, b]));
}

describe.each(['light', 'dark'])('lines on a %s ground', (theme) => {
  const coloursOf = (count: number) => {
    vi.stubGlobal('document', { documentElement: { dataset: { theme } } });
    return Array.from({ length: count }, (_, i) => colourOf(i));
  };
  it('are told apart with any colour vision', () => {
    for (const [a, b] of pairsOf(coloursOf(COLOURS))) {
      expect(leastDifference(a, b), `${a} ${b}`).toBeGreaterThan(APART);
    }
  });
  it('stand out from it', () => {
    const style = readFileSync(join(__dirname, '../src/style.css'), 'utf8');
    const grounds = [...style.matchAll(/--ground: (#[0-9a-f]{6})/g)].map(([, ground]) => ground);
    const ground = theme === 'light' ? grounds[0] : grounds[1];
    for (const colour of coloursOf(COLOURS)) {
      expect(contrast(colour, ground), `${colour} on ${ground}`).toBeGreaterThan(LEAST_CONTRAST);
    }
  });
  it('are 16 by their colours and dashes, and so are their keys', () => {
    const looks = coloursOf(16).map((colour, i) => `${colour} ${dashOf(i)}`);
    expect(new Set(looks).size).toBe(16);
    const keys = coloursOf(16).map((colour, i) => `${colour} ${dashStyleOf(dashOf(i))}`);
    expect(new Set(keys).size).toBe(16);
    expect(new Set(coloursOf(16).map((_, i) => swatchOf(i))).size).toBe(16);
    expect([0, 3].map(dashOf)).toEqual([[], []]);
    expect(dashStyleOf(undefined)).toBe('solid');
  });
});

describe('areas of how episodes end', () => {
  it('are told apart with any colour vision', () => {
    for (const [a, b] of pairsOf(ENDS.map(endColourOf))) {
      expect(leastDifference(a, b), `${a} ${b}`).toBeGreaterThan(AREAS_APART);
    }
  });
  it('are blue of a target, grey of a time limit, and of nothing else', () => {
    const [target, limit, ...losses] = ENDS.map(endColourOf)
      .map((colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16)));
    expect(target[2]).toBeGreaterThan(Math.max(target[0], target[1]));
    expect(new Set(limit).size).toBe(1);
    for (const [red, green, blue] of losses) {
      expect(red).toBeGreaterThanOrEqual(blue);
      expect(Math.max(red, green, blue) - Math.min(red, green, blue)).toBeGreaterThan(30);
    }
  });
});

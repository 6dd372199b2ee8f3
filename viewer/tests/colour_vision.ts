// SPDX-License-Identifier: Apache-2.0
// How far apart colours are for people with any colour vision.

/** Linear red, green and blue as protanopes and deuteranopes see them: Machado, Oliveira and
 * Fernandes 2009, table 1, severity 1. */
const VISIONS = {
  usual: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protan: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998]],
  deutan: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881]],
};

type Three = [number, number, number];

/** The shares of "#rrggbb" that are linear in light (IEC 61966-2-1). */
function linear(colour: string): Three {
  return [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16) / 255)
    .map((share) => (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4)) as Three;
}

function seen(colour: string, vision: number[][]): Three {
  const light = linear(colour);
  return vision.map((row) => row.reduce((sum, weight, i) => sum + weight * light[i], 0))
    .map((share) => Math.min(Math.max(share, 0), 1)) as Three;
}

/** CIE 1976 L*a*b* of a white of D65. */
function lab([r, g, b]: Three): Three {
  const f = (t: number) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116);
  const x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const y = f(0.2126729 * r + 0.7151522 * g + 0.072175 * b);
  const z = f((0.0193339 * r + 0.119192 * g + 0.9503041 * b) / 1.08883);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** The least difference of two colours, CIE 1976 ΔE*ab, that any of the visions has of them. */
export function leastDifference(a: string, b: string): number {
  return Math.min(...Object.values(VISIONS).map((vision) => {
    const [first, second] = [lab(seen(a, vision)), lab(seen(b, vision))];
    return Math.hypot(...first.map((part, i) => part - second[i]));
  }));
}

/** Of two colours, 1 to 21 (WCAG 2.1). */
export function contrast(a: string, b: string): number {
  const [low, high] = [a, b].map(linear)
    .map(([r, g, blue]) => 0.2126 * r + 0.7152 * g + 0.0722 * blue).sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

// SPDX-License-Identifier: Apache-2.0
// Colours that people with any colour vision tell apart (Okabe and Ito 2008), in shades that keep
// their contrast on light and on dark grounds.

const LIGHT = ['#0072b2', '#d55e00', '#00795a', '#a8447f', '#8a6a00', '#3b82a8', '#555555', '#7a3e9d'];
const DARK = ['#56b4e9', '#ff8c42', '#2fd6a3', '#e58fc0', '#e6c229', '#8fd3ff', '#b8b8b8', '#c79bf2'];
/** Lines differ by these too. */
const DASHES = [[], [8, 4], [2, 3], [8, 3, 2, 3]];

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  if (chosen) return chosen === 'dark';
  return matchMedia('(prefers-color-scheme: dark)').matches;
}

export function colourOf(index: number): string {
  const colours = isDark() ? DARK : LIGHT;
  return colours[index % colours.length];
}

export function dashOf(index: number): number[] {
  return DASHES[index % DASHES.length];
}

/** `colour`, "#rrggbb", let through. */
export function faded(colour: string, opacity: number): string {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return `rgba(${r},${g},${b},${opacity})`;
}

/** What the style sheet calls `name`. */
export function styleColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The ramp cividis, which reads the same with any colour vision, by a few of its points. */
const RAMP = [
  [0, 34, 78], [42, 63, 109], [87, 92, 109], [124, 123, 120], [165, 156, 116], [210, 192, 96],
  [255, 234, 70],
];

/**
 * A colour of the ramp, 0 to 1, as shares of red, green and blue: of the part of it that stands out
 * from the ground.
 */
export function ramp(share: number): [number, number, number] {
  const inside = Math.min(Math.max(share, 0), 1);
  const place = (isDark() ? 0.28 + 0.72 * inside : 0.94 * inside) * (RAMP.length - 1);
  const left = Math.min(Math.floor(place), RAMP.length - 2);
  const rest = place - left;
  const mix = (i: number) => (RAMP[left][i] * (1 - rest) + RAMP[left + 1][i] * rest) / 255;
  return [mix(0), mix(1), mix(2)];
}

// SPDX-License-Identifier: Apache-2.0
// Colours of lines, areas and ramps. Four colours are as many as differ clearly for protanopes and
// deuteranopes, too, and stand out from the ground; tests/palette.test.ts says by how much. More
// lines differ by their dashes.

const LIGHT = ['#0072b2', '#d55e00', '#009e73', '#59124a'];
const DARK = ['#56b4e9', '#ff8c42', '#6df2c6', '#3071f2'];
const DASHES = [[], [8, 4], [2, 3], [8, 3, 2, 3]];
/** How the edge of a legend's mark shows each of these. */
const DASH_STYLES = ['solid', 'dashed', 'dotted', 'double'];

/** Of areas, by how episodes end (kTerminationNames in envs/tasks/termination.h of Skein): losses
 * are warm. They are the same on both grounds, as areas touch each other more than the ground. */
const ENDS: Record<string, string> = {
  target_reached: '#0072b2', time_limit: '#9a9a9a', low_altitude: '#b22400', overload: '#ffd426',
  low_speed: '#4c2640', high_speed: '#ffb2ff', extreme_state: '#e67300', non_finite: '#e6d8a1',
};
const OTHER_END = '#000000';

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  if (chosen) return chosen === 'dark';
  return matchMedia('(prefers-color-scheme: dark)').matches;
}

/** Of the line of this index, which shares it with every fourth one. */
export function colourOf(index: number): string {
  const colours = isDark() ? DARK : LIGHT;
  return colours[index % colours.length];
}

function dashIndex(index: number): number {
  return Math.floor(index / LIGHT.length) % DASHES.length;
}

/** What tells the line of this index from those of its colour: lengths of strokes and gaps. */
export function dashOf(index: number): number[] {
  return DASHES[dashIndex(index)];
}

/** The style of a border that stands for a line with these dashes. */
export function dashStyleOf(dash: number[] | undefined): string {
  return DASH_STYLES[Math.max(DASHES.findIndex((known) => String(known) === String(dash)), 0)];
}

/** A background that shows the line of this index: its colour, with the gaps of its dashes. */
export function swatchOf(index: number): string {
  const colour = colourOf(index);
  const dash = dashOf(index);
  if (dash.length === 0) return colour;
  let at = 0;
  const stops = dash.map((length, k) => {
    const from = at;
    at += length;
    return `${k % 2 === 0 ? colour : 'transparent'} ${from}px ${at}px`;
  });
  return `repeating-linear-gradient(to right, ${stops.join(', ')})`;
}

/** Of the area of an end, "low_altitude". */
export function endColourOf(end: string): string {
  return ENDS[end] ?? OTHER_END;
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

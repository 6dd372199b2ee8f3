// SPDX-License-Identifier: Apache-2.0
// One window onto flights: a canvas, and over it what the followed aircraft does.
import { WebGLRenderer } from 'three';
import { el } from '../dom';
import { colourOf } from '../palette';
import type { FlightSet, Target } from '../report';
import { FlightScene, MANY } from './scene';
import type { FlightRecord } from './record';
import { reading, titleOf } from './strip_list';

const READINGS: [name: string, column: string, unit: string, decimals: number][] = [
  ['alt', 'altitude_ft', 'ft', 0], ['TAS', 'true_airspeed_fps', 'ft/s', 0], ['M', 'mach', '', 2],
  ['hdg', 'yaw_deg', '°', 0], ['nz', 'load_factor_g', 'g', 1], ['α', 'alpha_deg', '°', 1],
  ['β', 'beta_deg', '°', 1], ['roll', 'roll_deg', '°', 0], ['pitch', 'pitch_deg', '°', 0],
  ['p', 'p_deg_s', '°/s', 0],
];
const ACTIONS: [name: string, column: string][] = [
  ['pitch', 'action_pitch'], ['roll', 'action_roll'], ['yaw', 'action_yaw'],
  ['throttle', 'action_throttle'],
];

/** A yaw as the heading, from 0 to below 360, also once it is rounded to what is shown. */
function headingOf(yaw: number, shown: (degrees: number) => string): string {
  return shown(Number(shown(yaw + 360)) % 360);
}

export function readingsOf(record: FlightRecord, time: number): string {
  return READINGS.map(([name, column, unit, decimals]) => {
    const value = record.value(column, time);
    if (!Number.isFinite(value)) return `${name} –`;
    const shown = (number: number) => number.toFixed(decimals);
    let text = column === 'yaw_deg' ? headingOf(value, shown) : shown(value);
    // Not -0.
    if (Number(text) === 0) text = shown(0);
    return `${name} ${text}${unit && unit !== '°' ? ` ${unit}` : unit}`;
  }).join('   ');
}

/** "actions  pitch 0.98   roll -0.10   throttle 1.00", from -1 to 1. */
export function actionsOf(record: FlightRecord, time: number): string {
  const there = ACTIONS.filter(([, column]) => record.has(column));
  if (there.length === 0) return '';
  return `actions  ${there.map(([name, column]) =>
    `${name} ${reading(column, record.value(column, time))}`).join('   ')}`;
}

/** "altitude, ft: 988 off 20000 ± 100" of each target, with a tick where it is within; a yaw as the
 * heading, from 0 to below 360. */
export function errorsOf(record: FlightRecord, targets: Target[], time: number): string[] {
  return targets.filter(({ column }) => record.has(`error_${column}`)).map(({ column, tolerance }) => {
    const error = record.value(`error_${column}`, time);
    const target = record.value(`target_${column}`, time);
    const isYaw = column === 'yaw_deg';
    const shown = (number: number) => reading(column, number);
    const aim = isYaw ? headingOf(target, shown) : shown(target);
    const name = isYaw ? 'heading, deg' : titleOf(column);
    const off = `${name}: ${shown(error)} off ${aim}`;
    if (!(tolerance > 0)) return off;
    const within = Math.abs(error) <= tolerance ? ' ✓' : '';
    return `${off} ± ${Number(tolerance.toPrecision(3))}${within}`;
  });
}

/** "target 2 of 5 (1 reached)" of a mission. */
export function targetsOf(record: FlightRecord, time: number): string {
  const count = record.newTargets.length + 1;
  if (count === 1) return '';
  const all = Array.from({ length: count }, (_, target) => record.isReached(target, time));
  const reached = all.filter(Boolean).length;
  return `   target ${record.targetAt(time) + 1} of ${count} (${reached} reached)`;
}

/** Whether what draws is a program on the processor. */
function isDrawnBySoftware(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? String(context?.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** None where the browser has no WebGL: readings and charts then show the flights alone. Of many
 * aircraft a processor smooths no edges, which takes it half of the time. */
function rendererOn(canvas: HTMLCanvasElement, isMany: boolean): WebGLRenderer | null {
  try {
    return new WebGLRenderer({ canvas, antialias: !isMany || !isDrawnBySoftware() });
  } catch {
    return null;
  }
}

export class Pane {
  readonly element: HTMLElement;
  readonly scene: FlightScene;
  readonly canvas = el('canvas', { tabindex: 0, role: 'img', 'aria-label': 'flights in space' });
  private readonly renderer: WebGLRenderer | null;
  private readonly readings = el('output', { class: 'readings', 'aria-live': 'off' });
  private readonly agent = el('strong');
  private readonly observer: ResizeObserver;

  constructor(
    records: FlightRecord[], private readonly set: FlightSet, followed: number,
    private readonly changed: () => void,
  ) {
    this.renderer = rendererOn(this.canvas, records.length > MANY);
    this.renderer?.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new FlightScene(records, set, this.canvas, followed);
    const { spacingFt, altitudeFt } = this.scene.ground;
    this.element = el('div', { class: 'pane' }, this.canvas,
      el('div', { class: 'hud' }, this.agent, this.readings),
      el('div', { class: 'scale' },
        this.renderer
          ? `a square: ${spacingFt.toLocaleString('en')} ft, at ${altitudeFt.toLocaleString('en')} ft`
          : 'This browser has no WebGL, so flights are not drawn in space; the charts show them.'));
    this.observer = new ResizeObserver(() => this.fit());
    this.observer.observe(this.element);
  }

  fit(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer?.setSize(clientWidth, clientHeight, false);
    this.scene.cameras.reshape(clientWidth / clientHeight);
    this.changed();
  }

  /** Who is followed. */
  get title(): string {
    return this.set.agents[this.scene.records[this.scene.followed].agent];
  }

  show(time: number, trail: number, seconds: number): void {
    this.scene.update(time, trail, seconds);
    if (this.renderer) this.scene.render(this.renderer);
  }

  /** What the followed aircraft does, in words. */
  read(time: number): void {
    const record = this.scene.records[this.scene.followed];
    this.agent.textContent = this.title;
    this.agent.style.color = colourOf(record.agent);
    const isOver = time >= record.duration;
    const state = readingsOf(record, time) + targetsOf(record, time)
      + (isOver ? `   ended: ${record.end}` : '');
    this.readings.textContent = [state, errorsOf(record, this.set.targets, time).join('   '),
      actionsOf(record, time)].filter((line) => line !== '').join('\n');
  }

  /** The view as it is: to be read before anything else is drawn. */
  picture(): HTMLCanvasElement | null {
    if (!this.renderer) return null;
    this.scene.render(this.renderer);
    return this.canvas;
  }

  dispose(): void {
    this.observer.disconnect();
    this.scene.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
  }
}

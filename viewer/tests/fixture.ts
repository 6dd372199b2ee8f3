// SPDX-License-Identifier: Apache-2.0
// A report made by hand: packed by the rules that skein's packer follows, written here again.
import { deflateSync } from 'node:zlib';
import type { ArrayReference } from '../src/pack';
import type { Comparison, Estimate, Quantity, ReportDocument } from '../src/report';

export class Packer {
  private readonly chunks: Buffer[] = [];
  private offset = 0;

  private add(bytes: Buffer): number {
    const at = this.offset;
    const padding = Buffer.alloc((8 - (bytes.length % 8)) % 8);
    this.chunks.push(bytes, padding);
    this.offset += bytes.length + padding.length;
    return at;
  }

  floats(values: number[]): ArrayReference {
    const bytes = Buffer.alloc(4 * values.length);
    values.forEach((value, i) => bytes.writeFloatLE(value, 4 * i));
    return { f32: [this.add(bytes), values.length] };
  }

  doubles(values: number[]): ArrayReference {
    const bytes = Buffer.alloc(8 * values.length);
    values.forEach((value, i) => bytes.writeDoubleLE(value, 8 * i));
    return { f64: [this.add(bytes), values.length] };
  }

  quantised(values: number[]): ArrayReference {
    const finite = values.filter(Number.isFinite);
    const low = finite.length > 0 ? Math.min(...finite) : 0;
    const unit = finite.length > 0 ? (Math.max(...finite) - low) / 65000 || 1 : 1;
    const bytes = Buffer.alloc(2 * values.length);
    let before = 0;
    values.forEach((value, i) => {
      const level = Number.isFinite(value) ? Math.round((value - low) / unit) : 0xffff;
      bytes.writeUInt16LE((level - before) & 0xffff, 2 * i);
      before = level;
    });
    return { i16: [this.add(bytes), values.length], first: low, unit };
  }

  deflated(document: unknown): Buffer {
    const json = Buffer.from(JSON.stringify(document));
    const padding = Buffer.alloc((8 - ((json.length + 4) % 8)) % 8, ' ');
    const length = Buffer.alloc(4);
    length.writeUInt32LE(json.length + padding.length);
    return deflateSync(Buffer.concat([length, json, padding, ...this.chunks]));
  }
}

/** Names that would run if a page took text for markup. */
export const HOSTILE = '</script><script>window.hacked=1</script><img src=x onerror="window.hacked=1">';

/** A turn of so many degrees a second; of a high-level policy with what it commands. */
function flightColumns(
  packer: Packer, turn: number, isHighLevel: boolean,
): Record<string, ArrayReference> {
  const rows = Array.from({ length: 600 }, (_, i) => i * 0.02);
  const of = (value: (t: number) => number) => packer.quantised(rows.map(value));
  // What belongs to a step stands in the row at its end, so that the first has none.
  const held = (value: (t: number) => number) => of((t) => (t === 0 ? NaN : value(t)));
  const rate = (turn * Math.PI) / 180;
  return {
    north_ft: of((t) => (1000 / rate) * Math.sin(rate * t)),
    east_ft: of((t) => (1000 / rate) * (1 - Math.cos(rate * t))),
    altitude_ft: of((t) => 19000 + 40 * t), roll_deg: of(() => 60 * Math.sign(turn)),
    pitch_deg: of(() => 3), yaw_deg: of((t) => turn * t), alpha_deg: of((t) => 3 + Math.sin(t)),
    beta_deg: of(() => 0.1), true_airspeed_fps: of(() => 1000), mach: of(() => 0.96),
    load_factor_g: of((t) => 1 + t / 3), p_deg_s: of((t) => Math.cos(t)),
    elevator_deg: of((t) => -2 * Math.sin(t)), aileron_deg: of((t) => 5 * Math.sin(t)),
    rudder_deg: of(() => 1), leading_edge_flap_deg: of(() => 4),
    action_pitch: held((t) => Math.sin(t)), action_roll: held((t) => Math.cos(t)),
    action_throttle: held(() => 0.5), reward: held(() => -2), power: of(() => 50),
    wind_north_fps: of(() => 30),
    target_altitude_ft: of(() => 19500), target_yaw_deg: of(() => 120 * Math.sign(turn)),
    target_true_airspeed_fps: of(() => 1000),
    error_altitude_ft: of((t) => 500 - 40 * t), error_yaw_deg: of((t) => 120 - turn * t),
    error_true_airspeed_fps: of(() => 3),
    ...(isHighLevel ? {
      command_pitch_deg: held((t) => 5 * Math.floor(t)),
      command_yaw_deg: held((t) => turn * t + 20), command_true_airspeed_fps: held(() => 1050),
    } : {}),
  };
}

const quantity = (key: string, label: string, better: Quantity['better']): Quantity => ({
  key, symbol: '', label, section: '', shown_per_unit: key === 'success_rate' ? 100 : 1,
  decimals: 1, is_headline: true, better,
});

/**
 * Three agents, each from all ahead of it: of the last two the intervals of the values overlap, and
 * those of the differences leave out zero.
 */
function comparisonOf(names: string[]): Comparison {
  const about = (value: number, half: number): Estimate =>
    ({ value, low: value - half, high: value + half, count: 100 });
  const success = [1, 0.9, 0.95];
  const seconds = [15, 20, 19];
  return {
    task: 'heading', conditions: 'still air', episodes: 100, seed: 1,
    quantities: [quantity('success_rate', 'success, %', 'higher'),
      quantity('time_to_target_s', 'time to target, s', 'lower'), quantity('mach', 'Mach', '')],
    agents: names.map((name, i) => {
      const against = names.slice(0, i).map((_, k) => ({
        estimates: {
          success_rate: about(success[i] - success[k], 0.03),
          time_to_target_s: about(seconds[i] - seconds[k], 0.5), mach: about(0.1 * (i - k), 0.01),
        },
        success_p_value: 0.01,
      }));
      return {
        name, action_repeat: 5, terminations: { target_reached: 100 - i, time_limit: i },
        estimates: { success_rate: about(success[i], 0.06), time_to_target_s: about(seconds[i], 2),
          mach: about(0.8 + 0.1 * i, 0.01) },
        ...(i > 0 ? { against_first: against[0], against } : {}),
      };
    }),
  };
}

/** Seeds of one configuration, whose returns are higher by `more`, and `flights` episodes by two
 * agents, if any. */
export function fixture(name: string, flights: number, more = 0, seeds = [1, 2]): Buffer {
  const packer = new Packer();
  const steps = Array.from({ length: 60 }, (_, i) => (i + 1) * 5e5);
  const run = (seed: number) => ({
    name: `${name}-${seed}`, path: `runs/${name}-${seed}`, task: 'heading', seed,
    preset: 'default', total_steps: 3e7, repetition: 0, notes: [`${name}: a remark`],
    configuration: [
      { key: 'ppo.learning_rate', value: '0.001', help: 'step size', preset: '0.0003' },
      { key: 'env.task', value: `"${name}"`, help: 'what is flown' },
    ],
    metrics: {
      env_steps: packer.floats(steps),
      return_mean: packer.floats(steps.map((x) => Math.log(x) * 10 + seed + more)),
      success_rate: packer.floats(steps.map((x, i) => (i < 3 ? NaN : x / 4e7))),
      evaluation_hold_within: packer.floats(steps.map((x, i) => (i % 10 === 9 ? x / 4e7 : NaN))),
      ended_target_reached: packer.floats(steps.map((_, i) => i)),
      ended_time_limit: packer.floats(steps.map((_, i) => 60 - i)),
    },
    timing: {
      env_steps: packer.floats(steps), rollout_s: packer.floats(steps.map(() => 0.5)),
      update_s: packer.floats(steps.map(() => 1.5)),
    },
    evaluation: null,
  });
  const agents = [name, 'autopilot:aggressive'];
  const document: ReportDocument = {
    format: 3, skein: '0.0.0', made: '2026-01-01T00:00:00Z', runs: seeds.map(run),
    comparisons: [comparisonOf([...agents, 'autopilot:traditional'])],
    flights: [{
      task: 'heading', conditions: 'still air', seed: 1, agents, is_point: false, hold_s: 10,
      span_ft: 30,
      targets: [
        { column: 'altitude_ft', is_angle: false, tolerance: 100 },
        { column: 'yaw_deg', is_angle: true, tolerance: 5 },
        { column: 'true_airspeed_fps', is_angle: false, tolerance: 20 },
      ],
      flights: Array.from({ length: flights * 2 }, (_, i) => ({
        agent: i % 2, episode: Math.floor(i / 2), end: 'target_reached', return: -100,
        // Of many the later ones are longer.
        duration_s: 599 * 0.02 + (i < 12 ? 0 : 8), new_target_s: i % 2 ? [5] : [], reached_s: [599 * 0.02],
        interval_s: 0.02,
        columns: flightColumns(packer, (i % 2 ? 6 : 9) + Math.floor(i / 2) * 0.1, i % 2 === 0),
      })),
    }].filter((set) => set.flights.length > 0),
  };
  return packer.deflated(document);
}

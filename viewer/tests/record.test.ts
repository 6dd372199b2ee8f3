// SPDX-License-Identifier: Apache-2.0
import { type LineSegments, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { Goal, recordsWithGoal } from '../src/flights/goal';
import { actionsOf, errorsOf, readingsOf } from '../src/flights/pane';
import { type FlightRecord, Pose, recordsOf } from '../src/flights/record';
import { flightCsv } from '../src/flights/flight_csv';
import { chartedOf, dataOf, isWrapped, MOST_CHARTED, reading, stripsOf, wrapsOf } from '../src/flights/strip_list';
import { Trails } from '../src/flights/trails';
import type { ArrayReference } from '../src/pack';
import type { FlightSet, ReportPack } from '../src/report';

/** A flight by its columns, rows of a second. */
function record(
  columns: Record<string, number[]>, more: object = {}, conditions = 'still air',
): FlightRecord {
  const names = Object.keys(columns);
  const references = Object.fromEntries(names.map((name, i) =>
    [name, { f32: [i, columns[name].length] } as ArrayReference]));
  const pack = {
    array: (reference: { f32: [number, number] }) =>
      Float32Array.from(columns[names[reference.f32[0]]]),
  } as unknown as ReportPack;
  const flight = {
    agent: 0, episode: 0, end: 'time_limit', return: 0, duration_s: columns.north_ft.length - 1,
    new_target_s: [], reached_s: [], interval_s: 1, columns: references, ...more,
  };
  return recordsOf({ conditions, flights: [flight] } as unknown as FlightSet, pack)[0];
}

const STRAIGHT = { north_ft: [0, 100, 200, 300], east_ft: [0, 0, 0, 0], altitude_ft: [5, 5, 7, 7],
  roll_deg: [0, 0, 0, 0], pitch_deg: [0, 0, 0, 0], yaw_deg: [170, -170, -170, -170] };

describe('a record', () => {
  it('is linear between rows, and its ends outside', () => {
    const flown = record(STRAIGHT);
    expect(flown.value('north_ft', 1.5)).toBe(150);
    expect(flown.value('north_ft', -1)).toBe(0);
    expect(flown.value('north_ft', 99)).toBe(300);
    expect(flown.value('yaw_deg', 0.5)).toBeCloseTo(180, 4);
    expect(flown.place(1.5, new Vector3()).toArray()).toEqual([0, 6, -150]);
  });
  it('turns the short way round', () => {
    const nose = new Vector3(0, 0, -1).applyQuaternion(record(STRAIGHT).pose(0.5, new Pose()).attitude);
    expect(nose.distanceTo(new Vector3(0, 0, 1))).toBeLessThan(1e-6);
  });
  it('holds targets and commands for their step, whose row is at its end', () => {
    const flown = record({ ...STRAIGHT, target_yaw_deg: [10, 10, 90, 90], action_roll: [1, 1, -1, 0] });
    expect([0, 0.5, 1, 1.01, 2, 2.5].map((t) => flown.value('target_yaw_deg', t)))
      .toEqual([10, 10, 10, 90, 90, 90]);
    expect(flown.value('action_roll', 1.5)).toBe(-1);
  });
  it('has gaps, which drawings in space fill', () => {
    const flown = record({ ...STRAIGHT, east_ft: [NaN, 10, NaN, 30], reward: [NaN, 1, 2, NaN],
      action_roll: [NaN, 1, -1, 0], none: [NaN, NaN, NaN, NaN] });
    expect([0, 0.5, 1, 1.5, 2, 2.5, 3].map((t) => flown.value('reward', t)))
      .toEqual([NaN, NaN, 1, 1.5, 2, NaN, NaN]);
    expect([0, 0.01, 1].map((t) => flown.value('action_roll', t))).toEqual([NaN, 1, 1]);
    expect([0, 0.01, 2].map((t) => flown.drawn('action_roll', t))).toEqual([1, 1, -1]);
    expect([0, 1.5, 2, 3].map((t) => flown.place(t, new Vector3()).x)).toEqual([10, 10, 10, 30]);
    expect([flown.has('reward'), flown.has('none'), flown.has('mach')])
      .toEqual([true, false, false]);
  });
  it('knows the targets of its mission', () => {
    const flown = record(STRAIGHT, { new_target_s: [1, 2], reached_s: [1] });
    expect([0, 1, 1.1, 2.5].map((t) => flown.targetAt(t))).toEqual([0, 0, 1, 2]);
    expect(flown.targetTimes(1)).toEqual([1, 2]);
    expect(flown.targetTimes(2)).toEqual([2, 3]);
    expect([0, 1, 2].map((target) => flown.isReached(target, 3))).toEqual([true, false, false]);
    expect(flown.isReached(0, 0.5)).toBe(false);
  });
  it('says when its target was reached, and how it ended', () => {
    expect(record(STRAIGHT).outcome()).toBe('time limit at 3.0 s');
    const reached = { end: 'target_reached', reached_s: [3] };
    expect(record(STRAIGHT, reached).outcome()).toBe('target reached at 3.0 s');
    expect(record(STRAIGHT, { ...reached, reached_s: [2] }).outcome())
      .toBe('target reached at 2.0 s, flown for 3.0 s');
    expect(record(STRAIGHT, { end: 'low_altitude', reached_s: [2] }).outcome())
      .toBe('target reached at 2.0 s, low altitude at 3.0 s');
  });
  it('of a mission flown to its end misses nothing', () => {
    expect(record(STRAIGHT, { new_target_s: [1], reached_s: [1] }).outcome())
      .toBe('mission flown, 3.0 s');
    const missions = 'f16 in still air; missions of 0.05 min';
    expect(record(STRAIGHT, {}, missions).outcome()).toBe('mission flown, 3.0 s');
    expect(record(STRAIGHT, {}, missions).end).toBe('mission flown');
    expect(record(STRAIGHT, { end: 'low_altitude', reached_s: [2] }, missions).outcome())
      .toBe('low altitude at 3.0 s');
  });
});

describe('in space', () => {
  const setOf = (isPoint: boolean, ...columns: string[]) => ({ is_point: isPoint,
    targets: columns.map((column) => ({ column, is_angle: true, tolerance: 5 })) }) as FlightSet;
  const records = [0, 0, 1, 1].map((episode, agent) => record(STRAIGHT, { episode, agent }));
  const shownOf = (set: FlightSet) => recordsWithGoal(set, records).own;

  it('a target of no place and no heading is not shown', () => {
    expect(shownOf(setOf(false, 'roll_deg', 'altitude_ft'))).toEqual([]);
    expect(shownOf(setOf(false))).toEqual([]);
  });
  it('a heading is shown of everyone, a place once an episode', () => {
    expect(shownOf(setOf(false, 'yaw_deg', 'altitude_ft'))).toEqual(records);
    expect(shownOf(setOf(true, 'north_ft', 'east_ft', 'altitude_ft')))
      .toEqual([records[0], records[2]]);
  });
});

it('charts hold the flights of the first episodes, of all agents', () => {
  // As they are packed, by agent.
  const flown = [0, 1].flatMap((agent) => Array.from({ length: 20 }, (_, episode) =>
    record(STRAIGHT, { agent, episode })));
  const charted = chartedOf(flown);
  expect(charted.length).toBe(MOST_CHARTED);
  expect(charted.map(({ agent, episode }) => [episode, agent]))
    .toEqual(Array.from({ length: MOST_CHARTED }, (_, i) => [Math.floor(i / 2), i % 2]));
  expect(flown[1].episode).toBe(1);
});

/** Every third row of so many steps of a second, and the last one (FlightsJson of Skein); the
 * aircraft flies 100 ft north in each, to the target that `target` says of a step. */
function thinned(steps: number, target: (step: number) => number, more: object = {}): FlightRecord {
  const kept = Array.from({ length: steps + 1 }, (_, row) => row)
    .filter((row) => row % 3 === 0 || row === steps);
  const all = (value: number) => kept.map(() => value);
  return record({
    north_ft: kept.map((row) => 100 * row), east_ft: all(0), altitude_ft: all(5), roll_deg: all(0),
    pitch_deg: all(0), yaw_deg: all(0), target_north_ft: kept.map(target), target_east_ft: all(0),
    target_altitude_ft: all(5), error_north_ft: kept.map((row) => target(row) - 100 * row),
    reward: kept,
  }, { interval_s: 3, duration_s: steps, ...more });
}

describe('a record that leaves rows out', () => {
  const targets = ['north_ft', 'east_ft', 'altitude_ft'].map((column) =>
    ({ column, is_angle: false, tolerance: 100 }));
  const norths = (flown: FlightRecord) => new Goal(flown, targets, true, '#0072b2').places()
    .map((point) => -point.z);

  it('changes targets when they came, between two rows, too', () => {
    const flown = thinned(11, (step) => [100, 200, 300][Number(step > 4) + Number(step > 8)],
      { new_target_s: [4, 8] });
    const read = (times: number[]) => times.map((time) => flown.drawn('target_north_ft', time));
    expect(read([0, 3, 3.5, 4, 4.01, 6, 7])).toEqual([100, 100, 100, 100, 200, 200, 200]);
    expect(read([8, 8.01, 9, 10, 11])).toEqual([200, 300, 300, 300, 300]);
    expect(norths(flown)).toEqual([100, 200, 300]);
    // Errors are linear, but where a target came.
    expect([0, 1.5, 3, 4, 4.01, 6].map((time) => flown.value('error_north_ft', time)))
      .toEqual([100, -50, -200, -200, -400, -400]);
  });
  it('changes them between the last two rows, and in a row', () => {
    const flown = thinned(11, (step) => [100, 200, 300][Number(step > 6) + Number(step > 10)],
      { new_target_s: [6, 10] });
    expect([6, 6.01, 10, 10.01].map((time) => flown.drawn('target_north_ft', time)))
      .toEqual([100, 200, 200, 300]);
    expect(norths(flown)).toEqual([100, 200, 300]);
  });
  it('draws no other target for one that no row knows', () => {
    const flown = thinned(11, (step) => [100, 200, 300][Number(step > 4) + Number(step > 5)],
      { new_target_s: [4, 5] });
    expect(norths(flown)).toEqual([100, 300]);
    expect([4, 5.01].map((time) => flown.drawn('target_north_ft', time))).toEqual([100, 300]);
  });
  it('ends where it ended', () => {
    const flown = thinned(11, () => 100);
    const north = (time: number) => -flown.place(time, new Vector3()).z;
    expect([8, 9, 9.5, 10, 11, 12].map(north)).toEqual([800, 900, 950, 1000, 1100, 1100]);
    expect(flown.value('reward', 11)).toBe(11);
    expect(Array.from({ length: flown.rows }, (_, row) => flown.timeOf(row)))
      .toEqual([0, 3, 6, 9, 11]);
  });
  it('is saved, charted and drawn with the time of its end', () => {
    const flown = thinned(11, () => 100);
    expect(flightCsv([flown], ['a']).trimEnd().split('\r\n').at(-1)?.split(',').slice(2, 4))
      .toEqual(['11', '1100']);
    const [line] = new Trails([flown], ['#0072b2']).group.children.slice(-1) as LineSegments[];
    expect(Array.from(line.geometry.getAttribute('time').array).at(-1)).toBe(11);
    const strip = { title: '', columns: ['reward'], isOn: true };
    expect(dataOf([flown, thinned(14, () => 100)], strip)).toEqual([[0, 3, 6, 9, 11, 12, 14],
      [0, 3, 6, 9, 11, null, null], [0, 3, 6, 9, 11, 12, 14]]);
  });
});

it('readings know neither -0 nor a heading of 360', () => {
  const zero = [0, 0, 0, 0];
  const flown = record({ ...STRAIGHT, yaw_deg: [-0.2, -170, 90, 0], pitch_deg: [-0.2, 0, 0, 0],
    true_airspeed_fps: zero, mach: zero, load_factor_g: zero, alpha_deg: zero, beta_deg: zero });
  expect(readingsOf(flown, 0)).toContain('hdg 0°');
  expect(readingsOf(flown, 0)).toContain('pitch 0°');
  expect(readingsOf(flown, 1)).toContain('hdg 190°');
});

it('targets are read with their tolerances, headings from 0 to 360', () => {
  const targets = [{ column: 'altitude_ft', is_angle: false, tolerance: 100 },
    { column: 'yaw_deg', is_angle: true, tolerance: 5 },
    { column: 'mach', is_angle: false, tolerance: 0.01 }];
  const flown = record({ ...STRAIGHT, target_altitude_ft: [905, 905, 905, 905],
    error_altitude_ft: [900, 900, 898, 898], target_yaw_deg: [-10, -10, -170, -170],
    error_yaw_deg: [-180, -180, 0, 0] });
  expect(errorsOf(flown, targets, 0))
    .toEqual(['altitude, ft: 900 off 905 ± 100', 'heading, deg: -180.0 off 350.0 ± 5']);
  expect(errorsOf(flown, targets, 3)[1]).toBe('heading, deg: 0.0 off 190.0 ± 5 ✓');
});

it('a target without a tolerance is read without one', () => {
  const targets = [{ column: 'mach', is_angle: false, tolerance: 0 }];
  const flown = record({ ...STRAIGHT, target_mach: [1, 1, 1, 1], error_mach: [0, 0, 0, 0] });
  expect(errorsOf(flown, targets, 0)).toEqual(['mach: 0.000 off 1.000']);
});

it('a target of heading just below north is read as 0', () => {
  const targets = [{ column: 'yaw_deg', is_angle: true, tolerance: 5 }];
  const flown = record({ ...STRAIGHT, target_yaw_deg: [-0.04, -0.04, -0.06, NaN],
    error_yaw_deg: [1, 1, 1, 1] });
  expect([0, 2, 3].map((time) => errorsOf(flown, targets, time)[0])).toEqual(
    ['0.0', '359.9', '–'].map((aim) => `heading, deg: 1.0 off ${aim} ± 5 ✓`));
});

it('actions are read where there are some', () => {
  expect(actionsOf(record(STRAIGHT), 1)).toBe('');
  const flown = record({ ...STRAIGHT, action_roll: [NaN, -0.001, 1, 1],
    action_throttle: [NaN, 1, 1, 1] });
  expect(actionsOf(flown, 0)).toBe('actions  roll –   throttle –');
  expect(actionsOf(flown, 1)).toBe('actions  roll 0.00   throttle 1.00');
});

it('a reading has the decimals of its column, so that it stands still', () => {
  const texts = (column: string, ...values: number[]) => values.map((v) => reading(column, v));
  expect(texts('load_factor_g', 1, 6.125, -1e-9, NaN)).toEqual(['1.00', '6.13', '0.00', '–']);
  expect(texts('beta_deg', -3.1e-6)).toEqual(['0.00']);
  expect(texts('error_altitude_ft', 987.6)).toEqual(['988']);
  expect(texts('error_true_airspeed_fps', 11.52)).toEqual(['11.5']);
  expect(texts('p_deg_s', -120)).toEqual(['-120.0']);
  expect(texts('power', 50)).toEqual(['50.0']);
});

it('angles that go round are known', () => {
  expect(['roll_deg', 'yaw_deg', 'error_yaw_deg'].every(isWrapped)).toBe(true);
  expect(['pitch_deg', 'alpha_deg', 'r_deg_s'].some(isWrapped)).toBe(false);
  const turns = [170, 179, -179, null, 178, -90, -175, 175];
  expect(wrapsOf(turns, 0, 7)).toEqual([1, 4, 6]);
  expect(wrapsOf(turns, 2, 4)).toEqual([]);
});

it('a table has every row of every flight, and quotes names', () => {
  const text = flightCsv([record(STRAIGHT), record({ ...STRAIGHT, mach: [1, 1, 1, 1] })], ['a "b", c']);
  const lines = text.trimEnd().split('\r\n');
  expect(lines[0]).toBe('agent,episode,time_s,north_ft,east_ft,altitude_ft,roll_deg,pitch_deg,yaw_deg,mach');
  expect(lines.length).toBe(9);
  expect(lines[2]).toBe('"a ""b"", c",0,1,100,0,5,0,0,-170,');
  expect(lines[8].endsWith(',1')).toBe(true);
});

it('where there is no number a cell is blank, a chart has a gap, and a reading a dash', () => {
  const reward = [NaN, 1, NaN, 2];
  const flown = record({ ...STRAIGHT, reward, mach: reward });
  const rows = flightCsv([flown], ['a']).trimEnd().split('\r\n').slice(1);
  expect(rows.map((row) => row.split(',').at(-1))).toEqual(['', '1', '', '2']);
  const other = record({ ...STRAIGHT, reward: [NaN, NaN, NaN, NaN] });
  const strip = { title: '', columns: ['reward'], isOn: true };
  expect(dataOf([flown, other], strip))
    .toEqual([[0, 1, 2, 3], [null, 1, null, 2], [null, null, null, null]]);
  expect(readingsOf(flown, 0)).toContain('M –');
  expect(readingsOf(flown, 1)).toContain('M 1.00');
});

it('commands of one agent are charted beside what is flown', () => {
  const set = { targets: [] } as unknown as FlightSet;
  const titles = (records: FlightRecord[]) => stripsOf(set, records).map(({ title }) => title);
  const plain = record(STRAIGHT);
  const high = record({ ...STRAIGHT, command_yaw_deg: [0, 0, 0, 0] });
  expect(titles([plain])).toContain('yaw, deg');
  expect(titles([plain, high])).toContain('yaw, deg, and dashed as commanded');
});

it('a chart of two units says on which side the dashed one is read', () => {
  const flown = record({ ...STRAIGHT, action_pitch: [0, 0, 0, 0], elevator_deg: [-2, -2, -2, -2] });
  const pair = stripsOf({ targets: [] } as unknown as FlightSet, [flown])
    .find(({ secondAxis }) => secondAxis);
  expect(pair?.title).toBe('action pitch, and dashed elevator, deg (right)');
});

// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Comparison, ReportPack } from '../src/report';
import { metricsCsv, trainingCsv } from '../src/tables';

it('a training has a row for every iteration of every run, blank where there is no number', () => {
  const run = (name: string, seed: number, metrics: object) => ({ name, seed, metrics });
  const pack = {
    document: { runs: [
      run('a, "b"', 1, { env_steps: [1e8, 2e8], return_mean: [NaN, -1.5] }),
      run('c', 2, { env_steps: [5], entropy: [0.25] }),
    ] },
    array: (values: unknown) => Float32Array.from(values as number[]),
  } as unknown as ReportPack;
  expect(trainingCsv(pack).split('\r\n')).toEqual([
    'run,seed,env_steps,return_mean,entropy', '"a, ""b""",1,100000000,,', '"a, ""b""",1,200000000,-1.5,',
    '"c",2,5,,0.25', '',
  ]);
});

it('a number of a training is told from its neighbours of 32 bits, and a count is whole', () => {
  const measured = new Float32Array(new Uint32Array([0x3f9d70a4, 0x3f9d70a5]).buffer);
  const steps = Float32Array.from([5e9, 2 ** 33]);
  const pack = {
    document: { runs: [{ name: 'a', seed: 1, metrics: { env_steps: steps, entropy: measured } }] },
    array: (values: unknown) => values,
  } as unknown as ReportPack;
  const cells = trainingCsv(pack).trimEnd().split('\r\n').slice(1).map((line) => line.split(','));
  expect(cells.map(([, , count]) => count)).toEqual(['5000000000', '8589934592']);
  expect(cells.map(([, , , value]) => Math.fround(Number(value)))).toEqual(Array.from(measured));
});

it('metrics are in the unit of their label, with their interval', () => {
  const comparison = {
    task: 'heading', conditions: 'still air; noise 0.01',
    quantities: [{ key: 'success_rate', label: 'success, %', shown_per_unit: 100 },
      { key: 'time_to_target_s', label: 'time to target, s', shown_per_unit: 1 }],
    agents: [{ name: 'zero', estimates: {
      success_rate: { value: 0.5, low: 0.4, high: null, count: 10 },
      time_to_target_s: { value: null, low: null, high: null, count: 0 },
    } }],
  } as unknown as Comparison;
  expect(metricsCsv([comparison]).split('\r\n')).toEqual([
    'task,level,conditions,agent,quantity,label,value,low,high,count',
    '"heading","","still air; noise 0.01","zero",success_rate,"success, %",50,40,,10', '',
  ]);
});

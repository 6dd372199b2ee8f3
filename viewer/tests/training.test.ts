// SPDX-License-Identifier: Apache-2.0
import { afterAll, beforeAll, expect, it, vi } from 'vitest';
import { endKindsOf } from '../src/curves';
import { inflate, unpack } from '../src/pack';
import { endColourOf } from '../src/palette';
import type { ReportDocument } from '../src/report';
import { endsPartOf } from '../src/training';
import { fixture } from './fixture';

beforeAll(() => {
  vi.stubGlobal('document', { documentElement: { dataset: { theme: 'light' } } });
  vi.stubGlobal('getComputedStyle', () => ({ getPropertyValue: (name: string) => ` of ${name}` }));
});
afterAll(() => vi.unstubAllGlobals());

it('between areas of how episodes end is a line of the colour of the ground', async () => {
  const pack = unpack<ReportDocument>(await inflate(fixture('seed', 0)));
  const { runs } = pack.document;
  const part = endsPartOf(runs[0], endKindsOf(runs), pack);
  expect(part?.series.map(({ label, fill, stroke, width }) => [label, fill, stroke, width])).toEqual([
    ['time limit', endColourOf('time_limit'), 'of --ground', 1],
    ['target reached', endColourOf('target_reached'), 'of --ground', 1],
  ]);
});

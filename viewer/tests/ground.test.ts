// SPDX-License-Identifier: Apache-2.0
import { SRGBColorSpace } from 'three';
import { afterAll, beforeAll, expect, it, vi } from 'vitest';
import { label } from '../src/flights/ground';

beforeAll(() => {
  const pen = { measureText: () => ({ width: 30 }), fillText: () => undefined };
  vi.stubGlobal('document', { createElement: () => ({ getContext: () => pen }) });
});
afterAll(() => vi.unstubAllGlobals());

it('letters have the colour that they are written in', () => {
  // A canvas holds what a screen shows, which three.js would take for linear light.
  expect(label('N', '#5a646d', 10).material.map?.colorSpace).toBe(SRGBColorSpace);
});

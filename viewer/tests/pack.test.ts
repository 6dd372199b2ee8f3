// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { bytesOfBase64, inflate, unpack } from '../src/pack';
import { Packer } from './fixture';

async function through(packer: Packer, document: unknown) {
  const base64 = packer.deflated(document).toString('base64');
  return unpack<Record<string, never>>(await inflate(bytesOfBase64(base64)));
}

describe('the pack', () => {
  it('gives back floats, what is not finite included', async () => {
    const packer = new Packer();
    const values = [1.5, -2, NaN, Infinity];
    const reference = packer.floats(values);
    const pack = await through(packer, { a: reference });
    expect(Array.from(pack.array(pack.document.a))).toEqual(values);
  });

  it('gives back counts that no float is', async () => {
    const packer = new Packer();
    const counts = [1, 2 ** 24 + 1, 2 ** 53 - 1];
    const pack = await through(packer, { first: packer.floats([7]), a: packer.doubles(counts) });
    expect(Array.from(pack.array(pack.document.a))).toEqual(counts);
  });

  it('gives back quantised values to a 65000th of their range', async () => {
    const packer = new Packer();
    const values = Array.from({ length: 500 }, (_, i) => 300 * Math.sin(i / 7));
    const references = { first: packer.quantised([7]), a: packer.quantised(values) };
    const pack = await through(packer, references);
    expect(Array.from(pack.array(pack.document.first))).toEqual([7]);
    pack.array(pack.document.a).forEach((value, i) =>
      expect(Math.abs(value - values[i])).toBeLessThan(600 / 65000));
  });

  it('knows where a quantised value is not there', async () => {
    const packer = new Packer();
    const references = { some: packer.quantised([NaN, 0, NaN, NaN, 65000, NaN]),
      none: packer.quantised([NaN, NaN]) };
    const pack = await through(packer, references);
    expect(Array.from(pack.array(pack.document.some))).toEqual([NaN, 0, NaN, NaN, 65000, NaN]);
    expect(Array.from(pack.array(pack.document.none))).toEqual([NaN, NaN]);
  });

  it('keeps text that is not ASCII', async () => {
    const pack = await through(new Packer(), { name: 'Flügel 翼' });
    expect(pack.document.name).toBe('Flügel 翼');
  });

  it('refuses what is cut short', async () => {
    const bytes = await inflate(new Packer().deflated({ name: 'x' }));
    expect(() => unpack(bytes.subarray(0, 9))).toThrow('cut short');
    expect(() => unpack(new Uint8Array(2))).toThrow('cut short');
  });
});

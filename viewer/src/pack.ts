// SPDX-License-Identifier: Apache-2.0
// Reads what skein packs into a report (src/report/data_pack.h of Skein says how).

/** An array of the pack, as its document refers to it. */
export type ArrayReference =
  | { f32: [number, number] }
  | { i16: [number, number]; first: number; unit: number };

/** The level of a number that is not there. */
const NO_LEVEL = 0xffff;

export interface Pack<Document> {
  document: Document;
  /** The numbers that a reference of the document stands for; NaN where there is none. */
  array(reference: ArrayReference): Float32Array;
}

export function bytesOfBase64(text: string): Uint8Array {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export async function inflate(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function floats(view: DataView, offset: number, count: number): Float32Array {
  const values = new Float32Array(count);
  for (let i = 0; i < count; i += 1) values[i] = view.getFloat32(offset + 4 * i, true);
  return values;
}

function dequantised(
  view: DataView, offset: number, count: number, first: number, unit: number,
): Float32Array {
  const values = new Float32Array(count);
  let level = 0;
  for (let i = 0; i < count; i += 1) {
    level = (level + view.getUint16(offset + 2 * i, true)) & 0xffff;
    values[i] = level === NO_LEVEL ? NaN : first + unit * level;
  }
  return values;
}

/** Throws on bytes that are no pack. */
export function unpack<Document>(bytes: Uint8Array): Pack<Document> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const length = bytes.byteLength >= 4 ? view.getUint32(0, true) : Infinity;
  const begin = 4 + length;
  if (begin > bytes.byteLength) throw new Error('the data of this report is cut short');
  const document = JSON.parse(new TextDecoder().decode(bytes.subarray(4, begin))) as Document;
  const known = new Map<ArrayReference, Float32Array>();
  const read = (reference: ArrayReference): Float32Array =>
    'f32' in reference
      ? floats(view, begin + reference.f32[0], reference.f32[1])
      : dequantised(view, begin + reference.i16[0], reference.i16[1], reference.first,
                    reference.unit);
  return {
    document,
    array(reference) {
      const values = known.get(reference) ?? read(reference);
      known.set(reference, values);
      return values;
    },
  };
}

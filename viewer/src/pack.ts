// SPDX-License-Identifier: Apache-2.0
// Reads what skein packs into a report (src/report/data_pack.h of Skein says how).

/** An array of the pack, as its document refers to it. */
export type ArrayReference =
  | { f32: [number, number] }
  | { f64: [number, number] }
  | { i16: [number, number]; first: number; unit: number };

/** As they are kept: counts beyond 2^24 need 64 bits. */
export type Numbers = Float32Array | Float64Array;

/** The level of a number that is not there. */
const NO_LEVEL = 0xffff;

export interface Pack<Document> {
  document: Document;
  /** The numbers that a reference of the document stands for; NaN where there is none. */
  array(reference: ArrayReference): Numbers;
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

function doubles(view: DataView, offset: number, count: number): Float64Array {
  const values = new Float64Array(count);
  for (let i = 0; i < count; i += 1) values[i] = view.getFloat64(offset + 8 * i, true);
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
  const known = new Map<ArrayReference, Numbers>();
  const read = (reference: ArrayReference): Numbers => {
    if ('f32' in reference) return floats(view, begin + reference.f32[0], reference.f32[1]);
    if ('f64' in reference) return doubles(view, begin + reference.f64[0], reference.f64[1]);
    const [offset, count] = reference.i16;
    return dequantised(view, begin + offset, count, reference.first, reference.unit);
  };
  return {
    document,
    array(reference) {
      const values = known.get(reference) ?? read(reference);
      known.set(reference, values);
      return values;
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
// A page whose data a server gives (src/report/report_server.h of Skein), while it answers.

const REFRESH_MS = 5000;

export async function fetched(): Promise<Uint8Array> {
  const response = await fetch('data');
  if (!response.ok) throw new Error(await response.text());
  return new Uint8Array(await response.arrayBuffer());
}

function areEqual(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, i) => byte === b[i]);
}

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** "09:05". */
function clockTime(date: Date): string {
  return [date.getHours(), date.getMinutes()]
    .map((part) => String(part).padStart(2, '0')).join(':');
}

/**
 * Asks for data now and then, for ever; a page whose data are the same stays as it is. `say` is
 * told since when there is no answer, and why, and nothing once there is.
 */
export async function keepFresh(
  first: Uint8Array, renew: (bytes: Uint8Array) => Promise<void>, say: (text: string) => void,
): Promise<void> {
  let shown = first;
  let answered = new Date();
  for (;;) {
    await new Promise((resolve) => { setTimeout(resolve, REFRESH_MS); });
    let bytes: Uint8Array;
    try {
      bytes = await fetched();
      answered = new Date();
    } catch (error) {
      say(`no answer since ${clockTime(answered)}: ${messageOf(error)}`);
      continue;
    }
    try {
      if (!areEqual(bytes, shown)) await renew(bytes);
      shown = bytes;
      say('');
    } catch (error) {
      say(`cannot be shown: ${messageOf(error)}`);
    }
  }
}

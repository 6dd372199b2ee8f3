// SPDX-License-Identifier: Apache-2.0
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, it } from 'vitest';
import viewer from '../vite.config';

/** Debian 12's. */
const OLDEST_NODE = 18;

interface Lock {
  packages: Record<string, { version?: string; engines?: { node?: string }; resolved?: string }>;
}

const lock = JSON.parse(readFileSync(join(__dirname, '../package-lock.json'), 'utf8')) as Lock;

/** Whether "^18.0.0 || >=20" or ">= 16" takes the oldest. */
function admits(range: string): boolean {
  return range.split('||').some((part) => {
    const found = /^(\^|>=|>)?\s*(\d+)/.exec(part.trim());
    if (!found) return part.trim() === '*';
    const major = Number(found[2]);
    return found[1]?.startsWith('>') ? major <= OLDEST_NODE : major === OLDEST_NODE;
  });
}

it('every package of the lock file runs on the oldest Node that is supported', () => {
  const refusing = Object.entries(lock.packages)
    .filter(([, { engines }]) => engines?.node && !admits(engines.node)).map(([name]) => name);
  expect(refusing).toEqual([]);
});

/** Not beside a copy of the viewer, in which a build tests it. */
const MANUAL = join(__dirname, '../../docs/how-to/report.md');

it.skipIf(!existsSync(MANUAL))('the page is built for the browsers that its manual names', () => {
  const [, ...versions] = /needs Chromium (\d+)[^,]*, Firefox ([\d.]+), Safari ([\d.]+)/
    .exec(readFileSync(MANUAL, 'utf8')) ?? [];
  expect(viewer.build?.target)
    .toEqual(['chrome', 'firefox', 'safari'].map((name, i) => name + versions[i]));
});

it('the lock file names no registry', () => {
  expect(Object.values(lock.packages).filter(({ resolved }) => resolved)).toEqual([]);
});

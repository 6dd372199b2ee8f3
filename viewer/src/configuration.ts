// SPDX-License-Identifier: Apache-2.0
// The configuration of runs: what differs from the preset, and between them.
import { el, tick } from './dom';
import type { ReportPack, Run, Setting } from './report';
import type { Shown } from './shown';

function settingsByKey(run: Run): Map<string, Setting> {
  return new Map(run.configuration.map((setting) => [setting.key, setting]));
}

/** Whether a run differs from its preset there, or from another run. */
export function isSpecial(settings: (Setting | undefined)[]): boolean {
  const values = new Set(settings.map((setting) => setting?.value));
  return values.size > 1 || settings.some((setting) => setting?.preset !== undefined);
}

function cellOf(setting: Setting | undefined): HTMLTableCellElement {
  if (!setting) return el('td', {}, '–');
  if (setting.preset === undefined) return el('td', {}, setting.value);
  return el('td', { class: 'changed' }, el('strong', {}, setting.value),
    el('small', {}, ` preset: ${setting.preset}`));
}

function tableOf(runs: Run[], isWhole: boolean): HTMLElement {
  const tables = runs.map(settingsByKey);
  const keys = [...new Set(tables.flatMap((table) => [...table.keys()]))];
  const body = el('tbody');
  for (const key of keys) {
    const settings = tables.map((table) => table.get(key));
    if (!isWhole && !isSpecial(settings)) continue;
    const help = settings.find((setting) => setting)?.help ?? '';
    body.append(el('tr', {}, el('th', { scope: 'row' }, key, el('small', {}, help)),
      ...settings.map(cellOf)));
  }
  if (body.rows.length === 0) {
    body.append(el('tr', {}, el('td', { colspan: runs.length + 1 },
      'Every setting is the preset’s.')));
  }
  const names = runs.map((run) => el('th', { scope: 'col' }, run.name,
    el('small', {}, run.preset ? `preset ${run.preset}` : 'preset not known')));
  return el('table', { class: 'settings' }, el('thead', {}, el('tr', {}, el('td'), ...names)), body);
}

export function showConfiguration(place: HTMLElement, pack: ReportPack): Shown {
  const tables = el('div', { class: 'wide' });
  let { runs } = pack.document;
  let isWhole = false;
  const draw = () => tables.replaceChildren(tableOf(runs, isWhole));
  place.append(
    el('div', { class: 'controls' }, tick('all settings', isWhole, (isOn) => {
      isWhole = isOn;
      draw();
    }), el('span', { class: 'hint' },
      'Bold: differs from the preset. Without the tick: what differs from it, or between runs.')),
    tables,
  );
  draw();
  return {
    stop: () => undefined,
    recolour: () => undefined,
    renew: (fresh) => {
      runs = fresh.document.runs;
      draw();
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
import threeLicence from '../node_modules/three/LICENSE?raw';
import uplotLicence from '../node_modules/uplot/LICENSE?raw';
import { showConfiguration } from './configuration';
import { button, el } from './dom';
import { showFlights } from './flights/view';
import { showMetrics } from './metrics';
import { bytesOfBase64, inflate, unpack } from './pack';
import { isDark } from './palette';
import { KNOWN_FORMAT, type ReportDocument, type ReportPack } from './report';
import { showTraining } from './training';
import './style.css';

const REFRESH_MS = 5000;
const MOST_NAMES = 3;

interface View {
  name: string;
  title: string;
  show: (place: HTMLElement, pack: ReportPack) => () => void;
  isThere: (document: ReportDocument) => boolean;
}

const VIEWS: View[] = [
  { name: 'flights', title: 'Flights', show: showFlights, isThere: (d) => d.flights.length > 0 },
  { name: 'training', title: 'Training', show: showTraining, isThere: (d) => d.runs.length > 0 },
  { name: 'metrics', title: 'Metrics', show: showMetrics, isThere: (d) => d.comparisons.length > 0 },
  { name: 'configuration', title: 'Configuration', show: showConfiguration,
    isThere: (d) => d.runs.length > 0 },
];

/** Which view the address asks for, or the first. */
function chosenView(views: View[]): View | undefined {
  return views.find((view) => `#${view.name}` === location.hash) ?? views[0];
}

/** "a, b, c", "a, b and 10 others". */
function titleOf(names: string[]): string {
  if (names.length <= MOST_NAMES) return names.join(', ');
  return `${names.slice(0, MOST_NAMES - 1).join(', ')} and ${names.length - MOST_NAMES + 1} others`;
}

function notesOf(document: ReportDocument): HTMLElement | null {
  const notes = document.runs.flatMap((run) => run.notes.map((note) => `${run.name}: ${note}`));
  if (notes.length === 0) return null;
  return el('details', { class: 'notes' },
    el('summary', {}, notes.length === 1 ? 'One remark' : `${notes.length} remarks`),
    el('ul', {}, ...notes.map((note) => el('li', {}, note))));
}

function licences(): HTMLElement {
  return el('details', { class: 'licences' }, el('summary', {}, 'Licences of what this page contains'),
    el('h3', {}, 'three.js'), el('pre', {}, threeLicence),
    el('h3', {}, 'uPlot'), el('pre', {}, uplotLicence),
    el('h3', {}, 'Skein'), el('pre', {}, 'Apache License, Version 2.0'));
}

/** The whole page of a pack; shows it again when the view or the theme changes. */
class Page {
  private readonly place = el('main');
  private readonly nav = el('nav');
  private stop = () => {};

  constructor(root: HTMLElement, private pack: ReportPack) {
    const theme = button('◐', 'light or dark', () => {
      document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
      this.show();
    });
    const { document: report } = pack;
    const flown = [...report.comparisons.map((c) => c.agents.map((agent) => agent.name)),
      ...report.flights.map((set) => set.agents)][0] ?? ['nothing'];
    const title = titleOf(report.runs.length > 0 ? report.runs.map((run) => run.name) : flown);
    document.title = `${title} – Skein`;
    root.replaceChildren(
      el('header', {}, el('h1', {}, title), this.nav, theme),
      ...[notesOf(report)].filter((notes) => notes !== null),
      this.place,
      el('footer', {}, el('p', {}, `skein ${report.skein}, ${report.made}`), licences()),
    );
    addEventListener('hashchange', () => this.show());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.show());
    this.show();
  }

  renew(pack: ReportPack): void {
    this.pack = pack;
    // A flight that is being looked at goes on; what is fresh of it is shown when one comes back.
    if (location.hash !== '#flights') this.show();
  }

  private show(): void {
    const scroll = scrollY;
    this.stop();
    const views = VIEWS.filter((view) => view.isThere(this.pack.document));
    const chosen = chosenView(views);
    if (!chosen) {
      this.place.replaceChildren(el('p', {}, 'There is nothing in this report.'));
      return;
    }
    this.nav.replaceChildren(...views.map((view) =>
      el('a', { href: `#${view.name}`, 'aria-current': view === chosen ? 'page' : undefined },
        view.title)));
    this.place.replaceChildren();
    this.place.className = chosen.name;
    this.stop = chosen.show(this.place, this.pack);
    scrollTo(0, scroll);
  }
}

async function read(bytes: Uint8Array): Promise<ReportPack> {
  const pack = unpack<ReportDocument>(await inflate(bytes));
  if (pack.document.format !== KNOWN_FORMAT) throw new Error('the data is of another version');
  return pack;
}

async function fetched(): Promise<Uint8Array> {
  const response = await fetch('data');
  if (!response.ok) throw new Error(await response.text());
  return new Uint8Array(await response.arrayBuffer());
}

function areEqual(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, i) => byte === b[i]);
}

/** Asks for data now and then; a page whose data are the same stays as it is. */
function keepFresh(page: Page, first: Uint8Array): void {
  let shown = first;
  setInterval(() => void (async () => {
    const bytes = await fetched();
    if (areEqual(bytes, shown)) return;
    page.renew(await read(bytes));
    shown = bytes;
  })().catch(() => undefined), REFRESH_MS);
}

async function start(): Promise<void> {
  const root = document.getElementById('page') as HTMLElement;
  const text = document.getElementById('data')?.textContent?.trim() ?? '';
  try {
    const isLive = text === '';
    const bytes = isLive ? await fetched() : bytesOfBase64(text);
    const page = new Page(root, await read(bytes));
    if (isLive) keepFresh(page, bytes);
  } catch (error) {
    root.replaceChildren(el('p', { class: 'error' }, `This report cannot be shown: ${String(error)}`));
  }
}

void start();

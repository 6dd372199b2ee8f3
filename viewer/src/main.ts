// SPDX-License-Identifier: Apache-2.0
import threeLicence from '../node_modules/three/LICENSE?raw';
import uplotLicence from '../node_modules/uplot/LICENSE?raw';
import { showConfiguration } from './configuration';
import { button, el } from './dom';
import { showFlights } from './flights/view';
import { fetched, keepFresh } from './live';
import { showMetrics } from './metrics';
import { bytesOfBase64, inflate, unpack } from './pack';
import { isDark } from './palette';
import { KNOWN_FORMAT, type ReportDocument, type ReportPack } from './report';
import type { Shown } from './shown';
import { showTraining } from './training';
import './style.css';

const MOST_NAMES = 3;

interface View {
  name: string;
  title: string;
  show: (place: HTMLElement, pack: ReportPack) => Shown;
  isThere: (document: ReportDocument) => boolean;
}

const VIEWS: View[] = [
  { name: 'flights', title: 'Flights', show: showFlights, isThere: (d) => d.flights.length > 0 },
  { name: 'training', title: 'Training', show: showTraining, isThere: (d) => d.runs.length > 0 },
  { name: 'metrics', title: 'Metrics', show: showMetrics, isThere: (d) => d.comparisons.length > 0 },
  { name: 'configuration', title: 'Configuration', show: showConfiguration,
    isThere: (d) => d.runs.length > 0 },
];

/** "a, b, c", "a, b and 10 others". */
function titleOf(names: string[]): string {
  if (names.length <= MOST_NAMES) return names.join(', ');
  return `${names.slice(0, MOST_NAMES - 1).join(', ')} and ${names.length - MOST_NAMES + 1} others`;
}

/** The runs; of a report without one, the agents of its first comparison or flights. */
function shownNames(report: ReportDocument): string[] {
  if (report.runs.length > 0) return report.runs.map((run) => run.name);
  return [...report.comparisons.map((c) => c.agents.map((agent) => agent.name)),
    ...report.flights.map((set) => set.agents)][0] ?? ['nothing'];
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

/** The whole page of a pack; shows it again when the view changes. */
class Page {
  /** What is the matter with the data's freshness; empty while nothing is. */
  readonly status = el('p', { class: 'status', role: 'status' });
  private readonly place = el('main');
  private readonly notes = el('div');
  private readonly made = el('p');
  private readonly nav = el('nav', { 'aria-label': 'views' });
  private readonly title = el('h1');
  private chosen: View | undefined;
  private shown: Shown | undefined;

  constructor(root: HTMLElement, private pack: ReportPack) {
    const theme = button('◐', 'light or dark', () => {
      document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
      this.shown?.recolour();
    });
    root.replaceChildren(
      el('header', {}, this.title, this.nav, theme),
      this.notes, this.status, this.place,
      el('footer', {}, this.made, licences()),
    );
    this.say();
    addEventListener('hashchange', () => this.choose());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change',
      () => this.shown?.recolour());
    this.choose();
  }

  renew(pack: ReportPack): void {
    this.pack = pack;
    this.say();
    if (!this.chosen || !this.views().includes(this.chosen)) this.choose();
    else {
      this.showNames();
      this.shown?.renew(pack);
    }
  }

  /** What is to be said of the data, whatever is shown of them. */
  private say(): void {
    const { document: report } = this.pack;
    this.title.textContent = titleOf(shownNames(report));
    document.title = `${this.title.textContent} – Skein`;
    this.notes.replaceChildren(...[notesOf(report)].filter((notes) => notes !== null));
    this.made.textContent = `skein ${report.skein}, ${report.made}`;
  }

  private views(): View[] {
    return VIEWS.filter((view) => view.isThere(this.pack.document));
  }

  /** The view that the address asks for, or the first. */
  private choose(): void {
    const views = this.views();
    this.chosen = views.find((view) => `#${view.name}` === location.hash) ?? views[0];
    this.show();
  }

  private showNames(): void {
    this.nav.replaceChildren(...this.views().map((view) =>
      el('a', { href: `#${view.name}`, 'aria-current': view === this.chosen ? 'page' : undefined },
        view.title)));
  }

  private show(): void {
    const scroll = scrollY;
    this.shown?.stop();
    this.shown = undefined;
    this.showNames();
    this.place.replaceChildren();
    this.place.className = this.chosen?.name ?? '';
    if (this.chosen) this.shown = this.chosen.show(this.place, this.pack);
    else this.place.append(el('p', {}, 'There is nothing in this report.'));
    scrollTo(0, scroll);
  }
}

async function read(bytes: Uint8Array): Promise<ReportPack> {
  const pack = unpack<ReportDocument>(await inflate(bytes));
  if (pack.document.format !== KNOWN_FORMAT) throw new Error('the data is of another version');
  return pack;
}

async function start(): Promise<void> {
  const root = document.getElementById('page') as HTMLElement;
  const text = document.getElementById('data')?.textContent?.trim() ?? '';
  try {
    const isLive = text === '';
    const bytes = isLive ? await fetched() : bytesOfBase64(text);
    const page = new Page(root, await read(bytes));
    if (!isLive) return;
    void keepFresh(bytes, async (fresh) => page.renew(await read(fresh)),
      (text) => { page.status.textContent = text; });
  } catch (error) {
    root.replaceChildren(el('p', { class: 'error' }, `This report cannot be shown: ${String(error)}`));
  }
}

void start();

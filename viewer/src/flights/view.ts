// SPDX-License-Identifier: Apache-2.0
// The view of flights: windows, player, charts.
import { button, choice, el, isPressable, tick } from '../dom';
import { swatchOf } from '../palette';
import type { FlightSet, ReportPack } from '../report';
import { montage, savePicture, saveTable } from '../save';
import type { Shown } from '../shown';
import { CAMERA_NAMES, type CameraName } from './cameras';
import { Clock, SPEEDS } from './clock';
import { colourScales, type ColourScale, rampOf } from './colouring';
import { flightCsv } from './flight_csv';
import { FlightTable } from './flight_table';
import { Pane } from './pane';
import { type FlightRecord, recordsOf } from './record';
import { chartedOf, MOST_CHARTED, stripsOf } from './strip_list';
import { Strips } from './strips';

const TRAILS: [string, string][] = [['1e9', 'whole'], ['20', '20 s'], ['5', '5 s'], ['0', 'none']];
const KEYS = 'Space plays; ← → 1 s (with Shift 0.1 s); N, P episode; '
  + '[ ] target of a mission; 1–4 or C camera; F whom it follows; S side by side; T trail colour. '
  + 'In the windows and the player: ↑ ↓ speed; Home, End.';

/** Of windows and player alone. */
const SCROLLING = ['ArrowUp', 'ArrowDown', 'Home', 'End'];
/** While it plays, readings and charts follow so often, ms. */
const READ_MS = 100;
/** So much after a target came it is the one that is flown to. */
const AFTER_S = 0.001;

class FlightsView {
  private readonly records: FlightRecord[];
  private readonly scales: ColourScale[];
  private readonly clock = new Clock(0);
  private readonly strips: Strips;
  private readonly windows = el('div', { class: 'windows' });
  private readonly legend = el('div', { class: 'legend' });
  /** That there are more flights in view than in the charts, if there are. */
  private readonly charted = el('p', { class: 'hint charted' });
  private readonly play = button('▶', 'play', () => this.toggle());
  private readonly scrubber = el('input', {
    type: 'range', min: 0, max: 1, step: 'any', class: 'scrubber', 'aria-label': 'time',
    oninput: () => this.seek(Number(this.scrubber.value)),
  });
  private readonly shownTime = el('output', { class: 'time', 'aria-live': 'off' });
  private readonly speed = this.select('speed', SPEEDS.map((v) => [String(v), `${v}×`]), '1',
    (value) => { this.clock.speed = Number(value); });
  private readonly episodes: HTMLLabelElement;
  private readonly camera = this.select('camera', CAMERA_NAMES.map((n) => [n, n]), 'overview',
    (value) => this.chooseCamera(value as CameraName));
  private readonly trailColour: HTMLLabelElement;
  private readonly hidden = new Set<number>();
  private panes: Pane[] = [];
  private isSplit = false;
  private episode = 0;
  private followed = 0;
  private trail = 1e9;
  private colouring: number;
  private isDirty = true;
  private frame = 0;
  private before = 0;
  private readAt = 0;

  constructor(place: HTMLElement, private readonly set: FlightSet, pack: ReportPack) {
    this.records = recordsOf(set, pack);
    this.scales = colourScales(set, this.records);
    // Whose path is whose, before how it was flown.
    this.colouring = set.agents.length > 1 ? 0 : 1;
    this.hideSome();
    this.strips = new Strips(stripsOf(set, this.records), set.agents, (t) => this.seek(t));
    const table = new FlightTable(this.records, set.agents, (record, time) => this.goTo(record, time));
    const episodes = [...new Set(this.records.map((record) => record.episode))];
    this.episodes = this.select('episode',
      [...episodes.map((e): [string, string] => [String(e), String(e)]), ['-1', 'all']], '0',
      (value) => this.chooseEpisode(Number(value)));
    this.trailColour = this.select('trails by', this.scales.map((s, i) => [String(i), s.name]),
      String(this.colouring), (value) => this.chooseColouring(Number(value)));
    const split = tick('side by side', false, (isOn) => this.chooseSplit(isOn));
    const trails = this.select('trail', TRAILS, '1e9', (value) => {
      this.trail = Number(value);
      this.isDirty = true;
    });
    place.append(
      el('p', { class: 'hint' }, `${set.task}: ${set.conditions}`),
      this.windows,
      el('div', { class: 'player' },
        button('«', 'to the beginning (Home)', () => this.seek(0)), this.play, this.scrubber,
        this.shownTime, this.speed),
      el('div', { class: 'controls' }, this.episodes, this.camera, split, this.trailColour, trails,
        button('save picture', 'windows and charts as they are, as PNG', () => this.savePicture()),
        button('save data', 'the flights in view as CSV', () => this.saveData()),
        el('details', { class: 'keys' }, el('summary', {}, 'keys'), el('p', {}, KEYS))),
      this.legend, table.element, this.charted, this.strips.element,
    );
    addEventListener('keydown', this.onKey);
    this.rebuild();
    this.frame = requestAnimationFrame(this.tickFrame);
  }

  /** Of many agents two policies and the strongest autopilot are enough to begin with. */
  private hideSome(): void {
    const { agents } = this.set;
    const strongest = agents.findIndex((name) => name.startsWith('autopilot'));
    agents.forEach((_, agent) => {
      if (agent > 1 && agent !== strongest) this.hidden.add(agent);
    });
  }

  private select(
    label: string, options: [string, string][], chosen: string, act: (value: string) => void,
  ): HTMLLabelElement {
    return choice(label, options, chosen, (value) => {
      act(value);
      this.isDirty = true;
    });
  }

  private setSelected(label: HTMLLabelElement, value: string): void {
    (label.querySelector('select') as HTMLSelectElement).value = value;
  }

  /** The records in view. */
  private shown(): FlightRecord[] {
    return this.records.filter((record) =>
      (this.episode < 0 || record.episode === this.episode) && !this.hidden.has(record.agent));
  }

  /** Windows anew: the episode, whom they show, or the colours are others. */
  private rebuild(): void {
    const shown = this.shown();
    this.panes.forEach((pane) => pane.dispose());
    const agents = [...new Set(shown.map((record) => record.agent))];
    const groups = this.isSplit
      ? agents.map((agent) => shown.filter((record) => record.agent === agent)) : [shown];
    this.followed = Math.min(this.followed, Math.max(shown.length - 1, 0));
    this.panes = groups.filter((group) => group.length > 0).map((group) =>
      new Pane(group, this.set, this.isSplit ? 0 : this.followed, () => { this.isDirty = true; }));
    this.windows.replaceChildren(...this.panes.map((pane) => pane.element));
    this.windows.classList.toggle('split', this.panes.length > 1);
    this.clock.end = Math.max(0.02, ...shown.map((record) => record.duration));
    this.clock.seek(this.clock.time);
    this.scrubber.max = String(this.clock.end);
    const charted = chartedOf(shown);
    this.charted.textContent = charted.length < shown.length
      ? `charts: ${MOST_CHARTED} of the ${shown.length} flights in view` : '';
    this.strips.draw(charted, this.clock.end);
    for (const pane of this.panes) {
      pane.fit();
      pane.scene.cameras.onTurned = () => this.turnAll(pane);
    }
    this.chooseCamera((this.camera.querySelector('select') as HTMLSelectElement).value as CameraName);
    this.chooseColouring(this.colouring);
  }

  /** Windows and charts have the colours that they were made with. */
  recolour(): void {
    const scroll = scrollY;
    const before = this.panes.map((pane) => pane.scene.cameras);
    this.rebuild();
    this.panes.forEach((pane, i) => pane.scene.cameras.resume(before[i]));
    scrollTo(0, scroll);
  }

  /** The other windows look the same way. */
  private turnAll(turned: Pane): void {
    this.isDirty = true;
    for (const pane of this.panes) {
      if (pane !== turned) pane.scene.cameras.copyView(turned.scene.cameras);
    }
  }

  private chooseCamera(name: CameraName): void {
    this.setSelected(this.camera, name);
    for (const pane of this.panes) pane.scene.choose(name, this.clock.time);
    this.isDirty = true;
  }

  private chooseEpisode(episode: number): void {
    this.episode = episode;
    this.setSelected(this.episodes, String(episode));
    this.clock.time = 0;
    this.rebuild();
  }

  /** To a moment of a flight, which is followed. */
  private goTo(record: FlightRecord, time: number): void {
    this.hidden.delete(record.agent);
    this.episode = record.episode;
    this.setSelected(this.episodes, String(record.episode));
    this.followed = this.shown().indexOf(record);
    this.rebuild();
    this.seek(time);
    this.windows.scrollIntoView({ block: 'nearest' });
  }

  private chooseSplit(isOn: boolean): void {
    this.isSplit = isOn;
    this.rebuild();
  }

  private chooseColouring(index: number): void {
    this.colouring = index;
    this.setSelected(this.trailColour, String(index));
    for (const pane of this.panes) pane.scene.colourTrails(this.scales[index].share);
    this.drawLegend();
    this.isDirty = true;
  }

  /** Agents, which can be hidden, how they ended, and the ramp of the trails. */
  private drawLegend(): void {
    const rows = this.set.agents.map((name, agent) => {
      const own = this.records.filter((record) => record.agent === agent
        && (this.episode < 0 || record.episode === this.episode));
      const end = own.length === 1 ? `: ${own[0].outcome()}` : '';
      const box = tick(name + end, !this.hidden.has(agent), (isOn) => {
        if (isOn) this.hidden.delete(agent);
        else if (this.hidden.size + 1 < this.set.agents.length) this.hidden.add(agent);
        this.rebuild();
      });
      const swatch = el('span', { class: 'swatch' });
      swatch.style.background = swatchOf(agent);
      box.prepend(swatch);
      return box;
    });
    this.legend.replaceChildren(...rows, ...rampOf(this.scales[this.colouring]));
  }

  private savePicture(): void {
    const windows = this.panes.flatMap((pane) => {
      const canvas = pane.picture();
      const title = `${pane.title}, ${this.clock.time.toFixed(2)} s`;
      return canvas ? [{ title, canvas }] : [];
    });
    savePicture('flights.png', montage(windows, this.strips.pictures()));
  }

  private saveData(): void {
    saveTable('flights.csv', flightCsv(this.shown(), this.set.agents));
  }

  private toggle(): void {
    this.clock.toggle();
    this.isDirty = true;
  }

  private seek(time: number): void {
    this.clock.seek(time);
    this.isDirty = true;
  }

  private step(by: number): void {
    const count = new Set(this.records.map((record) => record.episode)).size;
    this.chooseEpisode((Math.max(this.episode, 0) + by + count) % count);
  }

  /** To the beginning of the next (1) or the previous (-1) target of the followed mission. */
  private stepTarget(by: number): void {
    const record = this.shown()[this.followed];
    const now = record.targetAt(this.clock.time);
    // A moment after a target came one means the target before.
    const isEarly = this.clock.time - record.targetTimes(now)[0] < 1;
    const next = by > 0 ? now + 1 : now - (isEarly ? 1 : 0);
    const shown = Math.min(Math.max(next, 0), record.newTargets.length);
    this.seek(record.targetTimes(shown)[0] + (shown > 0 ? AFTER_S : 0));
  }

  private follow(): void {
    this.followed = (this.followed + 1) % Math.max(this.shown().length, 1);
    for (const pane of this.panes) pane.scene.followed = this.isSplit ? 0 : this.followed;
    this.chooseCamera((this.camera.querySelector('select') as HTMLSelectElement).value as CameraName);
  }

  private readonly keys: Record<string, (event: KeyboardEvent) => void> = {
    ' ': () => this.toggle(),
    ArrowLeft: (event) => this.seek(this.clock.time - (event.shiftKey ? 0.1 : 1)),
    ArrowRight: (event) => this.seek(this.clock.time + (event.shiftKey ? 0.1 : 1)),
    ArrowUp: () => this.shiftSpeed(1),
    ArrowDown: () => this.shiftSpeed(-1),
    Home: () => this.seek(0),
    End: () => this.seek(this.clock.end),
    n: () => this.step(1),
    p: () => this.step(-1),
    '[': () => this.stepTarget(-1),
    ']': () => this.stepTarget(1),
    f: () => this.follow(),
    s: () => {
      const box = document.querySelectorAll<HTMLInputElement>('.controls .tick input')[0];
      box.click();
    },
    t: () => this.chooseColouring((this.colouring + 1) % this.scales.length),
    c: () => {
      const place = CAMERA_NAMES.indexOf(this.panes[0].scene.cameras.chosen);
      this.chooseCamera(CAMERA_NAMES[(place + 1) % CAMERA_NAMES.length]);
    },
  };

  private readonly onKey = (event: KeyboardEvent): void => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.tagName === 'SELECT') return;
    if ((event.key === ' ' || event.key === 'Enter') && isPressable(target)) return;
    const number = CAMERA_NAMES[Number(event.key) - 1];
    const act = this.keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!number && !act) return;
    // Elsewhere they scroll the page.
    if (SCROLLING.includes(event.key) && !target.closest('.windows, .player')) return;
    event.preventDefault();
    if (number) this.chooseCamera(number);
    else act(event);
  };

  private shiftSpeed(by: number): void {
    this.clock.shift(by);
    this.setSelected(this.speed, String(this.clock.speed));
  }

  private readonly tickFrame = (now: number): void => {
    this.frame = requestAnimationFrame(this.tickFrame);
    const seconds = Math.min((now - this.before) / 1000, 0.1);
    this.before = now;
    const wasPlaying = this.clock.isPlaying;
    this.clock.advance(seconds);
    if (!this.isDirty && !wasPlaying) return;
    this.isDirty = false;
    // Where time jumps, a chase does not lag.
    const lag = wasPlaying ? seconds : Infinity;
    for (const pane of this.panes) pane.show(this.clock.time, this.trail, lag);
    if (!this.clock.isPlaying || now - this.readAt >= READ_MS) this.read(now);
    this.scrubber.value = String(this.clock.time);
    this.scrubber.setAttribute('aria-valuetext', `${this.clock.time.toFixed(2)} s`);
    this.shownTime.textContent = `${this.clock.time.toFixed(2)} / ${this.clock.end.toFixed(2)} s`;
    this.sayPlaying();
  };

  private sayPlaying(): void {
    const says = this.clock.isPlaying ? 'stop' : 'play';
    if (this.play.getAttribute('aria-label') === says) return;
    this.play.textContent = this.clock.isPlaying ? '⏸' : '▶';
    this.play.setAttribute('aria-label', says);
    this.play.title = `${says} (Space)`;
  }

  private read(now: number): void {
    this.readAt = now;
    for (const pane of this.panes) pane.read(this.clock.time);
    this.strips.mark(this.clock.time);
  }

  stop(): void {
    cancelAnimationFrame(this.frame);
    removeEventListener('keydown', this.onKey);
    this.panes.forEach((pane) => pane.dispose());
    this.strips.stop();
  }
}

/** Shows the sets of flights, one at a time. */
export function showFlights(place: HTMLElement, pack: ReportPack): Shown {
  const { flights } = pack.document;
  const body = el('div');
  if (flights.length > 1) {
    place.append(choice('flights of', flights.map((set, i) =>
      [String(i), `${set.agents.join(', ')}: ${set.conditions}`]), '0', (value) => {
        view.stop();
        body.replaceChildren();
        view = new FlightsView(body, flights[Number(value)], pack);
      }));
  }
  place.append(body);
  let view = new FlightsView(body, flights[0], pack);
  // A flight that is being looked at goes on; what is fresh of it is shown when one comes back.
  return { stop: () => view.stop(), renew: () => undefined, recolour: () => view.recolour() };
}

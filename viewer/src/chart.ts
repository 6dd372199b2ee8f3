// SPDX-License-Identifier: Apache-2.0
// Charts of uPlot in the page's colours.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { el } from './dom';
import { dashStyleOf, styleColour } from './palette';
import type { Key, Picture } from './save';
import type { SharedRange } from './shared_range';

/** Of a legend's marks, pixels: what a double edge takes. */
const MARK_WIDTH = 3;

export interface ChartOptions {
  title: string;
  height: number;
  series: uPlot.Series[];
  bands?: uPlot.Band[];
  /** Charts of one group show one cursor. */
  group: string;
  /** Of all charts that show the same part of x; without one a chart shows all that it has. */
  range?: SharedRange;
  nameX: string;
  formatX: (x: number) => string;
  /** Of a tick, with all its digits. */
  tickX: (x: number) => string;
  scales?: uPlot.Scales;
  axes?: uPlot.Axis[];
  hooks?: uPlot.Hooks.Arrays;
  legend?: boolean;
  drag?: boolean;
}

/** A number as legends show it. */
export function formatted(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(1);
  return String(Number(value.toPrecision(size >= 1000 ? 5 : 3)));
}

/** More than a tick has, which is a multiple of a step of few digits, and fewer than show a rounding
 * error. */
export const TICK_DIGITS = 10;

/** A tick of an axis, with all its digits. */
export function tickText(value: number): string {
  const exact = Number(value.toPrecision(TICK_DIGITS));
  const size = Math.abs(exact);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? exact.toExponential() : String(exact);
}

export function axis(overrides: uPlot.Axis = {}): uPlot.Axis {
  return {
    stroke: styleColour('--muted'),
    grid: { stroke: styleColour('--grid'), width: 1 },
    ticks: { stroke: styleColour('--grid'), width: 1, size: 4 },
    font: '11px system-ui, sans-serif',
    size: 50,
    values: (_, splits) => splits.map((value) => (value === null ? '' : tickText(value))),
    ...overrides,
  };
}

/** What lets a chart have its x range from others, and set it for them. */
function sharing(range: SharedRange): {
  scale: uPlot.Scale; bind: uPlot.Cursor.Bind; hooks: uPlot.Hooks.Arrays;
} {
  return {
    scale: { time: false, range: () => [range.limits.min, range.limits.max] },
    bind: {
      dblclick: (_, __, handler) => (event) => {
        range.showAll();
        return handler(event);
      },
    },
    hooks: {
      setSelect: [(plot) => {
        const { left, width } = plot.select;
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        // Charts that follow the one that is dragged over have no event of their own.
        if (!plot.cursor.event) return;
        range.show({ min: plot.posToVal(left, 'x'), max: plot.posToVal(left + width, 'x') });
      }],
    },
  };
}

/** What a legend shows a series by: of an area its colour, not that of its edge. */
function keyColour({ fill, stroke }: uPlot.Series): string {
  return String(fill ?? stroke);
}

/** A chart in `place`, as wide as it, until `stop` is called. */
export class Chart {
  readonly plot: uPlot;
  /** Beside the title: what the curves are worth somewhere. */
  readonly readout = el('span', { class: 'readout' });
  private readonly observer: ResizeObserver;

  constructor(
    place: HTMLElement, private readonly options: ChartOptions, data: uPlot.AlignedData,
  ) {
    const figure = el('figure', { class: 'chart', 'aria-label': options.title },
      el('figcaption', {}, options.title, this.readout));
    place.append(figure);
    const width = () => Math.max(figure.clientWidth, 120);
    const shared = options.range && sharing(options.range);
    this.plot = new uPlot({
      width: width(),
      height: options.height,
      series: [
        { label: options.nameX, value: (_, x) => (x === null ? '–' : options.formatX(x)) },
        ...options.series,
      ],
      bands: options.bands,
      scales: { x: shared?.scale ?? { time: false }, ...options.scales },
      axes: options.axes ?? [
        axis({ size: 28, space: 60, values: (_, xs) => xs.map((x) => options.tickX(x)) }),
        axis(),
      ],
      cursor: {
        sync: { key: options.group, setSeries: false },
        drag: { x: options.drag ?? true, y: false, setScale: !shared },
        bind: shared?.bind,
        points: { size: 6 },
      },
      legend: { show: options.legend ?? true, markers: {
        width: MARK_WIDTH,
        stroke: (_, i) => keyColour(options.series[i - 1]),
        dash: (_, i) => dashStyleOf(options.series[i - 1].dash),
      } },
      hooks: { ...shared?.hooks, ...options.hooks },
    }, data, figure);
    this.legend();
    this.plot.ctx.canvas.setAttribute('aria-hidden', 'true');
    options.range?.join(this.plot);
    this.observer = new ResizeObserver(() => {
      if (width() !== this.plot.width) {
        this.plot.setSize({ width: width(), height: options.height });
      }
    });
    this.observer.observe(figure);
  }

  /** Names of lines are buttons for the keyboard and for readers of screens, too. */
  private legend(): void {
    const [, ...names] = this.plot.root.querySelectorAll<HTMLElement>('.u-legend .u-series th');
    names.forEach((name) => {
      name.tabIndex = 0;
      name.setAttribute('role', 'button');
      name.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        name.click();
      });
    });
    this.sayShown(names);
    this.plot.hooks.setSeries = [() => this.sayShown(names)];
  }

  private sayShown(names: HTMLElement[]): void {
    names.forEach((name, i) =>
      name.setAttribute('aria-pressed', String(this.plot.series[i + 1].show !== false)));
  }

  /** Other numbers of the same series; the pointer, and which series are shown, stay. */
  renew(series: uPlot.Series[], data: uPlot.AlignedData): void {
    series.forEach(({ value }, i) => {
      if (value) this.plot.series[i + 1].value = value;
    });
    this.plot.setData(data);
  }

  /** Which lines are not shown. */
  get hidden(): number[] {
    return this.plot.series.flatMap(({ show }, i) => (i > 0 && show === false ? [i] : []));
  }

  hide(lines: number[]): void {
    for (const line of lines) this.plot.setSeries(line, { show: false });
  }

  /** As it is, with the names of the lines that are shown. */
  picture(): Picture {
    const { title, series } = this.options;
    const keys = series.flatMap((line, i): Key[] => (line.label && this.plot.series[i + 1].show
      ? [{ name: String(line.label), colour: keyColour(line), dash: line.dash ?? [] }] : []));
    return { title, canvas: this.plot.ctx.canvas, keys };
  }

  stop(): void {
    this.observer.disconnect();
    this.options.range?.leave(this.plot);
    this.plot.destroy();
  }
}

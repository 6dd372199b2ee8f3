# SPDX-License-Identifier: Apache-2.0
"""Training curves: mean and band over the seeds of a setting, a panel for every task."""
import math
import os

from plotting import svg
from plotting.axes import Panel, in_words, padded, ticks
from plotting.records import PlotError, read_autopilot, read_curve, read_seconds_per_step, read_task

BAND_OPACITY = 0.18
LEFT, TOP, ASIDE, PANEL_HEIGHT = 64, 76, 70, 300
MINUTES_HEIGHT = 32  # above a panel
PERCENT_RANGE = (0.0, 112.0)  # leaves room for words above 100
MOST_DOTS = 40  # that still show where a curve has points
TICK_PIXELS = 85  # about, from one to the next
TASK_TITLES = {"heading": "Heading: a new altitude, heading and speed",
               "control": "Control: a new pitch, heading and speed",
               "tracking": "Tracking: a point in space"}
COLUMN_TITLES = {"evaluation_success_rate": "Episodes that reach their target, flown by the mean action, %",
                 "success_rate": "Training episodes that reach their target, sampled actions, %",
                 "return_mean": "Mean return of the training episodes"}


class Setting:
    """Runs that differ in their seed alone: the mean of a column over them, and its lowest and highest."""

    def __init__(self, runs, name, column, scale):
        self.task, self.name, self.runs = read_task(runs[0]), name, runs
        for run in runs:
            if read_task(run) != self.task:
                raise PlotError(f"{run}: of another task than {runs[0]}, with which --seeds puts it together")
        curves = [[(steps / 1e6, value * scale) for steps, value in read_curve(run, column)] for run in runs]
        first, last = max(c[0][0] for c in curves), min(c[-1][0] for c in curves)
        steps = sorted({x for curve in curves for x, _ in curve if first <= x <= last})
        columns = [[interpolated(curve, x) for curve in curves] for x in steps]
        self.mean = [(x, sum(values) / len(values)) for x, values in zip(steps, columns)]
        self.low = [(x, min(values)) for x, values in zip(steps, columns)]
        self.high = [(x, max(values)) for x, values in zip(steps, columns)]

    def minutes_per_million(self):
        """The mean over the runs that have recorded times; None without any."""
        rates = [rate for rate in map(read_seconds_per_step, self.runs) if rate]
        return sum(rates) / len(rates) * 1e6 / 60 if rates else None


def interpolated(curve, x):
    """The curve's value at x, which lies between its first point and its last."""
    before = max((point for point in curve if point[0] <= x), key=lambda point: point[0])
    after = min((point for point in curve if point[0] >= x), key=lambda point: point[0])
    if before[0] == after[0]:
        return before[1]
    return before[1] + (after[1] - before[1]) * (x - before[0]) / (after[0] - before[0])


def by_task(texts, option):
    """{task: number} of ["heading=5.8", ...]; a number alone is for the task "", that is, for any."""
    result = {}
    for text in texts:
        task, _, value = text.rpartition("=")
        try:
            result[task] = float(value)
        except ValueError:
            result[task] = math.nan
        if not math.isfinite(result[task]):
            raise PlotError(f"{option} {text}: give a number, or TASK=NUMBER")
    return result


def settings_of(options, scale):
    """The runs, grouped: by task, or if told so, as many in a row as there are seeds."""
    if options.seeds:
        groups = [options.runs[i:i + options.seeds] for i in range(0, len(options.runs), options.seeds)]
    else:
        tasks = {}
        for run in options.runs:
            tasks.setdefault(read_task(run), []).append(run)
        groups = list(tasks.values())
    names = options.names or [os.path.basename(os.path.normpath(runs[0])) for runs in groups]
    if len(names) != len(groups):
        raise PlotError(f"--names: {len(names)} names for {len(groups)} settings")
    return [Setting(runs, name, options.column, scale) for runs, name in zip(groups, names)]


def autopilots(options, scale, unit):
    """{task: (words, value)} of the autopilots' figures."""
    figures = {task: ("autopilot", value) for task, value in by_task(options.autopilot, "--autopilot").items()}
    for path in options.comparison:
        task, name, rate = read_autopilot(path)
        figures[task] = (f"{name.partition(':')[2]} autopilot".lstrip(), rate * scale)
    return {task: (f"{name}: {value:.1f}{unit}", value) for task, (name, value) in figures.items()}


def draw_minutes(panel, per_million, machine):
    """Minutes on the upper edge."""
    last = panel.x_range[1] * per_million
    scale = Panel(panel.left, panel.top, panel.width, panel.height, (0.0, last), (0, 1))
    for value in ticks(0.0, last, panel.width / TICK_PIXELS):
        x = scale.x(value)
        panel.elements.append(svg.line([(x, panel.top), (x, panel.top - 5)], svg.GREY, 1))
        panel.elements.append(svg.text(x, panel.top - 10, f"{value:,.5g}", "middle", 12))
    panel.elements.append(svg.line([(panel.left, panel.top), (panel.right, panel.top)], svg.GREY, 1))
    panel.elements.append(svg.text((panel.left + panel.right) / 2, panel.top - 28, f"minutes{machine}", "middle"))


def draw_autopilot(panel, words, value):
    panel.curve([(panel.x_range[0], value), (panel.x_range[1], value)], svg.INK, 1.5, ' stroke-dasharray="7 4"')
    panel.elements.append(svg.haloed(panel.right - 6, panel.y(value) - 8, words, "end"))


def draw_setting(panel, setting, colour):
    panel.band(setting.low, setting.high, colour, BAND_OPACITY)
    panel.curve(setting.mean, colour, 2.2)
    for x, y in setting.mean if len(setting.mean) <= MOST_DOTS else []:
        panel.elements.append(svg.circle((panel.x(x), panel.y(y)), 2.6, colour))


def task_panel(place, settings, y_range, colours, autopilot):
    """The panel of one task with its grid and curves, at place = (left, top, width); autopilot may be None."""
    left, top, width = place
    steps = (0.0, max(setting.mean[-1][0] for setting in settings))
    panel = Panel(left, top, width, PANEL_HEIGHT, steps, y_range)
    across, up = ticks(*steps, width / TICK_PIXELS), ticks(*y_range, 6)
    panel.grid(across, up)
    panel.label_bottom(across)
    panel.label_left(up)
    panel.frame_bottom()
    title = TASK_TITLES.get(settings[0].task, settings[0].task.capitalize())
    panel.elements.append(svg.bold(left, 52, title))
    panel.elements.append(svg.text(left + width / 2, panel.bottom + 38, "control steps, million", "middle"))
    if autopilot:
        draw_autopilot(panel, *autopilot)
    for setting in settings:
        draw_setting(panel, setting, colours[setting])
    return panel


def legend_entries(settings, colours):
    several, entries = len(settings) > 1, []
    for setting in settings:
        seeds = f"mean of {len(setting.runs)} seeds" if len(setting.runs) > 1 else "one seed"
        words = f"{setting.name}, {seeds}" if several else seeds
        entries.append((svg.line_sample(colours[setting], 2.2), words))
    if any(len(setting.runs) > 1 for setting in settings):
        shade = svg.GREY if several else colours[settings[0]]
        entries.append((svg.band_sample(shade, BAND_OPACITY), "lowest to highest seed"))
    return entries


def colours_of(settings, tasks):
    """A colour for each setting; one for all if the panels' titles tell them apart."""
    shades = svg.COLOURS if len(settings) > len(tasks) else svg.COLOURS[:1]
    return {setting: shades[i % len(shades)] for i, setting in enumerate(settings)}


def minutes_of(settings, options):
    """{task: minutes for a million steps}, as given or as recorded; without tasks of which neither is known."""
    given, result = by_task(options.minutes, "--minutes"), {}
    for setting in settings:
        whole = given.get(setting.task, given.get(""))
        if whole is not None and whole <= 0:
            raise PlotError(f"--minutes {whole:g}: a training takes more than no time")
        rate = whole / setting.mean[-1][0] if whole else setting.minutes_per_million()
        if rate:
            result.setdefault(setting.task, rate)
    return result


def draw(options):
    scale, unit = (100.0, " %") if options.column.endswith("success_rate") else (1.0, "")
    settings = settings_of(options, scale)
    y_range = PERCENT_RANGE if unit else padded([y for s in settings for _, y in s.low + s.high])
    tasks = list(dict.fromkeys(setting.task for setting in settings))
    colours, minutes = colours_of(settings, tasks), minutes_of(settings, options)
    autopilot = autopilots(options, scale, unit)
    left, top, width = LEFT, TOP + (MINUTES_HEIGHT if minutes else 0), 700 if len(tasks) == 1 else 400
    elements = []
    for task in tasks:
        own, figure = [s for s in settings if s.task == task], autopilot.get(task, autopilot.get(""))
        panel = task_panel((left, top, width), own, y_range, colours, figure)
        if task in minutes:
            draw_minutes(panel, minutes[task], f" on {options.machine}" if options.machine else "")
        elements += panel.elements
        left += width + ASIDE
    shown = settings if len(settings) > len(tasks) else settings[:1]
    lines, bottom = svg.legend(LEFT, top + PANEL_HEIGHT + 70, legend_entries(shown, colours), left - ASIDE)
    title = options.title or COLUMN_TITLES.get(options.column, in_words(options.column).capitalize())
    svg.write(options.out, left - ASIDE + 30, bottom + 22, title, elements + lines)

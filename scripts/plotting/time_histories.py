# SPDX-License-Identifier: Apache-2.0
"""Recorded flights over time: what the targets ask for, what was flown, and the actions."""
from plotting import svg
from plotting.axes import Panel, in_words, padded, ticks
from plotting.flights import episodes_of, read_recordings
from plotting.records import PlotError

LEFT, HEADS, ASIDE, BETWEEN = 72, 60, 26, 30
LEAST_WIDTH = 480
PANEL_WIDTH, TARGET_HEIGHT, ACTION_HEIGHT = 220, 120, 44
DASHED = ' stroke-dasharray="6 4"'


def action_words(column):
    """action_pitch -> "pitch action"; action_target_pitch -> "target pitch (high-level action)"."""
    name = column[len("action_"):].replace("_", " ")
    return f"{name} (high-level action)" if name.startswith("target ") else f"{name} action"


def rows_of(recordings):
    """What is drawn, from top to bottom: the targets' quantities, then the actions of any agent."""
    columns = dict.fromkeys(column for recording in recordings for column in recording.flights[0].values)
    return recordings[0].flights[0].targets, [column for column in columns if column.startswith("action_")]


def quantity_range(episodes, quantity):
    values = []
    for episode in episodes:
        for flight in episode.values():
            values += [v for series in flight.flown_and_target(quantity) for v in series if v is not None]
    return padded(values)


def draw_target(panel, flight, quantity, tolerance):
    """The target, dashed, with its tolerances if they are known."""
    target = flight.points(flight.flown_and_target(quantity)[1])
    if quantity in tolerance:
        width = tolerance[quantity]
        panel.band([(t, y - width) for t, y in target], [(t, y + width) for t, y in target], svg.GREY, 0.3)
    panel.curve(target, svg.INK, 1.3, DASHED)


def draw_cell(panel, episode, row, tolerance):
    """One quantity or action of one episode, of all agents."""
    flights = list(episode.items())
    if not row.startswith("action_"):
        draw_target(panel, max(episode.values(), key=lambda flight: flight.duration), row, tolerance)
    for recording, flight in flights[::-1]:  # the first agent on top
        if row.startswith("action_"):
            panel.curve(flight.points(flight.values.get(row, [])), recording.colour, 1)
        else:
            panel.curve(flight.points(flight.flown_and_target(row)[0]), recording.colour, 1.8)


def draw_column_head(left, index, episode, is_only):
    """Number of the episode, and how each flight ended."""
    elements = [svg.bold(left, HEADS, f"flight {index + 1}")]
    for i, (recording, flight) in enumerate(episode.items()):
        y = HEADS + 17 * (i + 1)
        colour = svg.INK if is_only else recording.colour
        elements.append(svg.text(left, y, f"{flight.end} after {flight.duration:.1f} s", size=12, fill=colour))
    return elements


def draw_row(top, height, row, episodes, x_range, tolerance, is_last):
    """A row of panels, one for each episode."""
    is_action = row.startswith("action_")
    y_range = (-1.1, 1.1) if is_action else quantity_range(episodes, row)
    up, across = (-1, 0, 1) if is_action else ticks(*y_range, 4), ticks(*x_range, 4)
    words = action_words(row) if is_action else in_words(row)
    elements = [svg.bold(LEFT, top - 8, words, size=12)]
    for column, episode in enumerate(episodes):
        panel = Panel(LEFT + column * (PANEL_WIDTH + ASIDE), top, PANEL_WIDTH, height, x_range, y_range)
        panel.grid(across, up)
        if column == 0:
            panel.label_left(up, 11)
        if is_last:
            panel.label_bottom(across)
        draw_cell(panel, episode, row, tolerance)
        elements += panel.elements
    return elements


def legend_entries(recordings, has_tolerance):
    entries = [(svg.line_sample(recording.colour), recording.name) for recording in recordings]
    entries.append((svg.line_sample(svg.INK, 1.3, DASHED), "target"))
    if has_tolerance:
        entries.append((svg.band_sample(svg.GREY, 0.3), "tolerance"))
    return entries


def check_columns(recordings):
    """Every target comes with what is compared with it."""
    for recording in recordings:
        flight = recording.flights[0]
        for column in flight.targets + ["error_" + quantity for quantity in flight.targets]:
            if column not in flight.values:
                raise PlotError(f"{flight.path}: no column {column}; there are {', '.join(flight.values)}")


def draw_columns(episodes, rows, quantities, tolerance):
    """All panels below the episodes' heads; the elements and the height at which they end."""
    flights = [flight for episode in episodes for flight in episode.values()]
    x_range = (0.0, max(flight.duration for flight in flights) or 1.0)
    top = HEADS + 17 * max(len(episode) for episode in episodes) + 40
    elements = []
    for row in rows:
        height = TARGET_HEIGHT if row in quantities else ACTION_HEIGHT
        elements += draw_row(top, height, row, episodes, x_range, tolerance, row == rows[-1])
        top += height + BETWEEN
    return elements, top


def draw(options):
    recordings = read_recordings(options, [])
    check_columns(recordings)
    episodes = episodes_of(recordings)
    quantities, actions = rows_of(recordings)
    elements, top = draw_columns(episodes, quantities + actions, quantities, options.tolerance)
    for column, episode in enumerate(episodes):
        elements += draw_column_head(LEFT + column * (PANEL_WIDTH + ASIDE), column, episode, len(recordings) == 1)
    right = max(LEFT + len(episodes) * (PANEL_WIDTH + ASIDE), LEAST_WIDTH)
    elements.append(svg.text((LEFT + right - ASIDE) / 2, top + 8, "time, s", "middle"))
    lines, bottom = svg.legend(LEFT, top + 36, legend_entries(recordings, bool(options.tolerance)), right)
    svg.write(options.out, right, bottom + 20, options.title or "Recorded flights", elements + lines)

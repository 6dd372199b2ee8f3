# SPDX-License-Identifier: Apache-2.0
"""Flights that skein eval or compare --flights recorded."""
import math
import os

from plotting import svg
from plotting.records import PlotError, number, read_table


def unwrapped(degrees):
    """The same angles without jumps of 360 degrees."""
    result = []
    for angle in degrees:
        is_first = angle is None or not result or result[-1] is None
        result.append(angle if is_first else result[-1] + math.remainder(angle - result[-1], 360))
    return result


class Flight:
    """One recorded episode: its values by column, one for each row."""

    def __init__(self, rows, columns, path):
        self.path = path
        self.episode = rows[0]["episode"]
        self.end = (rows[-1]["termination"] or "unfinished").replace("_", " ")
        self.values = {column: [number(row, column, path) for row in rows] for column in columns}
        self.times = self.values["time_s"]
        if None in self.times:
            raise PlotError(f"{path}: column time_s has an empty cell")

    @property
    def duration(self):
        return self.times[-1]

    @property
    def targets(self):
        """The columns for which the flight has a target, without their prefix."""
        return [name[len("target_"):] for name in self.values if name.startswith("target_")]

    @property
    def identity(self):
        """Equal for flights of the same episode by different agents."""
        starts = [column for column in ("north_ft", "east_ft", "altitude_ft") if column in self.values]
        asked = ["target_" + column for column in self.targets]
        return (self.episode, *(self.values[column][0] for column in starts + asked))

    def flown_and_target(self, quantity):
        """The values of a quantity, and its target; of angles without jumps, and near each other."""
        flown = self.values[quantity]
        if not quantity.endswith("_deg"):
            return flown, self.values["target_" + quantity]
        errors = self.values["error_" + quantity]
        flown = unwrapped(flown)
        targets = [None if None in pair else sum(pair) for pair in zip(flown, errors)]
        return flown, unwrapped(targets)

    def points(self, values):
        """The points (time, value) where there is a value."""
        return [(time, value) for time, value in zip(self.times, values) if value is not None]


def read_flights(path, wanted, episodes):
    """The flights of a file of skein eval --flights, of `episodes` only (all if empty)."""
    rows, columns = read_table(path, ["episode", "time_s", "termination"] + wanted)
    groups = {}
    for row in rows:
        groups.setdefault(row["episode"], []).append(row)
    chosen = episodes or list(groups)
    for episode in chosen:
        if episode not in groups:
            raise PlotError(f"{path}: no episode {episode}; there are {', '.join(groups) or 'none'}")
    if not chosen:
        raise PlotError(f"{path}: holds no flights")
    kept = [column for column in columns if column not in ("episode", "termination")]
    return [Flight(groups[episode], kept, path) for episode in chosen]


def agent_of(path):
    """The agent's name in FILE.AGENT.csv, as skein compare --flights names files; else FILE."""
    stem = os.path.basename(path).removesuffix(".csv")
    return stem.partition(".")[2] or stem


class Recording:
    """An agent's flights, and how they are drawn."""

    def __init__(self, path, name, colour, wanted, episodes):
        self.name, self.colour = name, colour
        self.flights = read_flights(path, wanted, episodes)


def read_recordings(options, wanted):
    """The recordings of all files, which are of one task."""
    names = options.names or [agent_of(path) for path in options.files]
    if len(names) != len(options.files):
        raise PlotError(f"--names: {len(names)} names for {len(options.files)} files")
    recordings = [Recording(path, name, svg.COLOURS[i % len(svg.COLOURS)], wanted, options.episodes)
                  for i, (path, name) in enumerate(zip(options.files, names))]
    first = recordings[0].flights[0]
    for flight in (recording.flights[0] for recording in recordings):
        if flight.targets != first.targets:
            raise PlotError(f"{flight.path}: flights of another task than in {first.path}; draw them apart")
    for column in options.tolerance:
        if column not in first.targets:
            raise PlotError(f"--tolerance: {column} has no target; {', '.join(first.targets) or 'nothing'} has")
    return recordings


def episodes_of(recordings):
    """The episodes: of each, {recording: its flight}. Flights of different episodes do not share one."""
    episodes = {}
    for recording in recordings:
        for flight in recording.flights:
            episodes.setdefault(flight.identity, {})[recording] = flight
    return list(episodes.values())

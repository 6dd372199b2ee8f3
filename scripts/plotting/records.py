# SPDX-License-Identifier: Apache-2.0
"""Tables, runs and comparisons that Skein has written."""
import csv
import json
import math
import os
import re


class PlotError(Exception):
    """Says in one line what was wrong, where, and what would be right."""


def read_table(path, wanted):
    """The rows of a CSV file, which has all `wanted` columns, and its columns."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            table = csv.DictReader(file)
            columns = table.fieldnames or []
            rows = list(table)
    except OSError as error:
        raise PlotError(f"{path}: {error.strerror}") from error
    except (csv.Error, UnicodeDecodeError) as error:
        raise PlotError(f"{path}: not a CSV file") from error
    if not columns:
        raise PlotError(f"{path}: the file is empty")
    for column in wanted:
        if column not in columns:
            raise PlotError(f"{path}: no column {column}; there are {', '.join(columns)}")
    return rows, columns


def number(row, column, path):
    """A cell's number; None if it is empty or not finite."""
    text = row[column]
    try:
        value = float(text) if text else math.nan
    except ValueError as error:
        raise PlotError(f"{path}: column {column} holds {text!r}, which is no number") from error
    return value if math.isfinite(value) else None


def read_curve(run, column):
    """The points (control steps, value) of a column of a run's metrics.csv."""
    path = os.path.join(run, "metrics.csv")
    rows, _ = read_table(path, ["env_steps", column])
    points = [(number(row, "env_steps", path), number(row, column, path)) for row in rows]
    points = [point for point in points if None not in point]
    if not points:
        raise PlotError(f"{path}: column {column} has no values yet")
    return points


def read_task(run):
    """The task of a run by its config.toml; empty if there is none."""
    try:
        with open(os.path.join(run, "config.toml"), encoding="utf-8") as file:
            found = re.search(r'^task = "(\w+)"', file.read(), re.MULTILINE)
    except (OSError, UnicodeDecodeError):
        return ""
    return found.group(1) if found else ""


def read_seconds_per_step(run):
    """The mean time of a control step by a run's timing.csv; None if there is none."""
    path = os.path.join(run, "timing.csv")
    if not os.path.exists(path):
        return None
    parts = ["rollout_s", "update_s", "evaluation_s"]
    rows, _ = read_table(path, ["env_steps"] + parts)
    seconds = sum(number(row, part, path) or 0.0 for row in rows for part in parts)
    steps = max((number(row, "env_steps", path) or 0.0 for row in rows), default=0.0)
    return seconds / steps if steps else None


def read_autopilot(path):
    """Task, name and success rate of the first autopilot in what skein compare --json wrote."""
    try:
        with open(path, encoding="utf-8") as file:
            report = json.load(file)
        agents = [agent for agent in report["agents"] if agent["name"].startswith("autopilot")]
        if not agents:
            raise PlotError(f"{path}: compares no autopilot; name one in skein compare --agents")
        return report["task"], agents[0]["name"], float(agents[0]["success_rate"])
    except OSError as error:
        raise PlotError(f"{path}: {error.strerror}") from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise PlotError(f"{path}: not what skein compare --json writes") from error

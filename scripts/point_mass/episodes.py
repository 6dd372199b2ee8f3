# SPDX-License-Identifier: Apache-2.0
"""Starts and targets of the episodes that Skein evaluates, and when agents reach them, from the flights it records."""
import glob
import json
import os
import subprocess
import tempfile
from dataclasses import dataclass

# Of the columns of docs/reference/file-formats.md: a start's, and a target's behind target_.
START = ("altitude_ft", "yaw_deg", "true_airspeed_fps")
TARGETS = {"heading": ("altitude_ft", "yaw_deg", "true_airspeed_fps"),
           "control": ("pitch_deg", "yaw_deg", "true_airspeed_fps"),
           "tracking": ("north_ft", "east_ft", "altitude_ft")}
STEP_S = 0.02
ROUNDING_S = 1e-3  # of means that the program prints too


class EpisodeError(Exception):
    """The program does not fly, or what it wrote is not what is expected."""


@dataclass
class Episode:
    start: tuple
    target: tuple


@dataclass
class Agent:
    name: str
    times: list  # time_to_target_s by episode; None for those that did not reach it


def read_flights(path, task, dwell_s):
    """Episodes, and the time to the target of each or None."""
    episodes, times = [], []
    with open(path, encoding="utf-8") as file:
        header = file.readline().rstrip("\n").split(",")
        place = {name: k for k, name in enumerate(header)}
        try:
            start = [place[name] for name in START]
            target = [place["target_" + name] for name in TARGETS[task]]
            number, time, end = place["episode"], place["time_s"], place["termination"]
        except KeyError as error:
            raise EpisodeError(f"{path}: no column {error.args[0]}") from error
        current = None
        for line in file:
            # Most lines are neither a flight's first nor its last, which ends in a word.
            if line.endswith(",\n") and line.startswith(f"{current},"):
                continue
            row = line.rstrip("\n").split(",")
            if row[number] != current:
                current = row[number]
                episodes.append(Episode(tuple(float(row[k]) for k in start), tuple(float(row[k]) for k in target)))
            if row[end]:
                # The step that completes the dwell is the last; the one that entered counts for it, too.
                entered = float(row[time]) - max(dwell_s - STEP_S, 0)
                times.append(round(entered, 2) if row[end] == "target_reached" else None)
    if len(times) != len(episodes):
        raise EpisodeError(f"{path}: {len(episodes)} flights begin and {len(times)} end")
    return episodes, times


def recorded(program, task, agent, episodes, seed, dwell_s, hold_s, folder, conditions=()):
    """The file of the flights of one agent, in `folder`, and what the program reports of them. A file of a thousand
    flights has 300 MB to 1 GB: remove it before the next. Tracking has no dwell and no hold."""
    report = os.path.join(folder, "report.json")
    command = [program, "compare", "--task", task, "--agents", agent, "--episodes", str(episodes), "--seed",
               str(seed), "--threads", "1", "--no-html", "--json", report, "--flights",
               os.path.join(folder, "flights.csv"), "--flights-count", str(episodes)]
    if task != "tracking":
        command += ["--set", f"env.{task}.dwell_s={dwell_s}", "--set", f"env.hold_s={hold_s}"]
    for condition in conditions:
        command += ["--condition", condition]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise EpisodeError(f"skein compare failed: {done.stdout.strip()}")
    (path,) = glob.glob(os.path.join(folder, "flights*.csv"))
    with open(report, encoding="utf-8") as file:
        return path, json.load(file)["agents"][0]


def fly(program, task, agents, episodes, seed, dwell_s, conditions=()):
    """Flies the agents over the same episodes: the episodes, and an Agent for each."""
    with tempfile.TemporaryDirectory() as folder:
        found = None
        results = []
        for agent in agents:
            path, report = recorded(program, task, agent, episodes, seed, dwell_s, 0, folder, conditions)
            begun, times = read_flights(path, task, dwell_s)
            os.remove(path)
            if found is not None and begun != found:
                raise EpisodeError(f"{agent} flew other episodes than {agents[0]}")
            found = begun
            check_mean(agent, times, report["time_to_target_mean"])
            results.append(Agent(agent, times))
        return found, results


def check_mean(agent, times, mean):
    reached = [time for time in times if time is not None]
    if reached and abs(sum(reached) / len(reached) - mean) > ROUNDING_S:
        raise EpisodeError(f"{agent}: flights reach their targets after {sum(reached) / len(reached):.3f} s in the "
                           f"mean, the program says {mean:.3f} s")

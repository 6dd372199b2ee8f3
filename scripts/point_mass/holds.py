# SPDX-License-Identifier: Apache-2.0
"""How agents hold the targets of Control, from the flights that Skein records: where a hold begins, and what becomes of
it."""
import math
import os
import statistics
from dataclasses import dataclass

from .bound import PITCH_TOLERANCE_DEG, SPEED_TOLERANCE_FPS, YAW_TOLERANCE_DEG
from .episodes import STEP_S, EpisodeError, recorded

WITHIN_ROUNDING = 2e-4  # of a share: flights are printed to seven digits
# Columns of docs/reference/file-formats.md.
ERRORS = (("error_pitch_deg", PITCH_TOLERANCE_DEG), ("error_yaw_deg", YAW_TOLERANCE_DEG),
          ("error_true_airspeed_fps", SPEED_TOLERANCE_FPS))
BEGINNING = ("true_airspeed_fps", "altitude_ft", "target_pitch_deg", "target_true_airspeed_fps")


@dataclass
class Hold:
    speed: float  # ft/s, where the target counted as reached
    altitude_ft: float
    target_pitch_deg: float
    target_speed: float
    within: float  # share of the hold
    roll_rate_deg_s: float  # rms
    load_factor_deviation_g: float


class Flight:
    """Collects the hold of a flight from its rows."""

    def __init__(self, dwell_s, hold_s):
        self.dwell_steps, self.hold_steps = round(dwell_s / STEP_S), round(hold_s / STEP_S)
        self.beginning, self.run, self.within = None, 0, 0
        self.roll_rates, self.load_factors = [], []

    def add(self, inside, beginning, roll_rate, load_factor):
        if self.beginning is None:
            self.run = self.run + 1 if inside else 0
            if self.run == self.dwell_steps:
                self.beginning = beginning
            return
        self.within += inside
        self.roll_rates.append(roll_rate)
        self.load_factors.append(load_factor)

    def hold(self):
        """None if the target was not reached, or the flight ended as it was."""
        if self.beginning is None or not self.roll_rates:
            return None
        return Hold(*self.beginning, self.within / self.hold_steps,
                    math.sqrt(statistics.fmean(rate * rate for rate in self.roll_rates)),
                    statistics.pstdev(self.load_factors))


def read_holds(path, dwell_s, hold_s):
    """A Hold, or None, of each flight."""
    holds, current, flight = [], None, None
    with open(path, encoding="utf-8") as file:
        place = {name: k for k, name in enumerate(file.readline().rstrip("\n").split(","))}
        try:
            errors = [(place[name], tolerance) for name, tolerance in ERRORS]
            beginning = [place[name] for name in BEGINNING]
            number, roll_rate, load_factor = place["episode"], place["p_deg_s"], place["load_factor_g"]
        except KeyError as error:
            raise EpisodeError(f"{path}: no column {error.args[0]}") from error
        for line in file:
            row = line.rstrip("\n").split(",")
            if row[number] != current:
                if flight:
                    holds.append(flight.hold())
                current, flight = row[number], Flight(dwell_s, hold_s)
            flight.add(all(abs(float(row[k])) < tolerance for k, tolerance in errors),
                       [float(row[k]) for k in beginning], float(row[roll_rate]), float(row[load_factor]))
    if flight:
        holds.append(flight.hold())
    return holds


def fly_holds(program, agent, episodes, seed, dwell_s, hold_s, folder, conditions=()):
    """A Hold, or None, of each episode; they are what the program itself reports in the mean."""
    path, report = recorded(program, "control", agent, episodes, seed, dwell_s, hold_s, folder, conditions)
    holds = read_holds(path, dwell_s, hold_s)
    os.remove(path)
    reached = [hold.within for hold in holds if hold]
    says = report["estimates"]["hold_within"]["value"]
    if reached and abs(statistics.fmean(reached) - says) > WITHIN_ROUNDING:
        raise EpisodeError(f"{agent}: holds are within tolerances for {statistics.fmean(reached):.4f} of the time in "
                           f"the mean, the program says {says:.4f}")
    return holds

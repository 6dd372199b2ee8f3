# SPDX-License-Identifier: Apache-2.0
"""How smoothly stick commands are flown: the formulas of docs/reference/metrics.md, in the steps of
train/measures/command_smoothness.cpp. A test holds them against what the program says of flights that it records."""
import math
import statistics
from array import array

from jsbsim_flight.task import DT

COMMANDS = ("throttle", "pitch", "roll", "yaw")
REVERSAL_DEAD_BAND = 0.02  # of a way of 2 from stop to stop: what turns back by no more has not reversed
POWER_SPLIT_HZ = 1
WINDOW_STEPS, SHORTEST_WINDOW_STEPS = (round(seconds / DT) for seconds in (50, 1))  # of power


def clipped(values):
    """In [-1, 1] and in float32, as the program has them: what is a stop there is one here."""
    return array("f", (min(max(value, -1.0), 1.0) for value in values))


def count_reversals(values):
    """How often a command has come back by more than the dead band from the farthest that it had come."""
    lowest = highest = values[0]
    direction = count = 0  # up, down or, until it has moved by the dead band, 0
    for value in values:
        lowest, highest = min(lowest, value), max(highest, value)
        if direction <= 0 and value - lowest > REVERSAL_DEAD_BAND:
            turn = 1
        elif direction >= 0 and highest - value > REVERSAL_DEAD_BAND:
            turn = -1
        else:
            continue
        count += direction != 0  # the first motion turns nothing back
        direction, lowest, highest = turn, value, value
    return count


def square_at(k, values):
    """abs(X(k))^2 of the discrete Fourier transform, by Goertzel's recurrence (American Mathematical Monthly 65,
    1958)."""
    coefficient = 2 * math.cos(2 * math.pi * k / len(values))
    newest = before = 0.0
    for value in values:
        newest, before = value + coefficient * newest - before, newest
    return newest * newest + before * before - coefficient * newest * before


def power(values):
    """Of one window about its mean, sums of squares: the whole, and what of it lies above the split."""
    if min(values) == max(values):
        return 0.0, 0.0
    mean = statistics.fmean(values)
    centred = [value - mean for value in values]
    whole = math.fsum(value * value for value in centred)
    count = len(values)
    # A frequency at the split must not fall beside it by the rounding of the interval.
    last = min(int(POWER_SPLIT_HZ * count * DT + 1e-6), (count - 1) // 2)
    below = 2 / count * math.fsum(square_at(k, centred) for k in range(1, last + 1))
    return whole, min(max(whole - below, 0.0), whole)


def share_above_split(values):
    """Of the power of all windows; 0 of a command that never changes."""
    windows = [values[begin:begin + WINDOW_STEPS] for begin in range(0, len(values), WINDOW_STEPS)]
    powers = [power(window) for window in windows if len(window) >= SHORTEST_WINDOW_STEPS]
    whole, above = map(math.fsum, zip(*powers))
    return above / whole if whole > 0 else 0.0


def smoothness(values):
    """Of a command in consecutive control steps: variation and reversals in 1/s, the others as shares from 0 to 1.
    What the series is too short to say is left out."""
    values, figures = clipped(values), {}
    if len(values) > 1:
        duration = (len(values) - 1) * DT
        figures["variation_per_s"] = math.fsum(abs(b - a) for a, b in zip(values, values[1:])) / duration
        figures["reversals_per_s"] = count_reversals(values) / duration
    if len(values) >= SHORTEST_WINDOW_STEPS:
        figures["power_above_1hz"] = share_above_split(values)
    if values:
        figures["saturated"] = sum(abs(value) == 1 for value in values) / len(values)
    return figures


def action_figures(actions):
    """The smoothness of every command; actions are (throttle, pitch, roll, yaw), one for each control step."""
    return {f"{command}_{key}": figure for command, values in zip(COMMANDS, zip(*actions))
            for key, figure in smoothness(values).items()}

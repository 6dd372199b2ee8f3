# SPDX-License-Identifier: Apache-2.0
"""Least time to a target, as a lower bound: by how fast energy (Heading) or airspeed (Control) and the direction of
flight can change at all, at the best speed, altitude, load factor and flight path there is.

With x the energy height (Rutowski 1954) or the airspeed and theta the angle still to be turned, flight gives pairs of
rates (x', -theta'). Where a(x) x' + b (-theta') <= 1 for all of them, W = b theta + integral of a dx from x to the
target's falls no faster than time passes, so a flight takes W(start) - W(target) at least. For each b, a(x) is as great
as that allows; the bound is the best over b. Turning costs drag: that is in the pairs."""
import math
from dataclasses import dataclass

from .forces import GRAVITY_FT_S2, PointMass

FAST = 10.0  # s per ft or ft/s: for where no flight gains, or none loses
SIDE_FORCE_G = 1  # of sideslip and rudder, taken to cost no drag; the recorded flights' is below 0.8
SIDESLIP_DEG = 12  # full pedal gives no more: docs/explanation/flight-control.md
# What alpha, flap and elevator give while they move, and not while they rest, is bounded by the change, not by time: of
# Cx by the pitch rate 13 ft of energy height, of the flap's lead 25 ft.
TRANSIENT_FT = 50
ALTITUDE_TOLERANCE_FT, YAW_TOLERANCE_DEG, PITCH_TOLERANCE_DEG, SPEED_TOLERANCE_FPS = 100, 5, 5, 20
HEADING_EARLIEST_S, CONTROL_EARLIEST_S = 6.0, 0.02


@dataclass
class Region:
    """Where flights stay: the wider, the looser the bound."""
    altitudes_ft: tuple
    speeds_fps: tuple = (500, 1800)


HEADING_REGION, CONTROL_REGION = Region((12000, 30000)), Region((2500, 34000))
# From env.termination.min_altitude_ft on; where the tables of thrust end is 50,000 ft.
CONDITION_REGION = Region((2500, 55000), (300, 2600))


@dataclass
class Bound:
    seconds: float
    along: float  # s of it for energy or airspeed
    turning: float  # s of it for the turn


@dataclass
class Resolution:
    x_step: float  # ft of energy height, ft/s of airspeed
    grid: int = 30  # speeds (Heading) or altitudes (Control) for every x
    prices: int = 40  # values of b


def upper_hull(points):
    """Of pairs (x', turn rate): those that no mixture of others with the same x' turns as fast as."""
    hull = []
    for point in sorted(points):
        while len(hull) > 1 and ((hull[-1][0] - hull[-2][0]) * (point[1] - hull[-2][1])
                                 >= (hull[-1][1] - hull[-2][1]) * (point[0] - hull[-2][0])):
            hull.pop()
        hull.append(point)
    return hull


def prices_at(hull, b):
    """Lowest and highest a with a x' + b turn <= 1 for all; the lowest is above the highest where there is none."""
    lowest, highest = -FAST, FAST
    for rate, turn in hull:
        left = 1 - b * turn
        if rate > 0:
            highest = min(highest, left / rate)
        elif rate < 0:
            lowest = max(lowest, left / rate)
        elif left < 0:
            return FAST, -FAST
    return lowest, highest


class Relaxation:
    """The bound for one task and all of its targets."""

    def __init__(self, edges, hulls, prices):
        """`hulls[k]` is of x between edges[k] and edges[k + 1]."""
        self.edges = edges
        self.step = edges[1] - edges[0]
        slowest = min(max(turn for _, turn in hull) for hull in hulls)
        self.tables = []
        for k in range(prices):
            b = k / (prices - 1) / slowest
            pairs = [prices_at(hull, b) for hull in hulls]
            if any(highest < max(lowest, 0) for lowest, highest in pairs):
                break
            self.tables.append((b, *(self._sums(values) for values in (
                [highest for _, highest in pairs], [lowest for lowest, _ in pairs],
                [max(lowest, 0) for lowest, _ in pairs]))))

    def _sums(self, values):
        sums = [0.0]
        for value in values:
            sums.append(sums[-1] + value * self.step)
        return sums

    def _integral(self, sums, start, end):
        def at(x):
            place = min(max((x - self.edges[0]) / self.step, 0), len(sums) - 1 - 1e-9)
            k = int(place)
            return sums[k] + (place - k) * (sums[k + 1] - sums[k])
        return at(end) - at(start)

    def bound(self, start, lowest, highest, angle, earliest=0.0):
        """From x = `start` to between `lowest` and `highest`, and by `angle` rad."""
        best = Bound(earliest, 0, 0)
        angle = max(angle, 0.0)
        for b, gaining, losing, gained in self.tables:
            if start <= lowest:
                along = self._integral(gaining, start, lowest)
            else:
                end = max(highest, lowest)
                along = -self._integral(losing, end, start) if start > end else 0.0
                along -= self._integral(gained, lowest, min(start, end))
            if along + b * angle > best.seconds:
                best = Bound(along + b * angle, along, b * angle)
        return best


def turn_rate(across, speed):
    """The fastest that the direction of flight turns, rad/s: all force across the path, sideslip's, and gravity's."""
    return GRAVITY_FT_S2 * (math.hypot(across, SIDE_FORCE_G) + 1) / speed


def edges_between(low, high, step):
    return [low + step * k for k in range(math.ceil((high - low) / step) + 1)]


def heading_relaxation(model: PointMass, load_factor: float, resolution: Resolution,
                       region: Region = HEADING_REGION) -> Relaxation:
    (low, high), (least, greatest) = region.altitudes_ft, region.speeds_fps
    edges = edges_between(energy_height(least, low), energy_height(greatest, high), resolution.x_step)
    hulls = []
    for edge in edges[:-1]:
        energy = edge + resolution.x_step / 2
        slowest = math.sqrt(max(2 * GRAVITY_FT_S2 * (energy - high), least**2))
        fastest = math.sqrt(min(2 * GRAVITY_FT_S2 * (energy - low), greatest**2))
        points = []
        for k in range(resolution.grid + 1):
            speed = slowest + (fastest - slowest) * k / resolution.grid
            altitude = energy - speed**2 / (2 * GRAVITY_FT_S2)
            points += [(along * speed, turn_rate(across, speed))
                       for along, across in model.manoeuvres(speed, altitude, load_factor)]
        hulls.append(upper_hull(points))
    return Relaxation(edges, hulls, resolution.prices)


def control_relaxation(model: PointMass, load_factor: float, resolution: Resolution,
                       region: Region = CONTROL_REGION) -> Relaxation:
    """Dives and climbs are free: gravity speeds up or slows down by a whole g."""
    low, high = region.altitudes_ft
    edges = edges_between(*region.speeds_fps, resolution.x_step)
    hulls = []
    for edge in edges[:-1]:
        speed, points = edge + resolution.x_step / 2, []
        for k in range(resolution.grid + 1):
            altitude = low + (high - low) * k / resolution.grid
            for along, across in model.manoeuvres(speed, altitude, load_factor):
                points += [((along + help) * GRAVITY_FT_S2, turn_rate(across, speed)) for help in (-1, 1)]
        hulls.append(upper_hull(points))
    return Relaxation(edges, hulls, resolution.prices)


def energy_height(speed, altitude_ft):
    return altitude_ft + speed**2 / (2 * GRAVITY_FT_S2)


def nose_angle(model, speed, altitude_ft, load_factor):
    """The greatest angle between the nose and the path, rad: alpha at the load factor's limit, and sideslip."""
    # Trims need a few degrees of elevator: its nodes from -10 to 10 deg.
    curves = model.forces(speed, altitude_ft)[1:-1]
    alpha = max(entry[3] for curve in curves for entry in first_beyond(curve, load_factor))
    return math.acos(math.cos(alpha) * math.cos(math.radians(SIDESLIP_DEG)))


def first_beyond(curve, load_factor):
    """The points within the limit and the first one beyond."""
    within = [entry for entry in curve if entry[0] <= load_factor]
    beyond = [entry for entry in curve if entry[0] > load_factor]
    return within + beyond[:1]


def heading_bound(model, relaxation, load_factor, start, target) -> Bound:
    """`start`: altitude ft, yaw deg, airspeed ft/s, level; `target` the same."""
    altitude, yaw, speed = target
    # The altitude stays within its tolerance for the dwell: what climbs faster than that allows leaves it.
    climb = math.sqrt(2 * (load_factor + 1) * GRAVITY_FT_S2 * 2 * ALTITUDE_TOLERANCE_FT)
    path = math.asin(min(climb / (speed - SPEED_TOLERANCE_FPS), 1))
    nose = nose_angle(model, speed - SPEED_TOLERANCE_FPS, altitude, load_factor)
    beside = math.radians(YAW_TOLERANCE_DEG) + math.asin(min(math.sin(nose) / math.cos(path), 1))
    left = math.acos(max(math.cos(beside), 0) * math.cos(path))
    turn = abs(math.radians(math.remainder(yaw - start[1], 360)))
    return relaxation.bound(
        energy_height(start[2], start[0]),
        energy_height(speed - SPEED_TOLERANCE_FPS, altitude - ALTITUDE_TOLERANCE_FT) - TRANSIENT_FT,
        energy_height(speed + SPEED_TOLERANCE_FPS, altitude + ALTITUDE_TOLERANCE_FT) + TRANSIENT_FT,
        turn - left, HEADING_EARLIEST_S)


def control_bound(model, relaxation, load_factor, start, target) -> Bound:
    """`start`: altitude ft, yaw deg, airspeed ft/s, level; `target`: pitch deg, yaw deg, airspeed ft/s."""
    pitch, yaw, speed = target
    turn = math.acos(math.cos(math.radians(pitch)) * math.cos(math.radians(yaw - start[1])))
    beside = math.hypot(math.radians(PITCH_TOLERANCE_DEG), math.radians(YAW_TOLERANCE_DEG))
    nose = nose_angle(model, speed - SPEED_TOLERANCE_FPS, start[0], load_factor)
    slack = TRANSIENT_FT * GRAVITY_FT_S2 / speed
    return relaxation.bound(start[2], speed - SPEED_TOLERANCE_FPS - slack, speed + SPEED_TOLERANCE_FPS + slack,
                            turn - beside - nose, CONTROL_EARLIEST_S)

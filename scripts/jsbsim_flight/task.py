# SPDX-License-Identifier: Apache-2.0
"""Skein's tasks Heading and Control, as docs/reference/tasks.md defines them: targets, observation, ends."""
import math
from dataclasses import dataclass

from jsbsim_flight.control_laws import ACTUATORS, Surfaces

DT = 0.02  # s, a control step
TIME_LIMIT_STEPS = 2500
FEET_PER_METRE = 1 / 0.3048
ALTITUDE_ERROR_UNIT, ALTITUDE_UNIT, SPEED_UNIT = (metres * FEET_PER_METRE for metres in (1000, 5000, 340))
# Where a flight begins: wings level, heading north.
ALTITUDES_FT, SPEEDS_FPS = (19000, 20000), (1000, 1200)


@dataclass
class State:
    """An aircraft in Skein's units and signs (docs/reference/conventions.md): foot, second, radian, psf, g."""
    altitude: float
    roll: float
    pitch: float
    yaw: float
    p: float
    q: float
    r: float
    alpha: float
    beta: float
    airspeed: float  # true
    mach: float
    density_ratio: float  # to that at sea level
    dynamic_pressure: float
    static_pressure: float
    nz: float
    ny: float
    power: float  # 0 idle, 50 military, 100 maximum
    surfaces: Surfaces


def angle_error(target, actual):
    return math.remainder(target - actual, 2 * math.pi)


class Task:
    """A target, and how far from it an aircraft is. Each task's class has its RANGES, TOLERANCES, ERRORS (by the names
    of Skein's columns, how many of the column's unit an error of 1 is), FIRST_UNIT (of the first error when observed),
    EARLIEST_SUCCESS_STEP, and the first quantity that its target is compared with."""

    def __init__(self, state, draw):
        """Draws the target; draw(x) is uniform in [-x, x]."""
        first, yaw, speed = self.RANGES
        self.target = (self.first(state) + draw(first), state.yaw + draw(yaw), state.airspeed + draw(speed))

    def errors(self, state):
        """Target minus actual: the first quantity, yaw in radians, true airspeed in ft/s."""
        return (self.target[0] - self.first(state), angle_error(self.target[1], state.yaw),
                self.target[2] - state.airspeed)

    def is_within(self, state):
        return all(abs(error) < tolerance for error, tolerance in zip(self.errors(state), self.TOLERANCES))

    def observe(self, state):
        """The 22 numbers that a policy sees, without noise."""
        errors = self.errors(state)
        ratio = math.sqrt(state.density_ratio)
        surfaces = [getattr(state.surfaces, name) / actuator.highest for name, actuator in vars(ACTUATORS).items()]
        return [errors[0] / self.FIRST_UNIT, errors[1], errors[2] / SPEED_UNIT, state.altitude / ALTITUDE_UNIT,
                math.sin(state.roll), math.cos(state.roll), math.sin(state.pitch), math.cos(state.pitch),
                state.airspeed * ratio / SPEED_UNIT, math.sin(state.alpha), math.cos(state.alpha),
                math.sin(state.beta), math.cos(state.beta), state.p, state.q, state.r, state.power / 100,
                *surfaces, 1 / ratio]


class Heading(Task):
    RANGES = (3000, 3, 300)
    TOLERANCES = (100, math.radians(5), 20)
    ERRORS = {"altitude_ft": 1, "yaw_deg": math.degrees(1), "true_airspeed_fps": 1}
    FIRST_UNIT = ALTITUDE_ERROR_UNIT
    EARLIEST_SUCCESS_STEP = 300

    @staticmethod
    def first(state):
        return state.altitude


class Control(Task):
    RANGES = (0.5, 3, 300)
    TOLERANCES = (math.radians(5), math.radians(5), 20)
    ERRORS = {"pitch_deg": math.degrees(1), "yaw_deg": math.degrees(1), "true_airspeed_fps": 1}
    FIRST_UNIT = 1
    EARLIEST_SUCCESS_STEP = 1

    @staticmethod
    def first(state):
        return state.pitch


TASKS = {"heading": Heading, "control": Control}


def failure(state):
    """The kind of end of an episode that the aircraft's state asks for, or None."""
    if not all(map(math.isfinite, (state.altitude, state.airspeed, state.roll, state.nz, state.alpha, state.beta))):
        return "non_finite"
    if not (-20 <= math.degrees(state.alpha) <= 45 and abs(math.degrees(state.beta)) <= 30):
        return "extreme_state"
    if state.mach > 3:
        return "high_speed"
    if state.mach < 0.01:
        return "low_speed"
    if state.altitude < 2500:
        return "low_altitude"
    return "overload" if state.nz > 10 else None

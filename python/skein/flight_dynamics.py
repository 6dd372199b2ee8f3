# SPDX-License-Identifier: Apache-2.0
"""One aircraft in float64: steady flight, linear models, and flight with given controls."""
from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skein import _skein
from skein._skein import ConfigurationError
from skein.checks import MOST_STEPS, is_vector, number, rows, text, whole_number

DoubleArray = NDArray[np.float64]

STATE_NAMES = _skein.STATE_NAMES[:13]
"""u, v, w (body axes, ft/s), p, q, r (rad/s), north, east, down (ft), the attitude's quaternion q0, qx, qy, qz."""
CONTROL_NAMES = ("thrust_lbf", "elevator_deg", "aileron_deg", "rudder_deg", "leading_edge_flap_deg")
"""Elevator + is trailing edge down, aileron + rolls left, rudder + yaws left."""


@dataclass(frozen=True)
class Trim:
    """Steady flight, and the controls that keep it."""

    state: DoubleArray
    """(13,), STATE_NAMES; at north = east = 0, heading north."""
    controls: DoubleArray
    """(5,), CONTROL_NAMES."""
    power: float
    """Engine power, 0 to 100, that gives the thrust, clipped to what the engine has."""
    alpha_deg: float
    beta_deg: float
    bank_deg: float
    pitch_deg: float
    load_factor_g: float
    mach: float
    qbar_psf: float
    """Dynamic pressure, lbf/ft^2."""
    residual: float
    """The largest acceleration that is left, ft/s^2 or rad/s^2."""
    exceeded_limits: tuple[str, ...]
    """Limits of the aircraft and its model that this flight exceeds, in words; empty if there are none."""
    _plant: _skein.Plant = field(repr=False, compare=False)


@dataclass(frozen=True)
class LinearModel:
    """d(state_rate) = A d(state) + B d(controls)."""

    A: DoubleArray
    """(13, 13), STATE_NAMES."""
    B: DoubleArray
    """(13, 5), CONTROL_NAMES."""

    def modes(self) -> NDArray[np.complex128]:
        """Eigenvalues of A, 1/s."""
        return np.linalg.eigvals(self.A).astype(np.complex128)


@dataclass(frozen=True)
class Trajectory:
    """A flight with given controls."""

    time_s: DoubleArray
    """(steps + 1,)"""
    states: DoubleArray
    """(steps + 1, 13), STATE_NAMES."""

    def __getitem__(self, name: str) -> DoubleArray:
        """A column of the states by its name."""
        if name not in STATE_NAMES:
            raise KeyError(f"{name}: no state; there are {', '.join(STATE_NAMES)}")
        column: DoubleArray = self.states[:, STATE_NAMES.index(name)]
        return column


def trim(
    altitude_ft: float,
    true_airspeed_fps: float,
    *,
    flight_path_deg: float = 0,
    turn_rate_deg_s: float = 0,
    aircraft: str | os.PathLike[str] = "f16",
    atmosphere: str = "stevens_lewis",
    cg: float | None = None,
    engine_angular_momentum: float = 0,
) -> Trim:
    """Steady flight at an altitude and speed.

    Args:
        altitude_ft, true_airspeed_fps: of the flight.
        flight_path_deg: positive in a climb.
        turn_rate_deg_s: positive to the right; the turn is coordinated.
        aircraft: one of skein.AIRCRAFT, or the path of a file.
        atmosphere: "stevens_lewis" or "standard_1976".
        cg: centre of gravity, fraction of the mean chord; without it the aircraft's own.
        engine_angular_momentum: slug ft^2/s.

    Raises:
        Error: there is no such flight; the message says which limit is in the way.
    """
    plant = _skein.make_plant(
        text("aircraft", aircraft),
        text("atmosphere", atmosphere),
        None if cg is None else number("cg", cg),
        number("engine_angular_momentum", engine_angular_momentum),
    )
    point = plant.trim(
        number("altitude_ft", altitude_ft),
        number("true_airspeed_fps", true_airspeed_fps),
        number("flight_path_deg", flight_path_deg),
        number("turn_rate_deg_s", turn_rate_deg_s),
    )
    return Trim(**point, _plant=plant)


def linearise(point: Trim) -> LinearModel:
    """The linear model about a steady flight, of the aircraft that was trimmed, by central differences."""
    _require_trim("linearise", point)
    return LinearModel(*point._plant.linearise(point.state, point.controls))


def simulate(
    start: Trim, controls: Any, *, state: Any = None, duration_s: float | None = None, dt: float = 0.02
) -> Trajectory:
    """Flies the bare airframe that was trimmed, without flight control system, actuators or engine lag: classic RK4
    steps of `dt`.

    Args:
        start: where the flight begins.
        controls: (5,), CONTROL_NAMES, held for duration_s; or (steps, 5), row k held during step k.
        state: (13,), STATE_NAMES: begin there and not in the trim's state.
        duration_s: of the flight, with controls that are held.
        dt: time step, s.

    Raises:
        Error: a state is not finite.
    """
    _require_trim("simulate", start)
    dt = number("dt", dt)
    if dt <= 0:
        raise ConfigurationError(f"dt must be above 0, not {dt}")
    is_held = is_vector(controls)
    shape = (len(CONTROL_NAMES),) if is_held else (None, len(CONTROL_NAMES))
    flown = rows("controls", controls, shape, np.float64)
    if is_held:
        if duration_s is None:
            raise ConfigurationError("simulate: duration_s is needed with controls that are held")
        steps = whole_number("number of steps", round(number("duration_s", duration_s) / dt), 0, MOST_STEPS)
        flown = np.repeat(flown[None], steps, axis=0)
    elif duration_s is not None:
        raise ConfigurationError("simulate: duration_s is for controls that are held; rows have their own number")
    begin = rows("state", start.state if state is None else state, (len(STATE_NAMES),), np.float64)
    states = start._plant.simulate(begin, flown, dt)
    return Trajectory(dt * np.arange(len(states), dtype=np.float64), states)


def _require_trim(what: str, point: Any) -> None:
    if not isinstance(point, Trim):
        raise ConfigurationError(f"{what}: a skein.Trim is needed, not {type(point).__name__}")

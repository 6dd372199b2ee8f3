# SPDX-License-Identifier: Apache-2.0
"""One aircraft in float64: steady flight, linear models, and flight with given controls."""
from __future__ import annotations

import json
import os
from dataclasses import dataclass, field, fields
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from skein import _skein
from skein._skein import ConfigurationError
from skein.checks import MOST_STEPS, UnknownName, is_vector, number, rows, shown, text, whole_number

DoubleArray = NDArray[np.float64]

STATE_NAMES = _skein.SHOWN_STATE_NAMES[:13]
"""u, v, w (body axes, ft/s), p, q, r (rad/s), north, east, down (ft), the attitude's quaternion q0, qx, qy, qz. The
order of the state of trim, linearise and simulate; linear_models has nine others."""
CONTROL_NAMES = ("thrust_lbf", "elevator_deg", "aileron_deg", "rudder_deg", "leading_edge_flap_deg")
"""Thrust in lbf, which is neither throttle nor power; surfaces in deg: elevator + is trailing edge down, aileron +
rolls left, rudder + yaws left. The order of the controls of trim, linearise and simulate; linear_models has power, %,
first."""
GRAVITY_FT_S2 = 32.17
"""Of the published F-16 models."""

_Request = tuple[float, float, float, float, Union[float, None]]  # of _skein.FlightRequest


class _Plant:
    """An aircraft in its world. A copy is it itself; one that is pickled is made again from the same arguments."""

    def __init__(self, *arguments: Any) -> None:
        self._arguments = arguments
        self.core = _skein.make_plant(*arguments)

    def __copy__(self) -> _Plant:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> _Plant:
        return self

    def __reduce__(self) -> tuple[type[_Plant], tuple[Any, ...]]:
        return _Plant, self._arguments


@dataclass(frozen=True, eq=False)
class Trim:
    """Steady flight, and the controls that keep it: skein.trim finds it.

    `state` and `controls` are read-only; copies are not. `state` is float64 (13,) in the order of skein.STATE_NAMES: u, v, w (body axes, ft/s), p, q, r (rad/s), north, east,
    down (ft), and the attitude's quaternion q0, qx, qy, qz. `controls` is float64 (5,) in the order of
    skein.CONTROL_NAMES: thrust (lbf), elevator, aileron, rudder and leading-edge flap (deg).

    Thrust is what the bare airframe is flown with (skein.simulate, skein.linearise). What commands it is `throttle`, 0
    to 1: an environment's action has 2 * throttle - 1. Between them lies the engine's `power`, 0 to 100 %, which is the
    input of skein.linear_models.

    The other figures have their units in their names; Mach number and coefficients have none. A trim that is pickled
    makes its aircraft again, whose file must be there, unchanged.
    """

    state: DoubleArray
    """(13,), STATE_NAMES; at north = east = 0, heading north."""
    controls: DoubleArray
    """(5,), CONTROL_NAMES: first the thrust, lbf, which is not the throttle."""
    power: float
    """Engine power, 0 to 100 %, that gives the thrust, clipped to what the engine has."""
    throttle: float
    """That commands the power, 0 to 1; 2 * throttle - 1 is the action of an environment."""
    available_thrust_lbf: float
    """At full throttle."""
    excess_power_fps: float
    """What full throttle would climb at constant speed, ft/s; negative where it would sink."""
    alpha_deg: float
    beta_deg: float
    bank_deg: float
    pitch_deg: float
    load_factor_g: float
    lift_coefficient: float
    drag_coefficient: float
    mach: float
    qbar_psf: float
    """Dynamic pressure, lbf/ft^2."""
    residual: float
    """The largest acceleration that is left, ft/s^2 or rad/s^2."""
    exceeded_limits: tuple[str, ...]
    """Limits of the aircraft and its model that this flight exceeds, in words; empty if there are none."""
    _plant: _Plant = field(repr=False)
    _request: _Request = field(repr=False)

    def __post_init__(self) -> None:
        # Changed in place, they would be of another flight than the figures, and than linear_models.
        self.state.flags.writeable = self.controls.flags.writeable = False

    def __setstate__(self, pickled: dict[str, Any]) -> None:
        self.__dict__.update(pickled)
        self.__post_init__()


@dataclass(frozen=True, eq=False)
class TrimGrid:
    """The same manoeuvre at every altitude and speed: skein.trim_grid finds it.

    `altitude_ft` is float64 (n,) and `true_airspeed_fps` float64 (m,), as they were given. `flown` and
    `grid["excess_power_fps"]`, a figure of every point by its name, are (n, m): rows are altitudes, columns speeds.
    """

    altitude_ft: DoubleArray
    """(n,)"""
    true_airspeed_fps: DoubleArray
    """(m,)"""
    points: list[list[dict[str, Any]]]
    """[altitude][speed]: the elements of `points` that `skein fdm trim --json` writes."""

    @property
    def flown(self) -> NDArray[np.bool_]:
        """bool (n, m): whether flight is steady there, within the thrust, the surfaces' range and the tables."""
        return np.array([[point["flown"] for point in row] for row in self.points], bool)

    @property
    def limit(self) -> list[list[str]]:
        """[altitude][speed]: what ends flight there ("below stall speed"); empty where it is flown."""
        return [[point.get("limit", "") for point in row] for row in self.points]

    def __getitem__(self, name: str) -> DoubleArray:
        """float64 (n, m): a figure of every point, not a number where there is no trim: those of skein.Trim that are
        single numbers, such as "excess_power_fps" and "throttle", with their units; "altitude_ft", "speed_fps"."""
        found = [[point.get(name, np.nan) for point in row] for row in self.points]
        known = {"altitude_ft", "speed_fps", *(figure.name for figure in fields(Trim) if figure.type == "float")}
        if name not in known:
            raise UnknownName(f"{shown(name)}: no figure; there are {', '.join(sorted(known))}")
        return np.array(found, np.float64)


@dataclass(frozen=True, eq=False)
class LinearModel:
    """d(state_rate) = A d(state) + B d(controls), of the bare airframe: skein.linearise finds it.

    `A` is float64 (13, 13): element [i, j] is the change of the rate of STATE_NAMES[i] by STATE_NAMES[j]: u, v, w (body
    axes, ft/s), p, q, r (rad/s), north, east, down (ft), q0, qx, qy, qz. `B` is float64 (13, 5): by CONTROL_NAMES[j]:
    thrust (per lbf, not per throttle or power), elevator, aileron, rudder, leading-edge flap (per deg). Rates are per
    second.
    """

    A: DoubleArray
    """(13, 13), STATE_NAMES by STATE_NAMES."""
    B: DoubleArray
    """(13, 5), STATE_NAMES by CONTROL_NAMES."""

    def modes(self) -> NDArray[np.complex128]:
        """Eigenvalues of A, complex128 (13,), 1/s, in no order; skein.linear_models has them by name. In straight
        flight five are near 0: those of position, heading and the quaternion's length, which are no modes of flight."""
        return np.linalg.eigvals(self.A).astype(np.complex128)


@dataclass(frozen=True, eq=False)
class Trajectory:
    """A flight with given controls: skein.simulate flies it.

    `time_s` is float64 (steps + 1,), from 0, and `states` float64 (steps + 1, 13) in the order of skein.STATE_NAMES:
    u, v, w (body axes, ft/s), p, q, r (rad/s), north, east, down (ft), q0, qx, qy, qz. `flight["down_ft"]` is a column
    by its name.
    """

    time_s: DoubleArray
    """(steps + 1,), from 0."""
    states: DoubleArray
    """(steps + 1, 13), STATE_NAMES; the first is where the flight began."""

    def __getitem__(self, name: str) -> DoubleArray:
        """(steps + 1,): a column of the states by its name of STATE_NAMES, which says its unit."""
        if name not in STATE_NAMES:
            raise UnknownName(f"{shown(name)}: no state; there are {', '.join(STATE_NAMES)}")
        column: DoubleArray = self.states[:, STATE_NAMES.index(name)]
        return column


def trim(
    altitude_ft: float,
    true_airspeed_fps: float,
    *,
    flight_path_deg: float = 0,
    turn_rate_deg_s: float = 0,
    pull_up_g: float | None = None,
    aircraft: str | os.PathLike[str] = "f16",
    atmosphere: str = "stevens_lewis",
    gravity_ft_s2: float = GRAVITY_FT_S2,
    gravity_falls_with_altitude: bool = False,
    cg: float | None = None,
    engine_angular_momentum: float = 0,
    drag_rise: bool = False,
    thrust_growth: bool = False,
) -> Trim:
    """Steady flight at an altitude and speed, as a skein.Trim: its state (13,), controls (5,), throttle and figures.

    Args:
        altitude_ft, true_airspeed_fps: of the flight, above sea level and through the air.
        flight_path_deg: positive in a climb.
        turn_rate_deg_s: positive to the right; a turn without sideslip.
        pull_up_g: of a pull-up with level wings: force across the flight path over weight, 1 in level flight; no turn
            then.
        aircraft: one of skein.AIRCRAFT, or the path of a file.
        atmosphere: "stevens_lewis" or "standard_1976".
        gravity_ft_s2: at sea level; load_factor_g stays a multiple of 32.17.
        gravity_falls_with_altitude: as in the U.S. Standard Atmosphere 1976.
        cg: centre of gravity, fraction of the mean chord; without it the aircraft's own.
        engine_angular_momentum: slug ft^2/s.
        drag_rise, thrust_growth: with the Mach number, of aircraft that have the data.

    Raises:
        Error: there is no such flight; the message says which limit is in the way.
    """
    plant = _made_plant(
        aircraft,
        atmosphere,
        gravity_ft_s2,
        gravity_falls_with_altitude,
        cg,
        engine_angular_momentum,
        drag_rise,
        thrust_growth,
    )
    request = _request(altitude_ft, true_airspeed_fps, flight_path_deg, turn_rate_deg_s, pull_up_g)
    return Trim(**plant.core.trim(_skein.FlightRequest(*request)), _plant=plant, _request=request)


def trim_grid(
    altitude_ft: Any,
    true_airspeed_fps: Any,
    *,
    flight_path_deg: float = 0,
    turn_rate_deg_s: float = 0,
    pull_up_g: float | None = None,
    aircraft: str | os.PathLike[str] = "f16",
    atmosphere: str = "stevens_lewis",
    gravity_ft_s2: float = GRAVITY_FT_S2,
    gravity_falls_with_altitude: bool = False,
    cg: float | None = None,
    engine_angular_momentum: float = 0,
    drag_rise: bool = False,
    thrust_growth: bool = False,
) -> TrimGrid:
    """Steady flight at every altitude and every speed, or why there is none: a flight envelope, as a skein.TrimGrid.

    Args:
        altitude_ft: (n,), above sea level.
        true_airspeed_fps: (m,), above 0.
        flight_path_deg and all others: as of skein.trim.

    Raises:
        ConfigurationError: arrays that are empty or not of finite numbers; a manoeuvre or aircraft that skein.trim
            would refuse. A point that cannot be flown is none: it has a limit.
    """
    plant = _made_plant(
        aircraft,
        atmosphere,
        gravity_ft_s2,
        gravity_falls_with_altitude,
        cg,
        engine_angular_momentum,
        drag_rise,
        thrust_growth,
    )
    altitudes = _grid_axis("altitude_ft", altitude_ft, -np.inf)
    speeds = _grid_axis("true_airspeed_fps", true_airspeed_fps, 0)
    manoeuvre = _skein.FlightRequest(*_request(0, 1, flight_path_deg, turn_rate_deg_s, pull_up_g))
    points = json.loads(plant.core.trim_grid(altitudes, speeds, manoeuvre))
    by_altitude = [points[begin : begin + len(speeds)] for begin in range(0, len(points), len(speeds))]
    return TrimGrid(altitudes, speeds, by_altitude)


def linearise(point: Trim) -> LinearModel:
    """The linear model of the bare airframe about a steady flight, by central differences:
    d(state_rate) = A d(state) + B d(controls), the derivative of what skein.simulate flies.

    Prefer skein.linear_models to look at modes or to design a controller: it has nine states (true airspeed, alpha,
    pitch, q, beta, bank, p, r, altitude), engine power as an input, outputs such as the load factor, modes by name,
    and the loops with flight control, and agrees with `skein fdm linearise`. This one is for the full state: for a
    filter or an optimisation beside skein.simulate, with position and a quaternion, and thrust as an input.

    Args:
        point: what skein.trim gave.

    Returns:
        A, float64 (13, 13): rates of the states, per second, by the states, both in the order of skein.STATE_NAMES:
            u, v, w (body axes, ft/s), p, q, r (rad/s), north, east, down (ft), and the quaternion q0, qx, qy, qz. The
            quaternion's four numbers are not independent: in straight flight A has an eigenvalue of 0 for its length.
        B, float64 (13, 5): the same rates by the controls, in the order of skein.CONTROL_NAMES: thrust (lbf),
            elevator, aileron, rudder, leading-edge flap (deg). Its first column is per lbf of thrust, that of
            linear_models per % of engine power.
    """
    _require_trim("linearise", point)
    return LinearModel(*point._plant.core.linearise(point.state, point.controls))


def linear_models(point: Trim, *, flap: str = "fixed") -> dict[str, Any]:
    """The linear models of a steady flight in the variables of flight dynamics, with named modes: what an element of
    `points` of `skein fdm linearise --json` holds, A, B, C and D as arrays.

        bare = skein.linear_models(skein.trim(15000, 500))["bare_airframe"]
        [state["name"] for state in bare["states"]], bare["A"], bare["modes"][0]["damping_ratio"]

    Args:
        point: what skein.trim gave.
        flap: "fixed" makes the leading-edge flap of the bare airframe an input, "scheduled" lets it follow its
            schedule.

    Returns:
        A dict of "altitude_ft", "speed_fps", "trim", and
        "bare_airframe": x' = A x + B u, y = C x + D u of departures from the trim, in continuous time, s. "states",
            "inputs" and "outputs" say the order of rows and columns, each a list of {"name", "unit"}:
            states (9): true_airspeed_fps, alpha_rad, pitch_rad, q_rad_s, beta_rad, bank_rad, p_rad_s, r_rad_s,
            altitude_ft; inputs (5): power (engine power, 0 to 100 %), elevator_deg, aileron_deg, rudder_deg, and if
            the flap is fixed leading_edge_flap_deg; outputs (6): load_factor_g, lateral_load_factor_g, alpha_deg,
            beta_deg, flight_path_deg, mach. "A", "B", "C", "D": float64 (9, 9), (9, 5), (6, 9), (6, 5).
            "modes", altitude and power held: a list of dicts with "name" ("short period", "phugoid", "Dutch roll",
            "roll", "spiral"), "eigenvalue_per_s" (real and imaginary part), "swings", "frequency_rad_s" (undamped),
            "damping_ratio", "time_constant_s", "time_to_half_s", "time_to_double_s" (None: never), and "shares", the
            participation of the states.
        "with_flight_control": "longitudinal" and "lateral", each the same in control steps of "dt_s": x of the next
            step is A x + B u, and y = C x is measured before it. Inputs are "pitch_stick", or "roll_stick" and
            "yaw_pedals", in [-1, 1]; states are rigid body, actuators and filters; modes have no names. Power is held.
            Of flight with level wings: turns and pull-ups do not have it.
    """
    _require_trim("linear_models", point)
    if flap not in ("fixed", "scheduled"):
        raise ConfigurationError(f'flap must be "fixed" or "scheduled", not {shown(flap)}')
    request = _skein.FlightRequest(*point._request)
    models: dict[str, Any] = json.loads(point._plant.core.linear_models(request, flap == "scheduled"))
    for model in (models["bare_airframe"], *models.get("with_flight_control", {}).values()):
        for name in "ABCD":
            model[name] = np.array(model[name], np.float64)
    return models


def flying_qualities(point: Trim, *, airplane_class: str = "IV", category: str = "A") -> dict[str, Any]:
    """How the aircraft with flight control flies about a steady flight with level wings: what an element of `points` of
    `skein fdm sweep --json` holds: step responses, levels of MIL-F-8785C, margins of the loops.

    Args:
        point: what skein.trim gave.
        airplane_class: of MIL-F-8785C, "I" to "IV".
        category: of flight phases, "A" to "C".

    Returns:
        A dict of numbers, with their units in their names: "pitch_step" and "roll_step" (of the "stick", in [-1, 1]),
        "load_factor_by_alpha_g_per_rad", "equivalent_short_period", "equivalent_roll", "dutch_roll", "bank_s" (from
        full stick to "bank_deg"); "requirements", a list of dicts with "paragraph", "what", "value", "unit" and
        "level" (1 to 3; 4 is below level 3); and "loops", one for each actuator, with margins in dB, deg and s.
        "unstable_mode" is None, or the mode of the closed loop that grows ("eigenvalue_per_s", "frequency_rad_s",
        "time_to_double_s"): then there are no loops, and the equivalent systems' figures are None.

    Raises:
        ConfigurationError: it is a turn or a pull-up.
        Error: the flight is not steady for want of thrust.
    """
    _require_trim("flying_qualities", point)
    found: dict[str, Any] = json.loads(
        point._plant.core.flying_qualities(
            _skein.FlightRequest(*point._request), text("airplane_class", airplane_class), text("category", category)
        )
    )
    return found


def simulate(
    start: Trim, controls: Any, *, state: Any = None, duration_s: float | None = None, dt: float = 0.02
) -> Trajectory:
    """Flies the bare airframe that was trimmed, without flight control system, actuators or engine lag: classic RK4
    steps of `dt`.

    Args:
        start: where the flight begins.
        controls: (5,), held for duration_s; or (steps, 5), row k held during step k. In the order of
            skein.CONTROL_NAMES: thrust (lbf, not throttle), elevator, aileron, rudder, leading-edge flap (deg).
        state: (13,): begin there and not in the trim's state. In the order of skein.STATE_NAMES: u, v, w (body axes,
            ft/s), p, q, r (rad/s), north, east, down (ft), q0, qx, qy, qz.
        duration_s: of the flight, with controls that are held; rounded to whole steps, of which there must be one.
        dt: time step, s.

    Returns:
        A skein.Trajectory: time_s (steps + 1,) and states (steps + 1, 13), those of the start first.

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
        intervals = number("duration_s", duration_s) / dt
        steps = round(intervals) if intervals <= MOST_STEPS else 0
        if steps < 1:
            raise ConfigurationError(f"duration_s must be 1 to {MOST_STEPS} steps of {dt} s, not {duration_s} s")
        flown = np.repeat(flown[None], steps, axis=0)
    elif duration_s is not None:
        raise ConfigurationError("simulate: duration_s is for controls that are held; rows have their own number")
    begin = rows("state", start.state if state is None else state, (len(STATE_NAMES),), np.float64)
    states = start._plant.core.simulate(begin, flown, dt)
    return Trajectory(dt * np.arange(len(states), dtype=np.float64), states)


def _made_plant(
    aircraft: Any,
    atmosphere: Any,
    gravity_ft_s2: Any,
    gravity_falls_with_altitude: Any,
    cg: Any,
    engine_angular_momentum: Any,
    drag_rise: Any,
    thrust_growth: Any,
) -> _Plant:
    gravity = number("gravity_ft_s2", gravity_ft_s2)
    if gravity <= 0:
        raise ConfigurationError(f"gravity_ft_s2 must be above 0, not {gravity}")
    return _Plant(
        text("aircraft", aircraft),
        text("atmosphere", atmosphere),
        gravity,
        bool(gravity_falls_with_altitude),
        None if cg is None else number("cg", cg),
        number("engine_angular_momentum", engine_angular_momentum),
        bool(drag_rise),
        bool(thrust_growth),
    )


def _request(altitude_ft: Any, speed: Any, flight_path_deg: Any, turn_rate: Any, pull_up_g: Any) -> _Request:
    return (
        number("altitude_ft", altitude_ft),
        number("true_airspeed_fps", speed),
        number("flight_path_deg", flight_path_deg),
        number("turn_rate_deg_s", turn_rate),
        None if pull_up_g is None else number("pull_up_g", pull_up_g),
    )


def _grid_axis(name: str, values: Any, above: float) -> DoubleArray:
    axis: DoubleArray = rows(name, values, (None,), np.float64)
    if axis.size == 0 or not np.isfinite(axis).all() or not (axis > above).all():
        raise ConfigurationError(f"{name} must hold finite numbers" + (" above 0" if above == 0 else ""))
    return axis


def _require_trim(what: str, point: Any) -> None:
    if not isinstance(point, Trim):
        raise ConfigurationError(f"{what}: a skein.Trim is needed, not {type(point).__name__}")

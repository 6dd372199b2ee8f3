# SPDX-License-Identifier: Apache-2.0
"""Reward and termination by functions of Python."""
from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skein import _skein
from skein._skein import OBSERVATION_NAMES, TERMINATION_NAMES, ConfigurationError, Error
from skein.checks import NO_ARRAY, UnknownName, reason_of

FloatArray = NDArray[np.float32]
BoolArray = NDArray[np.bool_]

CUSTOM_TERMINATION = len(TERMINATION_NAMES)
"""What info["termination"] has where a function ended the episode; its name is "custom"."""

_NON_FINITE = TERMINATION_NAMES.index("non_finite")

_ERROR_NAMES = OBSERVATION_NAMES[:3]


def _altitude(at: FlightColumns) -> Any:
    return -at["down_ft"]


def _roll(at: FlightColumns) -> Any:
    return np.arctan2(
        2 * (at["q0"] * at["qx"] + at["qy"] * at["qz"]), 1 - 2 * (at["qx"] ** 2 + at["qy"] ** 2)
    )


def _pitch(at: FlightColumns) -> Any:
    return np.arcsin(np.clip(2 * (at["q0"] * at["qy"] - at["qz"] * at["qx"]), -1, 1))


def _yaw(at: FlightColumns) -> Any:
    return np.arctan2(
        2 * (at["q0"] * at["qz"] + at["qx"] * at["qy"]), 1 - 2 * (at["qy"] ** 2 + at["qz"] ** 2)
    )


def _airspeed(at: FlightColumns) -> Any:
    axis = np.stack([at["qx"], at["qy"], at["qz"]])
    body = np.stack([at["u_fps"], at["v_fps"], at["w_fps"]])
    turned = 2 * np.cross(axis, body, axis=0)
    over_ground = body + at["q0"] * turned + np.cross(axis, turned, axis=0)
    wind = np.stack([at["wind_north_fps"], at["wind_east_fps"], at["wind_down_fps"]])
    return np.linalg.norm(over_ground - wind, axis=0)


_DERIVED: dict[str, Callable[[FlightColumns], Any]] = {
    "altitude_ft": _altitude,
    "roll_rad": _roll,
    "pitch_rad": _pitch,
    "yaw_rad": _yaw,
    "true_airspeed_fps": _airspeed,
}


def _read_only(column: NDArray[Any]) -> NDArray[Any]:
    column.flags.writeable = False
    return column


class FlightColumns(Mapping[str, NDArray[Any]]):
    """What a function that rewards or terminates is given: columns by name, one number for each aircraft, float32
    (num_envs,), in the unit of its name. They are read-only: reward and terminated see the same.

    The state at the end of the policy step, or at the end of the episode if that came before:
      those of FlightVectorEnv.state(): u_fps, v_fps, w_fps (body axes, over ground), p_rad_s, q_rad_s, r_rad_s,
      north_ft, east_ft, down_ft, q0, qx, qy, qz, power_percent, power_command_percent, elevator_deg, aileron_deg,
      rudder_deg, leading_edge_flap_deg, nz_g, ny_g, wind_north_fps, wind_east_fps, wind_down_fps;
      altitude_ft, roll_rad, pitch_rad, yaw_rad (in [-pi, pi]), true_airspeed_fps, made of those.
    The targets in force when the step began: of Heading target_altitude_ft, target_yaw_rad, target_true_airspeed_fps;
      of Control target_pitch_rad, target_yaw_rad, target_true_airspeed_fps; of Tracking target_north_ft,
      target_east_ft, target_altitude_ft. Of a task file those that it has.
    The task's errors without noise, as they are observed: error_0_scaled, error_1_scaled, error_2_scaled (F-16: lengths
      in km, angles in rad, speeds in 340 m/s). Those of a task file are in its order; of errors that it has not, zeros.
    The actions, clipped: action_throttle, action_pitch, action_roll, action_yaw in [-1, 1] (of a high-level policy
      action_target_pitch, action_target_yaw, action_target_speed).
    What the task says: reward, of the policy step, and termination (uint8, an index of TERMINATION_NAMES).

    It is a Mapping: `in` and `get` serve, and a name that it does not have is a ConfigurationError and a KeyError.
    """

    def __init__(self, columns: dict[str, NDArray[Any]]) -> None:
        self._columns = {name: _read_only(column) for name, column in columns.items()}

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._columns:
            if name not in _DERIVED:
                raise UnknownName(f'there is no column "{name}"; known: {", ".join(self)}')
            self._columns[name] = _read_only(_DERIVED[name](self))
        return self._columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self._columns or name in _DERIVED

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys((*self._columns, *_DERIVED)))

    def __len__(self) -> int:
        return sum(1 for _ in self)


Rule = Callable[[FlightColumns], Any]
"""A function that rewards or terminates: it is given skein.FlightColumns after every policy step, and returns one
number or truth value for each aircraft, (num_envs,)."""
Ends = tuple[NDArray[np.int64], FloatArray, FloatArray, NDArray[np.int32]]


class CustomRules:
    """A user's functions in the place of the task's reward and beside its termination."""

    def __init__(self, core: _skein.BatchEnv, reward: Rule | None, terminated: Rule | None) -> None:
        for name, rule in (("reward", reward), ("terminated", terminated)):
            if rule is not None and not callable(rule):
                raise ConfigurationError(f"{name} must be a function of columns, not {type(rule).__name__}")
        core.keep_last_states()
        self._core, self._reward, self._terminated = core, reward, terminated
        self._action_names = [f"action_{name}" for name in _action_names(core)]
        self._flight_names = (*_skein.SHOWN_STATE_NAMES, *_ERROR_NAMES, *core.target_names)
        self._returns = np.zeros(core.num_envs)
        self._steps = np.zeros(core.num_envs, np.int32)
        self._is_judged = True

    def begin(self, begins: BoolArray) -> None:
        """Some episodes begin."""
        self._returns[begins] = 0
        self._steps[begins] = 0
        self._is_judged |= bool(begins.all())

    def step(
        self,
        actions: Any,
        observation: FloatArray,
        reward: FloatArray,
        termination: NDArray[np.uint8],
        terminated: BoolArray,
        truncated: BoolArray,
    ) -> int:
        """BatchEnv.step, then the functions; returns how many episodes ended."""
        if not self._is_judged:
            raise Error(
                "step: reward or terminated failed in the step before, or that was interrupted, "
                "so that it has no result; reset all"
            )
        actions = np.ascontiguousarray(actions, np.float32)
        try:
            ended = self._core.step(actions, observation, reward, termination, terminated, truncated)
            return ended + self._judge(actions, observation, reward, termination, terminated, ended)
        except BaseException:  # also an interrupt
            self._is_judged = False
            raise

    def _judge(
        self,
        actions: FloatArray,
        observation: FloatArray,
        reward: FloatArray,
        termination: NDArray[np.uint8],
        terminated: BoolArray,
        ended: int,
    ) -> int:
        """What the functions say of a step in which the task `ended` episodes; returns how many they ended."""
        columns: dict[str, NDArray[Any]] = dict(zip(self._flight_names, self._core.last_states(), strict=True))
        columns |= zip(self._action_names, np.clip(actions, -1, 1).T, strict=True)
        shown = FlightColumns(columns | {"reward": reward.copy(), "termination": termination.copy()})
        ends = self._result("terminated", self._terminated, shown, bool)
        lost = termination == _NON_FINITE  # no function can judge what is not finite
        rewards = self._result("reward", self._reward, shown, np.float32, lost)
        if rewards is not None:
            reward[:] = np.where(lost, reward, rewards)
        self._returns += reward
        self._steps += self._core.action_repeat
        self._ended: list[tuple[Any, ...]] = []
        if ended:
            index, final, _, steps = self._core.ends()
            self._ended.append((index, final, steps[index]))
        if ends is not None:
            ends &= termination == 0
            return self._end(ends, observation, termination, terminated)
        return 0

    def ends(self) -> Ends:
        """As of BatchEnv.ends, of episodes that the task or the function ended in the latest step."""
        index, final, ended_steps = (np.concatenate(parts) for parts in zip(*self._ended, strict=True))
        returns = np.zeros(self._core.num_envs, np.float32)
        steps = np.zeros(self._core.num_envs, np.int32)
        returns[index], steps[index] = self._returns[index], ended_steps
        self._returns[index] = 0
        self._steps[index] = 0
        return index, final, returns, steps

    def _end(
        self, ends: BoolArray, observation: FloatArray, termination: NDArray[np.uint8], terminated: BoolArray
    ) -> int:
        index = np.flatnonzero(ends)
        if not len(index):
            return 0
        self._ended.append((index, observation[index], self._steps[index]))
        termination[index] = CUSTOM_TERMINATION
        terminated[index] = True
        self._core.restart(ends)
        self._core.observe(observation)
        return len(index)

    def _result(
        self, name: str, rule: Rule | None, columns: FlightColumns, dtype: Any, lost: BoolArray | None = None
    ) -> NDArray[Any] | None:
        if rule is None:
            return None
        given = rule(columns)  # what it raises comes through
        kinds, numbers = ("b", "truth values") if dtype is bool else ("fiub", "numbers")
        wanted = f"{name} must return {numbers} of shape ({self._core.num_envs},), but it returned"
        try:
            returned = np.asarray(given)
        except NO_ARRAY as error:
            raise Error(f"{wanted} {type(given).__name__}{reason_of(error)}") from error
        if returned.shape != (self._core.num_envs,) or returned.dtype.kind not in kinds:
            raise Error(f"{wanted} {returned.dtype} of shape {returned.shape}")
        with np.errstate(over="ignore"):
            result: NDArray[Any] = returned.astype(dtype)
        is_finite = np.isfinite(result) if lost is None else np.isfinite(result) | lost
        if not is_finite.all():
            where = is_finite.argmin()
            raise Error(f"{name} must return numbers finite in float32, but it did not for aircraft {where}")
        return result


def _action_names(core: _skein.BatchEnv) -> tuple[str, ...]:
    is_low_level = core.action_size == len(_skein.ACTION_NAMES)
    return _skein.ACTION_NAMES if is_low_level else _skein.HIGH_LEVEL_ACTION_NAMES


# SPDX-License-Identifier: Apache-2.0
"""Skein's aircraft as Gymnasium environments."""
from __future__ import annotations

import os
import pathlib
import re
import threading
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, Union, cast

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from skein import _skein
from skein._skein import (
    ACTION_NAMES,
    HIGH_LEVEL_ACTION_NAMES,
    OBSERVATION_NAMES,
    TASKS,
    TERMINATION_NAMES,
    Config,
    ConfigurationError,
    Error,
)
from skein.agents import Agent
from skein.checks import (
    MOST_ENVIRONMENTS,
    MOST_SEED,
    MOST_THREADS,
    UnknownArgument,
    flags,
    rows,
    shown,
    text,
    truth_value,
    whole_number,
)
from skein.configuration import Task, configure
from skein.custom_rules import CUSTOM_TERMINATION, CustomRules, Rule
from skein.messages import in_words_of_python

FloatArray = NDArray[np.float32]
BoolArray = NDArray[np.bool_]
Info = dict[str, Any]

# The largest normal deviate of the noise: the smallest uniform number that it is made of is 2^-32.
_LARGEST_DEVIATE = 7.0
_ROUNDING = 1e-6  # sines and cosines of float32 kernels
_SAYS_STAGGER_CLOCKS = re.compile(r"^[^#\n]*\bstagger_clocks\b", re.MULTILINE)
_TERMINATIONS = np.array((*TERMINATION_NAMES, "custom"), dtype=object)
assert len(_TERMINATIONS) == CUSTOM_TERMINATION + 1


def _bound(name: str, surface_reaches: Mapping[str, float]) -> float:
    """The most that an observation without noise can be, up or down; infinite where physics, or a task file that
    scales it, sets no limit."""
    if name.endswith("_scaled") or not (name.startswith(("sin_", "cos_")) or name.endswith("_fraction")):
        return np.inf
    return surface_reaches.get(name, 1.0) + _ROUNDING


def _observation_space(core: _skein.BatchEnv) -> spaces.Space[FloatArray]:
    reaches = core.surface_reaches
    high = np.array([_bound(name, reaches) for name in core.observation_names])
    if core.draws_plants:  # other ranges of surfaces, and sensors that are biased
        high[:] = np.inf
    high = (high + _LARGEST_DEVIATE * core.observation_noise).astype(np.float32)
    return cast("spaces.Space[FloatArray]", spaces.Box(-high, high, dtype=np.float32))


def _action_space(core: _skein.BatchEnv) -> spaces.Space[FloatArray]:
    return cast("spaces.Space[FloatArray]", spaces.Box(-1.0, 1.0, (core.action_size,), np.float32))


def _staggers_by_preset(task: Task, config: Mapping[str, Any]) -> bool:
    """Whether env.stagger_clocks is what a preset says, and no Config, file or setting."""
    if isinstance(task, Config) or "env.stagger_clocks" in config or "stagger_clocks" in config.get("env", {}):
        return False
    files = [config["file"]] if config.get("file") else []
    if os.fspath(task) not in TASKS:  # a task file
        files.append(task)
    return not any(_SAYS_STAGGER_CLOCKS.search(pathlib.Path(file).read_text(errors="replace")) for file in files)


def _require_no_rendering(render_mode: Any) -> None:
    if render_mode is not None:
        raise UnknownArgument(
            f"render_mode must be None, not {shown(render_mode)}: look at flights with skein.record and `skein replay`"
        )


class _Flight:
    """What both environments have: the aircraft, their configuration, and the names of what they show and take."""

    config: Config
    """Every setting of what is flown."""
    observation_names: tuple[str, ...] = OBSERVATION_NAMES
    """Of the observation's 22 numbers, in their order (docs/reference/tasks.md has their meaning), or those of the task
    file."""
    action_names: tuple[str, ...]
    """Of the action's numbers, in their order."""

    def _begin_flight(
        self,
        config: Config,
        num_envs: int,
        threads: int,
        low_level: str | os.PathLike[str],
        agent: Agent | None,
        reward: Rule | None,
        terminated: Rule | None,
    ) -> None:
        whole_number("num_envs", num_envs, 1, MOST_ENVIRONMENTS)
        whole_number("threads", threads, 0, MOST_THREADS)
        if not (agent is None or isinstance(agent, Agent)):
            raise ConfigurationError(f"agent must be a skein.Agent, not {type(agent).__name__}")
        core = None if agent is None else agent._core
        with in_words_of_python():
            self.config = config if core is None else core.environment_for(config)
            self._core = _skein.BatchEnv(config, num_envs, 0, threads, text("low_level", low_level), core)
        self.action_names = ACTION_NAMES if self._core.action_size == len(ACTION_NAMES) else HIGH_LEVEL_ACTION_NAMES
        self.observation_names = tuple(self._core.observation_names)
        has_rules = reward is not None or terminated is not None
        self._rules = CustomRules(self._core, reward, terminated) if has_rules else None
        self._stepped = self._core if self._rules is None else self._rules
        self._begun = False
        self._is_closed = False
        self._lock = threading.RLock()
        self._process = os.getpid()

    @property
    def _turn(self) -> AbstractContextManager[bool]:
        """Lets one thread use the environment at a time: whole calls come one after another, and functions that reward
        may call within their step. A process that was forked has none of the threads that step, and a lock that one of
        them held would never be free there: it is refused."""
        if os.getpid() != self._process:
            raise Error(
                "the environment belongs to the process that made it, and this one was forked from it since: "
                "make environments in the process that steps them"
            )
        return self._lock

    @property
    def policy_step_s(self) -> float:
        """Time for which an action is held, s."""
        return self._core.action_repeat * self._core.control_interval_s

    def _require_open(self, what: str) -> None:
        if self._is_closed:
            raise Error(f"{what}: the environment is closed")

    def _new_episodes(self, seed: int | None, draw: np.random.Generator, begins: BoolArray | None) -> None:
        """Begins episodes: those of `seed` if there is one, else the next ones, where `begins` says so."""
        if seed is not None or not self._begun:
            self._core.reset(int(draw.integers(2**53)) if seed is None else seed)
        else:
            self._core.restart(np.ones(self._core.num_envs, bool) if begins is None else begins)
        if self._rules is not None:
            self._rules.begin(np.ones(self._core.num_envs, bool) if begins is None else begins)
        self._begun = True

    def __reduce__(self) -> tuple[Any, ...]:
        name = type(self).__name__
        raise TypeError(f"a {name} can be neither pickled nor copied: make another, and restore a snapshot")

    def _observe(self) -> FloatArray:
        observation = np.empty((self._core.num_envs, self._core.observation_size), np.float32)
        self._core.observe(observation)
        return observation

    def state(self) -> dict[str, FloatArray]:
        """Columns of the true state by name, each float32 (num_envs,), of a single environment (1,), in the unit of its
        name: u_fps, v_fps, w_fps and all others that skein.FlightColumns lists as those of state(); q0, qx, qy, qz are
        the attitude's quaternion. No noise is in them."""
        with self._turn:
            return dict(zip(_skein.SHOWN_STATE_NAMES, self._core.state().T, strict=True))

    def targets(self) -> FloatArray:
        """What is flown to, float32 (num_envs, 3), of a single environment (1, 3): altitude ft, yaw rad and true
        airspeed ft/s for Heading; pitch rad, yaw rad and true airspeed ft/s for Control; north, east and altitude, ft,
        for Tracking. Of a task file the targets that it has, in its order."""
        with self._turn:
            return self._core.targets()

    def snapshot(self) -> NDArray[np.uint32]:
        """The whole mutable state, to go on from with `restore`, and the seed and a hash of the configuration: uint32
        (n,), whose order is its own."""
        with self._turn:
            return self._core.snapshot()

    def _go_on_from(self, snapshot: NDArray[np.uint32]) -> FloatArray:
        """Goes on from a snapshot; returns what is observed there, (num_envs, 22)."""
        self._require_open("restore")
        self._core.restore(rows("snapshot", snapshot, (None,), np.uint32))
        if self._rules is not None:
            self._rules.begin(np.ones(self._core.num_envs, bool))
        self._begun = True
        return self._observe()


class FlightVectorEnv(_Flight, VectorEnv[FloatArray, FloatArray, NDArray[Any]]):
    """Many aircraft that fly one task. `skein.make_vec` makes it.

    Observations are float32 (num_envs, 22) in the order of `observation_names`: names say the unit ("p_rad_s"), or that
    a number is "_scaled" by the aircraft's reference units (F-16: altitude 5 km, errors 1 km and 340 m/s; yaw and pitch
    errors rad), or a fraction of its upper limit. docs/reference/tasks.md has the table. A task file shows its own.

    Actions are float32 (num_envs, 4) in [-1, 1], clipped, in the order of `action_names`: throttle (-1 is idle, 1 is
    maximum: 2 * t - 1 of a throttle t from 0 to 1), pitch (+ nose up), roll (+ right), yaw (+ nose right). Those of a
    high-level policy are three: changes of the pitch, yaw and speed that the low-level policy is to reach, as shares of
    env.high_level's largest. One that is not finite ends its aircraft's episode as "non_finite"; the others fly on.

    An array that `step` returns is written by the simulator, and never again: nothing is copied. Actions may be any
    array that speaks DLPack, such as a tensor of torch; float32 rows on the CPU are read in place. Threads of Python
    run on during a step. Nothing is drawn: `render_mode` is None.

    Episodes that end begin anew in the same step (AutoresetMode.SAME_STEP). Then `info` has, by Gymnasium's rules,
    "final_obs" (an object array: an observation where an episode ended, else None) and "final_info" with
    "termination" (the reason's name), "episode_return" (undiscounted) and "episode_control_steps" (of 0.02 s; both 0
    where none ended), each beside a mask "_final_obs" and so on, all (num_envs,). `info["termination"]` is always
    there: uint8 (num_envs,), an index of TERMINATION_NAMES, 0 while flying.

    `np_random_seed` is the seed that `reset` was given, or that of the snapshot that `restore` went on from. A first
    reset without a seed draws that of its episodes from `np_random`.
    """

    metadata = {"autoreset_mode": AutoresetMode.SAME_STEP, "render_modes": []}

    def __init__(
        self,
        task: Task = "heading",
        num_envs: int = 1,
        *,
        threads: int = 0,
        low_level: str | os.PathLike[str] = "",
        agent: Agent | None = None,
        evaluation: bool = False,
        reward: Rule | None = None,
        terminated: Rule | None = None,
        render_mode: None = None,
        **config: Any,
    ) -> None:
        _require_no_rendering(render_mode)
        configured = configure(task, **config)
        flown = configured.evaluation() if truth_value("evaluation", evaluation) else configured
        self._begin_flight(flown, num_envs, threads, low_level, agent, reward, terminated)
        self.num_envs = int(num_envs)  # an integer of NumPy may be too narrow to count steps with
        self.single_observation_space = _observation_space(self._core)
        self.single_action_space = _action_space(self._core)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[FloatArray, Info]:
        """Begins new episodes; returns observations, float32 (num_envs, 22), and an empty info.

        Args:
            seed: episodes are then those of any other environment with this seed; without it those that follow.
            options: {"reset_mask": bool (num_envs,)} resets a part of them.
        """
        with self._turn:
            self._require_open("reset")
            asked = None if seed is None else whole_number("seed", seed, 0, MOST_SEED)
            unknown = set(options or ()) - {"reset_mask"}
            if unknown:
                raise ConfigurationError(f"reset: unknown option {min(map(str, unknown))}; known: reset_mask")
            mask = (options or {}).get("reset_mask")
            begins = None if mask is None else flags("reset_mask", mask, self.num_envs)
            if begins is not None and (seed is not None or not self._begun):
                raise Error("reset: a part of the environments can only be reset without a seed, after a whole reset")
            super().reset(seed=asked)
            self._new_episodes(asked, self.np_random, begins)
            return self._observe(), {}

    def step(self, actions: Any) -> tuple[FloatArray, FloatArray, BoolArray, BoolArray, Info]:
        """One policy step of every aircraft (`policy_step_s`).

        Args:
            actions: (num_envs, 4), or (num_envs, 3) of a high-level policy, in [-1, 1], clipped; in the order of
                `action_names`.

        Returns:
            observations, float32 (num_envs, 22); rewards, float32 (num_envs,), the sum over the policy step's control
            steps; terminations and truncations, bool (num_envs,); and info (above).
        """
        with self._turn:
            n = self.num_envs
            self._require_open("step")
            if not self._begun:
                raise Error("step: reset begins the first episodes")
            observation = np.empty((n, self._core.observation_size), np.float32)
            reward = np.empty(n, np.float32)
            termination = np.empty(n, np.uint8)
            terminated, truncated = np.empty(n, bool), np.empty(n, bool)
            shown = rows("actions", actions, (n, self._core.action_size))
            ended = self._stepped.step(shown, observation, reward, termination, terminated, truncated)
            info: Info = {"termination": termination}
            if ended:
                self._report_ends(termination, terminated | truncated, info)
            return observation, reward, terminated, truncated, info

    def restore(self, snapshot: NDArray[np.uint32]) -> FloatArray:
        """Goes on from a snapshot of an environment with the same configuration, low-level policy and number, with its
        seed, which np_random_seed then says. Returns what is observed there, float32 (num_envs, 22). Returns of a
        reward of one's own count from there, and beside a `terminated` of one's own so do those of the task, and the
        control steps of episodes that it ends.

        Raises:
            Error: a snapshot of another configuration or number, or none. Nothing has changed then.
        """
        with self._turn:
            observation = self._go_on_from(snapshot)
            super().reset(seed=self._core.seed)
            return observation

    def close_extras(self, **kwargs: Any) -> None:
        self._is_closed = True

    def _report_ends(self, termination: NDArray[np.uint8], mask: BoolArray, info: Info) -> None:
        index, observations, returns, steps = self._stepped.ends()
        final, reasons = np.empty(self.num_envs, object), np.empty(self.num_envs, object)  # of None
        reasons[index] = _TERMINATIONS[termination[index]]
        for row, environment in enumerate(index.tolist()):
            final[environment] = observations[row]
        info["final_obs"], info["_final_obs"] = final, mask
        info["final_info"] = {
            "termination": reasons,
            "_termination": mask,
            "episode_return": returns,
            "_episode_return": mask,
            "episode_control_steps": steps,
            "_episode_control_steps": mask,
        }
        info["_final_info"] = mask


class FlightEnv(_Flight, gymnasium.Env[FloatArray, FloatArray]):
    """One aircraft. `skein.make` makes it. Nothing is drawn: `render_mode` is None.

    An observation is float32 (22,), an action float32 (4,) in [-1, 1], or (3,) of a high-level policy: order, units and
    signs as of FlightVectorEnv. When an episode ends, `info` has "termination" (the reason's name), "episode_return"
    (undiscounted) and "episode_control_steps" (of 0.02 s).

    `np_random_seed` is the seed that `reset` was given, or that of the snapshot that `restore` went on from. A first
    reset without a seed draws that of its episodes from `np_random`.
    """

    metadata = {"render_modes": []}

    def __init__(
        self,
        task: Task = "heading",
        *,
        low_level: str | os.PathLike[str] = "",
        agent: Agent | None = None,
        evaluation: bool = False,
        reward: Rule | None = None,
        terminated: Rule | None = None,
        render_mode: None = None,
        **config: Any,
    ) -> None:
        _require_no_rendering(render_mode)
        configured = configure(task, **config)
        if _staggers_by_preset(task, config):  # which serves batches: here it would only cut the first episode
            configured = configure(configured, env={"stagger_clocks": False})
        flown = configured.evaluation() if truth_value("evaluation", evaluation) else configured
        self._begin_flight(flown, 1, 1, low_level, agent, reward, terminated)
        self.observation_space = _observation_space(self._core)
        self.action_space = _action_space(self._core)
        self._flags = np.empty(1, bool), np.empty(1, bool)
        self._reward, self._termination = np.empty(1, np.float32), np.empty(1, np.uint8)
        self._flying = False

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[FloatArray, Info]:
        """Begins an episode: that of `seed`, or the next one. Returns an observation, float32 (22,), and an empty
        info."""
        with self._turn:
            self._require_open("reset")
            asked = None if seed is None else whole_number("seed", seed, 0, MOST_SEED)
            if options:
                raise ConfigurationError(f"reset: unknown option {next(iter(options))}; there are none")
            super().reset(seed=asked)
            if asked is not None or self._flying or not self._begun:  # else the next episode has begun with the step
                self._new_episodes(asked, self.np_random, None)
            self._flying = True
            return self._observe()[0], {}

    def step(self, action: Any) -> tuple[FloatArray, float, bool, bool, Info]:
        """One policy step (`policy_step_s`) with an action (4,), or (3,) of a high-level policy, in [-1, 1], clipped;
        in the order of `action_names`.

        Returns:
            observation, float32 (22,); reward, the sum over the policy step's control steps; terminated, truncated,
            info.
        """
        with self._turn:
            self._require_open("step")
            if not self._flying:
                over = "the episode is over; reset begins another" if self._begun else "reset begins the first episode"
                raise Error(f"step: {over}")
            observation = np.empty((1, self._core.observation_size), np.float32)
            shown = rows("action", action, (self._core.action_size,))[None]
            ended = self._stepped.step(shown, observation, self._reward, self._termination, *self._flags)
            reward = float(self._reward[0])
            if not ended:
                return observation[0], reward, False, False, {}
            self._flying = False
            _, final, returns, steps = self._stepped.ends()
            info = {
                "termination": _TERMINATIONS[self._termination[0]],
                "episode_return": float(returns[0]),
                "episode_control_steps": int(steps[0]),
            }
            return final[0], reward, bool(self._flags[0][0]), bool(self._flags[1][0]), info

    def restore(self, snapshot: NDArray[np.uint32]) -> FloatArray:
        """Goes on from a snapshot of an environment with the same configuration, in the middle of its episode, with its
        seed, which np_random_seed then says. Returns what is observed there, float32 (22,).

        Raises:
            Error: as of FlightVectorEnv.restore.
        """
        with self._turn:
            observation: FloatArray = self._go_on_from(snapshot)[0]
            super().reset(seed=self._core.seed)
            self._flying = True
            return observation

    def close(self) -> None:
        """Ends its use: a step or reset after it is an Error."""
        self._is_closed = True


def make_vec(
    task: Task,
    num_envs: int,
    *,
    preset: str = "default",
    file: str | os.PathLike[str] = "",
    conditions: Sequence[str] | Mapping[str, str | float] = (),
    threads: int = 0,
    low_level: str | os.PathLike[str] = "",
    agent: Agent | None = None,
    evaluation: bool = False,
    reward: Rule | None = None,
    terminated: Rule | None = None,
    **settings: Any,
) -> FlightVectorEnv:
    """`num_envs` aircraft that fly `task`, as a Gymnasium VectorEnv.

        envs = skein.make_vec("heading", 4096, conditions=["noisy=0.03"], **{"env.action_repeat": 10})

    Args:
        task, preset, file, conditions, settings: what is flown (skein.configure).
        num_envs: aircraft.
        threads: that step them, 0: one for each CPU it may use. Results do not depend on it.
        low_level: for presets of Tracking that are flown by a high-level policy ("planner", "paper"): what flies below
            it, a policy file or run of task control, or "autopilot".
        agent: who is to fly: its own choices, such as the rate at which it acts, then hold, and a high-level policy
            brings its low-level policy.
        evaluation: leave out what only serves training: staggered clocks, training tolerances, stronger noise,
            starts in a bank or a pull.
        reward: a function that is given columns by name (skein.FlightColumns) after every policy step, and returns the
            rewards in the place of the task's, numbers (num_envs,).
        terminated: one that returns where episodes end, bool (num_envs,), beside where the task ends them. Their
            termination is "custom", and CUSTOM_TERMINATION in info["termination"].

    Raises:
        ConfigurationError: as of skein.configure, and where low_level does not suit the task.
        What reward or terminated raises comes through; its step has no result, and the next needs a reset of all, or
        restore.
    """
    return FlightVectorEnv(
        task,
        num_envs,
        threads=threads,
        low_level=low_level,
        agent=agent,
        evaluation=evaluation,
        reward=reward,
        terminated=terminated,
        **_given(preset, file, conditions),
        **settings,
    )


def make(
    task: Task,
    *,
    preset: str = "default",
    file: str | os.PathLike[str] = "",
    conditions: Sequence[str] | Mapping[str, str | float] = (),
    low_level: str | os.PathLike[str] = "",
    agent: Agent | None = None,
    evaluation: bool = False,
    reward: Rule | None = None,
    terminated: Rule | None = None,
    **settings: Any,
) -> FlightEnv:
    """One aircraft that flies `task`, as a Gymnasium Env: arguments as of make_vec. The same is registered as
    gymnasium.make("skein/Heading-v0"), "skein/Control-v0" and "skein/Tracking-v0".

    env.stagger_clocks, by which presets begin the first episodes of many aircraft at different times, is off here
    unless a Config, a file or a setting says otherwise: the first episode would only be cut.
    """
    return FlightEnv(
        task,
        low_level=low_level,
        agent=agent,
        evaluation=evaluation,
        reward=reward,
        terminated=terminated,
        **_given(preset, file, conditions),
        **settings,
    )


def _given(preset: str, file: Union[str, os.PathLike[str]], conditions: Any) -> dict[str, Any]:
    return {"preset": preset, "file": file, "conditions": conditions}


def register_environments() -> None:
    """Makes the tasks known to gymnasium.make and gymnasium.make_vec."""
    for task in TASKS:
        name = f"skein/{task.capitalize()}-v0"
        if name in gymnasium.registry:
            continue
        gymnasium.register(
            name,
            entry_point="skein.environment:FlightEnv",
            vector_entry_point="skein.environment:FlightVectorEnv",
            kwargs={"task": task},
        )

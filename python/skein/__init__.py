# SPDX-License-Identifier: Apache-2.0
"""Skein from Python: thousands of fixed-wing aircraft as a Gymnasium environment, policies, autopilots, evaluation,
training, and the flight dynamics model.

    import skein
    envs = skein.make_vec("heading", 4096)
    observations, info = envs.reset(seed=1)
    observations, rewards, terminated, truncated, info = envs.step(envs.action_space.sample())

Arrays of environments and agents are float32, [environment][quantity], those of the flight dynamics model float64.
Units are those of the configuration keys' and columns' names. What cannot be is a skein.Error; if it was asked for so,
a skein.ConfigurationError, which is also a ValueError.

Tuples of names say the order of arrays:
    OBSERVATION_NAMES: an observation's 22 numbers, but of a task file (FlightVectorEnv.observation_names).
    ACTION_NAMES: an action's 4, in [-1, 1]: throttle, pitch, roll, yaw.
    HIGH_LEVEL_ACTION_NAMES: the 3 of a high-level policy's.
    TERMINATION_NAMES: why an episode ended; info["termination"] is an index of it, or CUSTOM_TERMINATION.
    STATE_NAMES: the 13 of a state of trim, linearise and simulate: u, v, w (body axes, ft/s), p, q, r (rad/s), north,
        east, down (ft), q0, qx, qy, qz.
    CONTROL_NAMES: the 5 of their controls: thrust (lbf, not throttle), elevator, aileron, rudder, leading-edge flap
        (deg).
TASKS and AIRCRAFT are those that come with Skein.
"""
from skein._skein import (
    ACTION_NAMES,
    AIRCRAFT,
    HIGH_LEVEL_ACTION_NAMES,
    OBSERVATION_NAMES,
    TASKS,
    TERMINATION_NAMES,
    Config,
    ConfigurationError,
    Error,
    __version__,
    simd_target,
)
from skein.agents import Agent, AgentLike, load_policy
from skein.configuration import Task, configure, presets
from skein.custom_rules import CUSTOM_TERMINATION, FlightColumns, Rule
from skein.environment import FlightEnv, FlightVectorEnv, make, make_vec, register_environments
from skein.evaluation import Comparison, Evaluation, compare, evaluate, record
from skein.flight_dynamics import (
    CONTROL_NAMES,
    STATE_NAMES,
    LinearModel,
    Trajectory,
    Trim,
    TrimGrid,
    flying_qualities,
    linear_models,
    linearise,
    simulate,
    trim,
    trim_grid,
)
from skein.training import Run, train

__all__ = [
    "ACTION_NAMES",
    "AIRCRAFT",
    "CONTROL_NAMES",
    "CUSTOM_TERMINATION",
    "HIGH_LEVEL_ACTION_NAMES",
    "OBSERVATION_NAMES",
    "STATE_NAMES",
    "TASKS",
    "TERMINATION_NAMES",
    "Agent",
    "AgentLike",
    "Comparison",
    "Config",
    "ConfigurationError",
    "Error",
    "Evaluation",
    "FlightColumns",
    "FlightEnv",
    "FlightVectorEnv",
    "LinearModel",
    "Rule",
    "Run",
    "Task",
    "Trajectory",
    "Trim",
    "TrimGrid",
    "__version__",
    "compare",
    "configure",
    "evaluate",
    "flying_qualities",
    "linear_models",
    "linearise",
    "load_policy",
    "make",
    "make_vec",
    "presets",
    "record",
    "simd_target",
    "simulate",
    "train",
    "trim",
    "trim_grid",
]

register_environments()

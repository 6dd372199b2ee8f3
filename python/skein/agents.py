# SPDX-License-Identifier: Apache-2.0
"""Who flies: trained policies, autopilots, and functions of Python."""
from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from skein import _skein
from skein._skein import Config, ConfigurationError
from skein.checks import (
    MOST_ENVIRONMENTS,
    MOST_POLICY_STEP,
    MOST_SEED,
    MOST_SIZE,
    is_vector,
    rows,
    text,
    truth_value,
    whole_number,
)
from skein.configuration import Task, configure
from skein.messages import in_words_of_python

FloatArray = NDArray[np.float32]


class Agent:
    """Who flies an aircraft: what it observes and does is ordered and scaled as in skein.FlightVectorEnv. Immutable;
    its memory of each aircraft lies with the caller, as rows of `state`. A copy is the agent itself; one that is
    pickled is made again from the same arguments, so that its file must be there, unchanged."""

    def __init__(self, name: str, task: Task = "heading", *, seed: int = 0, **config: Any) -> None:
        """An agent by the name that `skein compare --agents` gives it: "autopilot" ("autopilot:aggressive"),
        "autopilot:VARIANT", "policy:FILE_OR_RUN" with "@sampled" behind it or not, "random[:SECONDS]", "zero".

        Args:
            name: of the agent.
            task, config: what it is to fly (skein.configure).
            seed: of what `act` draws; evaluate, compare and record draw by their own.

        Raises:
            Error: an unknown name, a file that is no policy, an autopilot without gains for the aircraft.
        """
        whole_number("seed", seed, 0, MOST_SEED)
        configured = configure(task, **config)
        with in_words_of_python():
            self._core = _skein.named_agent(text("name", name), configured, seed)
        self._seed = seed
        self._make: Callable[[], Agent] = partial(Agent, name, configured, seed=seed)

    @classmethod
    def _of(cls, core: _skein.FlyingAgent, seed: int, make: Callable[[], Agent]) -> Agent:
        agent = cls.__new__(cls)
        agent._core, agent._seed, agent._make = core, seed, make
        return agent

    @property
    def name(self) -> str:
        """What messages and tables call it."""
        return self._core.name

    @property
    def task(self) -> str:
        """The task that a policy was trained for; empty where that is not known."""
        return self._core.task

    @property
    def observation_size(self) -> int:
        """Numbers that it observes of each aircraft."""
        return self._core.observation_size

    @property
    def action_size(self) -> int:
        """Numbers of its actions for each."""
        return self._core.action_size

    @property
    def state_size(self) -> int:
        """Numbers that it remembers of each."""
        return self._core.state_size

    @property
    def action_repeat(self) -> int:
        """Control steps (0.02 s) for which its actions are to be held."""
        return self._core.action_repeat

    @property
    def is_high_level(self) -> bool:
        """Whether a low-level policy flies for it."""
        return self._core.is_high_level

    @property
    def draws(self) -> bool:
        """Whether its actions are drawn at random, as those of "random" and of a policy that is sampled."""
        return self._core.draws

    def initial_state(self, count: int) -> FloatArray:
        """Memory at the beginning of episodes: zeros, float32 (count, state_size)."""
        return np.zeros((whole_number("count", count, 0, MOST_ENVIRONMENTS), self.state_size), np.float32)

    def act(
        self, observation: Any, state: FloatArray | None = None, *, policy_step: int | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """One policy step.

        Args:
            observation: float32 (count, observation_size), or (observation_size,) for one aircraft, as environments
                return them: not normalised, in the order of FlightVectorEnv.observation_names.
            state: memory of each aircraft, float32 (count, state_size), that the step before returned; None, or rows
                of zeros, where an episode begins.
            policy_step: of one that draws, which policy step it is: 0, 1, 2 and so on. What it draws depends on the
                seed, this and the row alone, so that a step that is given again draws the same. Others do not need it.

        Returns:
            actions, float32 (count, action_size), or (action_size,), in the order of FlightVectorEnv.action_names; and
            the memory after the step, float32 (count, state_size). Actions of a policy that is sampled may lie beyond
            [-1, 1]; the environment clips them.

        Raises:
            ConfigurationError: arrays of another shape, or no policy_step for an agent that draws.
        """
        is_one = is_vector(observation)
        shape = (self.observation_size,) if is_one else (None, self.observation_size)
        seen = rows("observation", observation, shape)
        if is_one:
            seen = seen[None]
        if state is None:
            memory = self.initial_state(len(seen))
        else:
            size = (self.state_size,) if is_one and is_vector(state) else (len(seen), self.state_size)
            memory = rows("state", state, size).reshape(len(seen), self.state_size)
        if policy_step is None:
            if self.draws:
                raise ConfigurationError(f"agent {self.name}: policy_step is needed: 0, 1, 2 ...; it draws by it")
            policy_step = 0
        whole_number("policy_step", policy_step, 0, MOST_POLICY_STEP)
        action, after = self._core.act(seen, memory, self._seed, policy_step)
        return (action[0], after) if is_one else (action, after)

    def __repr__(self) -> str:
        return f"<skein.Agent {self.name}>"

    def __copy__(self) -> Agent:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Agent:
        return self

    def __reduce__(self) -> tuple[Callable[[], Agent], tuple[()]]:
        return self._make, ()


AgentLike = Union[Agent, str, Callable[..., Any]]
"""An agent, its name (skein.Agent), or a function of Python: it is given float32 observations (count, 22), or as many
as a task file shows, and returns actions (count, 4) in [-1, 1], both ordered as in skein.FlightVectorEnv. Attributes of
the function may say more: `action_repeat`, the control steps for which its actions are held (else the configuration's);
`action_size`; and `state_size`: then it is also given its memory of the aircraft, float32 (count, state_size), zeros
where an episode begins, and returns a pair, actions and memory. It must not depend on which aircraft come together in a
call. Calls come in several threads, one before another has ended (threads=1: one at a time, in the caller's): what
holds for a thread alone, such as torch.no_grad, is said within the function."""


def load_policy(path: str | os.PathLike[str], *, sampled: bool = False, seed: int = 0) -> Agent:
    """The trained policy in a policy file, checkpoint, or directory of a run (its best).

    Args:
        path: of it.
        sampled: draw actions from its distribution instead of taking the mean. Agent.act then needs policy_step.
        seed: of what `act` draws; evaluate, compare and record draw by their own.

    Raises:
        Error: a file that is missing, damaged, or none of Skein's.
    """
    whole_number("seed", seed, 0, MOST_SEED)
    if not (file := text("path", path)):
        raise ConfigurationError("path must name a policy file, checkpoint or run, and is empty")
    with in_words_of_python():
        core = _skein.load_agent(file, truth_value("sampled", sampled))
    return Agent._of(core, seed, partial(load_policy, path, sampled=sampled, seed=seed))


def agent_of(agent: AgentLike, config: Config, seed: int) -> Agent:
    """Whatever may stand for an agent, as one for the environment of `config`."""
    if isinstance(agent, Agent):
        return agent
    if isinstance(agent, str):
        return Agent(agent, config, seed=seed)
    if not callable(agent):
        raise ConfigurationError(
            f"an agent is a skein.Agent (skein.load_policy makes one of a file), a name or a function of observations, "
            f"not {type(agent).__name__}"
        )
    name = getattr(agent, "__name__", type(agent).__name__)
    repeat = whole_number("action_repeat", getattr(agent, "action_repeat", config["env.action_repeat"]), 1, MOST_SIZE)
    action_size = whole_number("action_size", getattr(agent, "action_size", len(_skein.ACTION_NAMES)), 1, MOST_SIZE)
    state_size = whole_number("state_size", getattr(agent, "state_size", 0), 0, MOST_SIZE)
    core = _skein.callable_agent(agent, name, config, action_size, repeat, state_size)
    return Agent._of(core, seed, partial(agent_of, agent, config, seed))

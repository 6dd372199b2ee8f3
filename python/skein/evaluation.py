# SPDX-License-Identifier: Apache-2.0
"""How well agents fly: the same episodes for all of them."""
from __future__ import annotations

import io
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from skein import _skein
from skein._skein import ConfigurationError
from skein.agents import Agent, AgentLike, agent_of
from skein.checks import MOST_EPISODES, MOST_SEED, MOST_THREADS, shown, text, whole_number
from skein.configuration import Task, configure
from skein.messages import in_words_of_python
from skein.training import Run

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class Evaluation:
    """How an agent flew its episodes: skein.evaluate finds it.

    `columns` are by name, each (episodes,), one number for each episode in their order: "episode_return",
    "control_steps" (of 0.02 s), "termination" and more, units in their names. `summary` is a dict of what
    `skein eval --json` writes.
    """

    summary: dict[str, Any]
    """The keys of `skein eval --json`: episodes, success_rate, return_mean, time_to_target_mean (s), terminations, and
    estimates with 95 % intervals."""
    columns: dict[str, NDArray[Any]]
    """One number for each episode, in their order, (episodes,): termination (an index of TERMINATION_NAMES), succeeded,
    episode_return, control_steps, reached_step and entered_step (control steps at which the target counted, and its
    tolerances were entered; 0: never), and the flight metrics and peaks of docs/reference/metrics.md, units in
    their names. What is of holds and missions stands in `summary`."""
    starts: int
    """A hash of initial states and targets: equal for agents that flew the same episodes."""

    def __repr__(self) -> str:
        episodes = len(self.columns["episode_return"])
        return (
            f"Evaluation({episodes} episodes, success {100 * self.success_rate:.1f} %, "
            f"{self.time_to_target_mean_s:.2f} s to the target, return {self.return_mean:.1f})"
        )

    @property
    def success_rate(self) -> float:
        """Share of the episodes that reached their target."""
        return float(self.summary["success_rate"])

    @property
    def return_mean(self) -> float:
        """Mean undiscounted return."""
        return float(self.summary["return_mean"])

    @property
    def time_to_target_mean_s(self) -> float:
        """Mean time to the target of the episodes that reached it, s; NaN if none did."""
        time = self.summary["time_to_target_mean"]
        return float("nan") if time is None else float(time)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each episode; terminations by name."""
        import pandas

        table = pandas.DataFrame(self.columns)
        table["termination"] = np.array(_skein.TERMINATION_NAMES)[self.columns["termination"]]
        table["succeeded"] = self.columns["succeeded"].astype(bool)
        return table


@dataclass(frozen=True)
class Comparison:
    """How agents flew the same episodes: skein.compare finds it. `text` is a table, which print shows; `summary` a dict
    of what `skein compare --json` writes."""

    summary: dict[str, Any]
    """The document of `skein compare --json`: agents, each with estimates, and its paired differences against the
    first."""
    text: str
    """The table that `skein compare` prints."""

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        names = ", ".join(agent["name"] for agent in self.summary["agents"])
        return f"Comparison({self.summary['task']}, {self.summary['episodes']} episodes: {names})"


def evaluate(
    agent: AgentLike,
    task: Task = "",
    *,
    episodes: int = 1000,
    seed: int = 0,
    threads: int = 0,
    **config: Any,
) -> Evaluation:
    """Flies an agent over fresh episodes, as `skein eval` does: the same bits for the same arguments.

    Args:
        agent: an Agent, its name, or a function of observations, float32 (count, 22), that returns actions (count, 4)
            in [-1, 1], both ordered as in skein.FlightVectorEnv (all that it may be: skein.AgentLike in the reference).
        task, config: what is flown (skein.configure). If task is left out: of a run's policy the run's configuration;
            of a policy file its task, by the preset default, or if that is of another aircraft than the policy's by the
            first that is made for that. preset stands in place of both; file and settings come on top.
        episodes: number of them.
        seed: of the episodes; the i-th depends on configuration, seed and i alone.
        threads: 0: one for each CPU it may use. Results do not depend on it.

    Raises:
        Error: the agent does not fit the task. What a function raises comes through.
    """
    _check_counts(episodes, seed, threads)
    configured = configure(_task_of("evaluate", agent, task, config), **config)
    core = agent_of(agent, configured, seed)._core
    with in_words_of_python():
        summary, columns, starts = _skein.evaluate(core, configured, episodes, seed, threads)
    return Evaluation(json.loads(summary), columns, starts)


def compare(
    agents: Sequence[AgentLike] | Mapping[str, AgentLike],
    task: Task,
    *,
    episodes: int = 1000,
    seed: int = 0,
    threads: int = 0,
    **config: Any,
) -> Comparison:
    """Flies agents over the same episodes, each at its own rate, as `skein compare` does: arguments as of evaluate.

    Args:
        agents: at least one, no two of the same name; a dict gives them their names.
    """
    _check_counts(episodes, seed, threads)
    configured = configure(task, **config)
    if not isinstance(agents, (Mapping, list, tuple)):
        raise ConfigurationError(f"compare: agents must be a list or a dict, not {type(agents).__name__}")
    named = agents.values() if isinstance(agents, Mapping) else agents
    cores = [agent_of(agent, configured, seed)._core for agent in named]
    if not cores:
        raise ConfigurationError("compare: no agents")
    names = [core.name for core in cores]
    if isinstance(agents, Mapping):
        names = [text("compare: the name of an agent", str(name)) for name in agents]
    if twice := next((name for i, name in enumerate(names) if name in names[:i]), None):
        raise ConfigurationError(f"compare: {shown(twice)} is there twice: use a dict to name the agents")
    with in_words_of_python():
        summary, table = _skein.compare(cores, names, configured, episodes, seed, threads)
    return Comparison(json.loads(summary), table)


def _task_of(what: str, agent: AgentLike, task: Task, config: Mapping[str, Any]) -> Task:
    """`task`, or where that is left out a policy's own: its configuration, or by its name where `config` chooses
    another preset."""
    if not task and isinstance(agent, (Agent, str)):
        policy = agent._core if isinstance(agent, Agent) else _skein.policy_called(text("name", agent))
        if policy is not None:
            is_chosen = "preset" in config and policy.task in _skein.TASKS
            task = policy.task if is_chosen else policy.own_config or ""
    if not task and isinstance(agent, (str, os.PathLike)) and _is_policy_or_run(agent):
        path = shown(os.fspath(agent))
        raise ConfigurationError(f"{what}: {path} is a path and no agent: skein.load_policy makes one")
    if not task and isinstance(agent, Run):
        raise ConfigurationError(f"{what}: a run is no agent: its policy is")
    if not task:
        raise ConfigurationError(f"{what}: task is needed: the agent does not say its own")
    return task


def _is_policy_or_run(path: str | os.PathLike[str]) -> bool:
    return os.path.isfile(path) or os.path.isfile(os.path.join(path, "config.toml"))


def _check_counts(episodes: int, seed: int, threads: int) -> None:
    whole_number("number of episodes", episodes, 1, MOST_EPISODES)
    whole_number("seed", seed, 0, MOST_SEED)
    whole_number("threads", threads, 0, MOST_THREADS)


def record(
    agent: AgentLike,
    task: Task = "",
    *,
    count: int = 8,
    seed: int = 0,
    threads: int = 0,
    observations: bool = False,
    **config: Any,
) -> pandas.DataFrame:
    """Flights as a table, a row for every control step of 0.02 s: the first `count` episodes of evaluate, the columns
    of docs/reference/file-formats.md (Flights), units in their names. Flights that could have more than 5,000,000
    control steps together are a ConfigurationError.

    Args:
        agent, task, config, seed, threads: as of evaluate.
        count: of flights.
        observations: also what was observed, noise included, a column for each number.
    """
    import pandas

    _check_counts(count, seed, threads)
    configured = configure(_task_of("record", agent, task, config), **config)
    core = agent_of(agent, configured, seed)._core
    with in_words_of_python():
        flights = _skein.record(core, configured, count, seed, threads, observations)
    return pandas.read_csv(io.StringIO(flights))

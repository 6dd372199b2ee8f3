# SPDX-License-Identifier: Apache-2.0
"""Training, and what trainings leave: run directories."""
from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from skein import _skein
from skein._skein import Config, ConfigurationError, Error
from skein.agents import Agent, load_policy
from skein.checks import MOST_THREADS, reason_of, text, truth_value, whole_number
from skein.configuration import Task, configure
from skein.messages import in_words_of_python

if TYPE_CHECKING:
    import pandas

Callback = Callable[[dict[str, Any]], Optional[bool]]


class Run:
    """The directory of a training run (docs/reference/file-formats.md)."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """
        Raises:
            Error: the directory holds no run.
        """
        # A later change of the working directory does not lose it.
        self.path = pathlib.Path(text("path", path)).absolute()
        if not (self.path / "config.toml").is_file():
            raise Error(f"{self.path}: not the directory of a run (there is no config.toml in it)")

    @property
    def config(self) -> Config:
        """What was trained."""
        return _skein.read_record(str(self.path / "config.toml"))

    @property
    def metrics(self) -> pandas.DataFrame:
        """metrics.csv: a row for every iteration (columns and units: docs/reference/file-formats.md). An Error before
        the training begins."""
        return self._table("metrics.csv")

    @property
    def timing(self) -> pandas.DataFrame:
        """timing.csv: the seconds of each iteration. An Error before the training begins."""
        return self._table("timing.csv")

    @property
    def evaluation(self) -> dict[str, Any] | None:
        """The evaluation at the end of the training; None before."""
        file = self.path / "evaluation.json"
        if not file.is_file():
            return None
        try:
            document: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except ValueError as error:
            raise Error(f"{file}: not valid JSON (damaged){reason_of(error)}") from error
        return document

    @property
    def policy(self) -> Agent:
        """The best policy, else the final one, else that of the newest checkpoint."""
        return load_policy(self.path)

    def resume(
        self,
        *,
        callback: Callable[[dict[str, Any]], bool | None] | None = None,
        threads: int = 0,
        progress: bool = True,
    ) -> Run:
        """Trains on from the newest checkpoint to the end of the budget, to the same bits as without the stop;
        arguments as of skein.train. A run that has been trained to its end is evaluated again, to the same figures.

        Raises:
            Error: the newest checkpoint is damaged, or the run has been trained to its end and has none any more.
            KeyboardInterrupt: as of skein.train.
        """
        asked = _asked(callback)
        whole_number("threads", threads, 0, MOST_THREADS)
        with in_words_of_python():
            _skein.resume(str(self.path), threads, truth_value("progress", progress), asked)
        return self

    def _table(self, name: str) -> pandas.DataFrame:
        import pandas

        try:
            return pandas.read_csv(self.path / name)
        except (FileNotFoundError, pandas.errors.EmptyDataError) as error:
            raise Error(f"{self.path}: there is no {name} in it yet: no iteration has been recorded") from error
        except ValueError as error:
            raise Error(f"{self.path / name}: not a valid table (damaged){reason_of(error)}") from error

    def __repr__(self) -> str:
        return f"<skein.Run {self.path}>"


def train(
    task: Task,
    out: str | os.PathLike[str],
    *,
    callback: Callable[[dict[str, Any]], bool | None] | None = None,
    start_from: str | os.PathLike[str] = "",
    low_level: str | os.PathLike[str] = "",
    threads: int = 0,
    progress: bool = True,
    **config: Any,
) -> Run:
    """Trains a policy, then evaluates it, as `skein train` does: the same bits for the same configuration. The page
    and what the training took (report.html, summary.json) are left to `skein report`.

        run = skein.train("heading", "runs/short", **{"run.total_steps": 5_000_000})
        run.metrics.plot("env_steps", "success_rate")  # needs the extra analysis

    Args:
        task, config: what is trained and how (skein.configure).
        out: directory of the run, which must not hold one already.
        callback: is given every iteration's figures (those of metrics.csv; None where a cell there would be empty,
            such as the success rate before an episode has ended); False ends the run, saved, so that Run.resume goes
            on. What it raises does the same, and comes through.
        start_from: a run or policy whose networks it starts from.
        low_level: as of skein.make_vec.
        threads: 0: one for each CPU it may use. Results do not depend on it.
        progress: print it, and the result, on the process's standard output, as the program does, past sys.stdout;
            False: nothing. The run's log.txt has all of it.

    Raises:
        Error: the configuration cannot be trained, or the directory cannot be made.
        KeyboardInterrupt: Ctrl-C. The iteration under way is dropped; those before it are saved.
    """
    configured = configure(task, **config)
    asked = _asked(callback)
    whole_number("threads", threads, 0, MOST_THREADS)
    if not (directory := text("out", out)):
        raise ConfigurationError("out must name the directory of the run, and is empty")
    start, below = text("start_from", start_from), text("low_level", low_level)
    with in_words_of_python():
        _skein.train(configured, directory, start, below, threads, truth_value("progress", progress), asked)
    return Run(out)


def _asked(callback: Callback | None) -> Callback | None:
    """The callback as the extension asks it, to which NumPy's false is no False."""
    if callback is None:
        return None
    if not callable(callback):
        raise ConfigurationError(f"callback must be a function, not {type(callback).__name__}")

    def goes_on(row: dict[str, Any]) -> bool:
        returned = callback(row)
        return bool(returned) if isinstance(returned, (bool, np.bool_)) else True

    return goes_on

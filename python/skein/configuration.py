# SPDX-License-Identifier: Apache-2.0
"""What is flown: presets, conditions and settings."""
from __future__ import annotations

import copyreg
import json
import os
import pathlib
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Union

from skein import _skein
from skein._skein import Config, ConfigurationError
from skein.checks import UnknownArgument, shown, text
from skein.messages import in_words_of_python

Task = Union[str, os.PathLike[str], Config]
"""What is flown: "heading", "control" or "tracking"; the path of a task file; or a Config, which has a preset, files
and settings behind it."""

_MOST_TABLES = 8  # in one another; no key is in as many
_ARGUMENTS = ("preset", "file", "aircraft", "conditions")
_NEAR = 0.8  # of difflib's ratio: "condition" is near to "conditions"
_ARGUMENTS_OF_OTHERS = ("agent", "evaluation", "low_level", "num_envs", "reward", "terminated", "threads")


def configure(
    task: Task,
    *,
    preset: str = "default",
    file: str | os.PathLike[str] = "",
    aircraft: str | os.PathLike[str] = "",
    conditions: Sequence[str] | Mapping[str, str | float] = (),
    **settings: Any,
) -> Config:
    """A configuration: defaults, then preset, file, conditions and settings, each on top of those before it.

    Args:
        task: "heading", "control" or "tracking", or the path of a task file, "my_task.toml"; or a Config, which then
            stands for the preset.
        preset: the task's named configuration (skein.presets).
        file: a TOML file.
        aircraft: what is flown: one of skein.AIRCRAFT or the path of an aircraft file, as env.aircraft.
        conditions: as of `skein train --condition`: ["windy=0..60fps", "noisy=0.03"], or the same as a dict,
            {"windy": "0..60fps", "noisy": 0.03}.
        settings: configuration keys (docs/reference/configuration.md), as the program has them
            (**{"env.heading.dwell_s": 1}), nested (env={"heading": {"dwell_s": 1}}), or both.

    Raises:
        ConfigurationError: an unknown task, preset or key (with the nearest known one), a value out of range.
    """
    if isinstance(conditions, Mapping):
        conditions = [f"{name}={level}" for name, level in conditions.items()]
    if not isinstance(conditions, (list, tuple)):
        raise ConfigurationError(f"conditions must be a list of texts or a dict, not {type(conditions).__name__}")
    conditions = [text("conditions", condition) for condition in conditions]
    _refuse_arguments(settings)
    assignments = [f"{key}={_toml(key, value)}" for key, value in _flattened("", settings)]
    if text("aircraft", aircraft):
        assignments.insert(0, f"env.aircraft={_quoted(os.fspath(aircraft))}")
    if isinstance(task, Config):
        if preset != "default":
            raise ConfigurationError("preset is for the name of a task: a Config has one behind it")
        with in_words_of_python():
            return task.with_settings(text("file", file), conditions, assignments)
    with in_words_of_python():
        return _skein.resolve(text("task", task), text("preset", preset), text("file", file), conditions, assignments)


def presets(task: str) -> list[str]:
    """Names of the task's presets; a task file has none.

    Raises:
        ConfigurationError: an unknown task.
    """
    return _skein.presets_of(text("task", task))


def _refuse_arguments(settings: Mapping[str, Any]) -> None:
    """Names an argument that is misspelt, or that the caller does not take, for what it is: no key is one."""
    for name, value in settings.items():
        if "." in name or isinstance(value, Mapping):
            continue
        if near := get_close_matches(name, _ARGUMENTS, 1, _NEAR):
            raise UnknownArgument(f"there is no argument {name}; did you mean {near[0]}?")
        if name == "seed":
            raise UnknownArgument("seed is no setting: reset takes an environment's; run.seed is that of a training")
        if name == "max_episode_steps":
            raise UnknownArgument(
                "max_episode_steps is no setting: env.time_limit_steps is that of an episode, in control steps; with "
                "env.truncate_at_time_limit=True it truncates"
            )
        if name in _ARGUMENTS_OF_OTHERS:
            raise UnknownArgument(f"{name} is neither an argument of this function nor a setting")


def _flattened(prefix: str, settings: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    if prefix.count(".") > _MOST_TABLES:
        raise ConfigurationError(f"settings: {prefix[:60]}... is in more than {_MOST_TABLES} tables")
    for name, value in settings.items():
        if not isinstance(name, str):
            raise ConfigurationError(f"settings: a key must be a text, not {shown(name)}")
        if isinstance(value, Mapping):
            yield from _flattened(f"{prefix}{name}.", value)
        else:
            yield prefix + name, value


def _toml(key: str, value: Any) -> str:
    """The value as TOML writes it."""
    if hasattr(value, "item") and getattr(value, "size", 0) == 1:  # a scalar of NumPy
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _quoted(text(key, value))
    raise ConfigurationError(f"settings: {key} must be a number, a text, or true or false, not {type(value).__name__}")


def _quoted(value: str) -> str:
    # TOML has no pairs of surrogates, and wants DEL escaped, which JSON leaves as it is.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _recalled(files: dict[str, str], is_final: bool) -> Config:
    """The configuration that the files of a run's directory record."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            pathlib.Path(folder, name).write_text(content, encoding="utf-8")
        return _skein.read_record(os.path.join(folder, "config.toml"), is_final)


Mapping.register(Config)
# Pickled, and copied, as a run records it: whole, with the task file and the aircraft of a user's.
copyreg.pickle(Config, lambda config: (_recalled, _skein.record_of(config)))

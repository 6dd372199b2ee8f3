# SPDX-License-Identifier: Apache-2.0
"""Arguments as the extension takes them; what cannot be one is a ConfigurationError of one line that names it."""
from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skein._skein import ConfigurationError
from skein.messages import words_of_python

MOST_SEED = 2**64 - 1
MOST_ENVIRONMENTS = 2**24
MOST_EPISODES = 2**31 - 1
MOST_THREADS = 1024
MOST_SIZE = 2**16
MOST_TEXT = 1024
MOST_STEPS = 10**8
MOST_POLICY_STEP = 2**32 - 1

# What NumPy raises of rows of different lengths, and of tensors that it cannot read where they are.
NO_ARRAY = (TypeError, ValueError, RuntimeError, BufferError, AttributeError)


class UnknownName(ConfigurationError, KeyError):
    """Something was asked for by a name that it does not have."""

    def __str__(self) -> str:
        return words_of_python(str(self.args[0]))  # and not in quotes, as of a KeyError


class UnknownArgument(ConfigurationError, TypeError):
    """An argument that a function does not take. Gymnasium's users expect a TypeError: make_vec_env of
    Stable-Baselines3 asks for a render mode, and then, on a TypeError, for none."""


def shown(value: Any) -> str:
    """The value for a message: on one line, and short."""
    return " ".join(repr(value).split())[:60]


def reason_of(error: Exception) -> str:
    """What another library says of its error, such as how to detach a tensor, for the end of a message."""
    said = " ".join(str(error).split())[:160]
    return f": {said}" if said else ""


def whole_number(name: str, value: Any, least: int, most: int) -> int:
    """`value` in [least, most]."""
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool) and least <= value <= most:
        return int(value)
    raise ConfigurationError(f"{name} must be a whole number from {least} to {most}, not {shown(value)}")


def truth_value(name: str, value: Any) -> bool:
    """True or False, NumPy's too."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise ConfigurationError(f"{name} must be True or False, not {shown(value)}")


def number(name: str, value: Any) -> float:
    """A finite number."""
    try:
        if np.isfinite(real := float(value)):
            return real
    except (TypeError, ValueError, OverflowError):
        pass
    raise ConfigurationError(f"{name} must be a finite number, not {shown(value)}")


def text(name: str, value: Any) -> str:
    """A text or path of one line, that UTF-8 can write."""
    if isinstance(value, (str, os.PathLike)) and isinstance(path := os.fspath(value), str):
        is_unicode = not any("\ud800" <= character <= "\udfff" for character in path[:MOST_TEXT])
        if len(path) <= MOST_TEXT and is_unicode and not set(path) & set("\0\n\r"):
            return path
    raise ConfigurationError(
        f"{name} must be a text or path of one line, up to {MOST_TEXT} characters, not {shown(value)}"
    )


def _converted(array: NDArray[Any], dtype: Any) -> NDArray[Any]:
    """In C order. Finite numbers beyond those of `dtype` are the largest that it has."""
    with np.errstate(over="ignore"):
        converted = np.ascontiguousarray(array, dtype)
    if np.issubdtype(dtype, np.floating) and not (is_finite := np.isfinite(converted)).all():
        largest = np.copysign(np.finfo(dtype).max, array)
        converted = np.ascontiguousarray(np.where(~is_finite & np.isfinite(array), largest, converted), dtype)
    return converted


def rows(name: str, value: Any, shape: tuple[int | None, ...], dtype: Any = np.float32) -> NDArray[Any]:
    """An array of real numbers, in place where type and layout fit; None in `shape` is any number."""
    if isinstance(value, np.ndarray) and value.dtype == dtype and value.shape == shape and value.flags.c_contiguous:
        return value  # without delay: it is asked at every step
    try:
        array = _array(value)
        if array.dtype.kind not in ("iu" if np.issubdtype(dtype, np.integer) else "fiu"):
            raise TypeError
        converted = _converted(array, dtype)
    except NO_ARRAY as error:
        reason = reason_of(error)
        raise ConfigurationError(f"{name} must be an array of numbers, not {_described(value)}{reason}") from error
    if array.ndim != len(shape) or any(asked not in (None, size) for asked, size in zip(shape, array.shape)):
        wanted = ", ".join("n" if size is None else str(size) for size in shape) + ("," if len(shape) == 1 else "")
        raise ConfigurationError(f"{name} must have the shape ({wanted}), not {array.shape}")
    return converted


def flags(name: str, value: Any, count: int) -> NDArray[np.bool_]:
    """Truth values, one for each of `count`."""
    array = value if isinstance(value, np.ndarray) else None
    if isinstance(value, (list, tuple)) and all(isinstance(flag, (bool, np.bool_)) for flag in value):
        array = np.array(value, bool)
    if array is not None and array.dtype == bool and array.shape == (count,):
        return np.ascontiguousarray(array)
    raise ConfigurationError(f"{name} must be {count} truth values, not {shown(value)}")


def is_vector(value: Any) -> bool:
    """Whether it has one dimension."""
    try:
        return _array(value).ndim == 1
    except NO_ARRAY:
        return False


def _array(value: Any) -> NDArray[Any]:
    """What NumPy makes of it. By itself it does not ask for DLPack."""
    speaks_dlpack_alone = hasattr(value, "__dlpack__") and not hasattr(value, "__array__")
    return np.from_dlpack(value) if speaks_dlpack_alone else np.asarray(value)


def _described(value: Any) -> str:
    kind = type(value).__name__
    return f"{kind} of {value.dtype}" if hasattr(value, "dtype") else kind

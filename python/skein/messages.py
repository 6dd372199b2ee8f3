# SPDX-License-Identifier: Apache-2.0
"""Messages of the program, which name its options, in words of Python, which name arguments."""
from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from skein._skein import Error

_SENTENCES = (
    ("`skein train --help-keys` lists all keys", "skein.configure(TASK).settings() has all keys"),
    ("and --config others", "and a file others"),
    ("by --config or", "by settings, a file or"),
    ("skein eval --other-aircraft and the agent policy:FILE@other-aircraft allow", "policy:FILE@other-aircraft allows"),
)
_RESUME = re.compile(r"continue it with --resume (.*), or choose")
_ARGUMENTS = {
    "aircraft": "aircraft",
    "condition": "conditions",
    "low-level": "low_level",
    "out": "out",
    "preset": "preset",
}
_OPTION = re.compile(rf"(?<![^\s(])--({'|'.join(_ARGUMENTS)})(?=[\s:,;.)]|$)")


def words_of_python(message: str) -> str:
    """The message with arguments in the place of options: --low-level is low_level."""
    for old, new in _SENTENCES:
        message = message.replace(old, new)
    message = _RESUME.sub(lambda run: f"continue it with skein.Run({run[1]!r}).resume(), or choose", message)
    return _OPTION.sub(lambda option: _ARGUMENTS[option[1]], message)


@contextmanager
def in_words_of_python() -> Iterator[None]:
    """What the extension refuses in here is refused in words of Python."""
    try:
        yield
    except Error as error:
        error.args = tuple(words_of_python(said) if isinstance(said, str) else said for said in error.args)
        raise

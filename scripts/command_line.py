# SPDX-License-Identifier: Apache-2.0
"""What the command lines of scripts share."""
import argparse
import math
import os
import signal
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))


class Parser(argparse.ArgumentParser):
    """Of a script, whose documentation it prints as help. It says in one line what is wrong with arguments."""

    def __init__(self, documentation):
        super().__init__(prog=f"scripts/{os.path.basename(sys.argv[0])}", description=documentation,
                         formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def fail(message, code=1):
    """Ends the script with a line that says why."""
    print(f"scripts/{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(code)


def bounded(kind, least, most=math.inf):
    """The type of an argument that is a number in [least, most]: of an int or a finite float, which `kind` says."""
    def parse(text):
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not -math.inf < value < math.inf:
            raise argparse.ArgumentTypeError(f"{text} is no {'whole number' if kind is int else 'number'}")
        if not least <= value <= most:
            bounds = f"less than {least}" if most == math.inf else f"not from {least} to {most}"
            raise argparse.ArgumentTypeError(f"{text} is {bounds}")
        return value
    return parse


def existing_program(path):
    """The type of an argument that names a program; its absolute path, as a mere name would be looked for in PATH."""
    if not (os.path.isfile(path) and os.access(path, os.X_OK)):
        raise argparse.ArgumentTypeError(f"{path}: no such program")
    return os.path.abspath(path)


def writable_file(path):
    """The type of an argument that names what is written at the end: what cannot be is said before the work."""
    is_new = not os.path.lexists(path)
    try:
        with open(path, "a", encoding="utf-8"):
            pass
        if is_new:
            os.unlink(path)
    except OSError as error:
        raise argparse.ArgumentTypeError(f"{path}: {error.strerror}") from error
    return path


def release_program(target, place):
    """The program that scripts/build makes of `target`, at `place` in build/release, after it was made."""
    if subprocess.run([os.path.join(ROOT, "scripts/build"), "release", target]).returncode != 0:
        sys.exit(1)  # it has said why
    return os.path.join(ROOT, "build/release", place)


def heed_signals():
    """From now on SIGTERM and SIGHUP are a KeyboardInterrupt, too, so that a script leaves nothing behind. Those that
    were ignored before, as by nohup, stay so; after the first, others do not disturb the clearing up."""
    def interrupt(number, _):
        for other in heeded:
            signal.signal(other, signal.SIG_IGN)
        raise KeyboardInterrupt(number)

    heeded = [number for number in (signal.SIGTERM, signal.SIGHUP) if signal.getsignal(number) != signal.SIG_IGN]
    for number in heeded:
        signal.signal(number, interrupt)


def exit_code_of(interrupt):
    """Of a script that a KeyboardInterrupt ends: 128 and the signal's number."""
    return 128 + (interrupt.args[0] if interrupt.args else signal.SIGINT)

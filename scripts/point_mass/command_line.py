# SPDX-License-Identifier: Apache-2.0
"""What the command lines of scripts about point masses share."""
import argparse
import os
import subprocess
import sys

from command_line import existing_program
from jsbsim_flight.intervals import mean_and_interval

from .forces import ROOT


def fail(message, code=1):
    print(f"scripts/{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(code)


def whole(lowest, highest):
    def parse(text):
        value = int(text)
        if not lowest <= value <= highest:
            raise argparse.ArgumentTypeError(f"{value} is not from {lowest} to {highest}")
        return value
    parse.__name__ = "whole number"  # argparse names it in its message
    return parse


def add_episodes(parser):
    parser.add_argument("--episodes", type=whole(1, 1000), default=1000, help="number of episodes (default: 1000)")
    parser.add_argument("--seed", type=whole(0, 2**53 - 1), default=1000, help="of the episodes (default: 1000)")
    parser.add_argument("--skein", type=existing_program, metavar="FILE",
                        help="the program (default: a release build, made first)")


def program_of(options):
    if options.skein:
        return options.skein
    if subprocess.run([os.path.join(ROOT, "scripts/build"), "release", "skein"]).returncode != 0:
        sys.exit(1)
    return os.path.join(ROOT, "build/release/src/skein")


def mean_text(values, digits=2):
    """The mean with its 95 % interval; - of nothing."""
    if not values:
        return "-"
    estimate = mean_and_interval(values)
    half = estimate["half_width"]
    return f"{estimate['mean']:.{digits}f}" + ("" if half is None else f" +- {half:.{digits}f}")

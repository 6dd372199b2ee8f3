# SPDX-License-Identifier: Apache-2.0
"""What the command lines of scripts about point masses share."""
import argparse

from command_line import bounded, existing_program, release_program
from intervals import mean_and_interval


def add_episodes(parser):
    parser.add_argument("--episodes", type=bounded(int, 1, 1000), default=1000, help="number of episodes (default: 1000)")
    parser.add_argument("--seed", type=bounded(int, 0, 2**53 - 1), default=1000, help="of the episodes (default: 1000)")
    parser.add_argument("--skein", type=existing_program, metavar="FILE",
                        help="the program (default: a release build, made first)")


def point_mass_condition(text):
    """The type of a condition that changes nothing of a point mass but where it flies."""
    if text.split("=")[0] not in ("high_speed", "high_altitude"):
        raise argparse.ArgumentTypeError(f"{text} is no level of high_speed or high_altitude")
    return text


def add_conditions(parser, kind):
    parser.add_argument("--condition", type=kind, action="append", default=[], metavar="NAME=LEVEL",
                        help="as of skein compare; may be repeated")


def atmosphere_of(conditions):
    """The air that skein flies in under them."""
    return "standard_1976" if any(text.startswith("high_altitude=") for text in conditions) else "stevens_lewis"


def program_of(options):
    return options.skein or release_program("skein", "src/skein")


def mean_text(values, digits=2):
    """The mean with its 95 % interval; - of nothing."""
    if not values:
        return "-"
    estimate = mean_and_interval(values)
    half = estimate["half_width"]
    return f"{estimate['mean']:.{digits}f}" + ("" if half is None else f" +- {half:.{digits}f}")

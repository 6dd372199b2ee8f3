#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What would a policy gain by a manoeuvre that it does not fly? A policy for Heading flies to targets that ask for less
airspeed and hardly a turn. In the first seconds of each flight its commands are replaced: throttle idle, a roll, a
pull. From there on it flies itself. Prints the mean time to the target by how much airspeed there is to lose, for turns
of several lengths.

  examples/python/forced_turn.py [POLICY] [--flights N] [--seed N]
"""
import argparse
import os
import sys

import numpy as np

try:
    import skein
except ImportError as error:
    sys.exit(f"{sys.argv[0]}: {error}; install the package: pip install .")

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..")
TURNS_S = (0, 0.5, 1, 1.5, 2, 3, 4, 5)
TO_LOSE_FPS = ((60, 120), (120, 180), (180, 240), (240, 300))
LONGEST_S = 55  # of an episode, its dwell included
DWELL_S = 3
SETTINGS = {"env.heading.dwell_s": DWELL_S, "env.hold_s": 0, "env.heading.yaw_change_rad": 0.05,
            "env.heading.altitude_change_ft": 300}
ROLL_S, PULL_AFTER_S, STICK = 0.6, 0.4, 0.9  # from level to a bank of 80 deg, and pulled from its middle on
THROTTLE, PITCH, ROLL = range(3)


def command_a_turn(actions, time_s):
    actions[:, THROTTLE] = -1
    actions[:, PITCH] = STICK if time_s >= PULL_AFTER_S else 0
    actions[:, ROLL] = STICK if time_s < ROLL_S else 0


def fly(policy, flights, seed, turn_s):
    """The airspeed to lose, ft/s, and the time to the target of each flight, s; not a number where it was missed."""
    envs = skein.make_vec("heading", flights, agent=policy, evaluation=True, **SETTINGS)
    observations, _ = envs.reset(seed=seed)
    to_lose = -observations[:, 2] * 340 / 0.3048  # observation 2 is in units of 340 m/s
    times = np.full(flights, np.nan)
    flying = np.ones(flights, bool)
    state = policy.initial_state(flights)
    reached = skein.TERMINATION_NAMES.index("target_reached")
    for step in range(round(LONGEST_S / envs.policy_step_s)):
        actions, state = policy.act(observations, state)
        actions = np.array(actions)
        if step * envs.policy_step_s < turn_s:
            command_a_turn(actions, step * envs.policy_step_s)
        observations, _, terminated, truncated, info = envs.step(actions)
        ended = flying & (terminated | truncated)
        hit = ended & (info["termination"] == reached)
        times[hit] = (step + 1) * envs.policy_step_s - DWELL_S
        flying &= ~ended
        if not flying.any():
            break
    return to_lose, times


def mean_text(times):
    reached = times[~np.isnan(times)]
    return f"{reached.mean():>10.2f} s" if reached.size else f"{'-':>10}  "


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("policy", nargs="?", default=os.path.join(ROOT, "policies", "heading.skein"),
                        help="policy for Heading (default: policies/heading.skein)")
    parser.add_argument("--flights", type=int, default=1500, help="for each turn (default: 1500)")
    parser.add_argument("--seed", type=int, default=5, help="of the flights (default: 5)")
    return parser.parse_args()


def main():
    options = parse_arguments()
    try:
        policy = skein.load_policy(options.policy)
        if policy.task != "heading":
            sys.exit(f"{sys.argv[0]}: {options.policy} is a policy for {policy.task}, not for heading")
        print("to lose, ft/s    " + "".join(f"{low:>6} to {high}" for low, high in TO_LOSE_FPS))
        for turn_s in TURNS_S:
            to_lose, times = fly(policy, options.flights, options.seed, turn_s)
            groups = [times[(low < to_lose) & (to_lose < high)] for low, high in TO_LOSE_FPS]
            print(f"{turn_s:>4} s of a turn  " + "".join(map(mean_text, groups)), flush=True)
    except skein.Error as error:
        sys.exit(f"{sys.argv[0]}: {error}")


if __name__ == "__main__":
    main()

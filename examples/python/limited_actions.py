#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What is a policy's lead worth without its hardest pulls? Flies a policy as it is, the same with its actions limited,
and the autopilot, over the same episodes, and prints how they compare: nothing is trained again.

  examples/python/limited_actions.py [POLICY] [--pull 0.85,0.69] [--throttle FROM] [--condition NAME=LEVEL]
                                     [--episodes N] [--seed N]
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
THROTTLE, PITCH = range(2)


class LimitedActions:
    """A policy whose pitch action, positive in a pull, is at most `pull`, and its throttle action at least `throttle`."""

    def __init__(self, policy, pull=1.0, throttle=-1.0):
        self.policy, self.pull, self.throttle = policy, pull, throttle
        self.state_size = policy.state_size
        self.action_repeat = policy.action_repeat

    def __call__(self, observations, state):
        actions, state = self.policy.act(observations, state)
        actions = np.array(actions)
        actions[:, PITCH] = np.minimum(actions[:, PITCH], self.pull)
        actions[:, THROTTLE] = np.maximum(actions[:, THROTTLE], self.throttle)
        return actions, state


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("policy", nargs="?", default=os.path.join(ROOT, "policies", "heading.skein"),
                        help="policy file or run (default: policies/heading.skein)")
    parser.add_argument("--pull", default="", help="largest pitch actions, separated by commas (0.69: 6.5 g)")
    parser.add_argument("--throttle", type=float, help="least throttle action (1: full)")
    parser.add_argument("--condition", action="append", default=[], help="as of skein compare; may be repeated")
    parser.add_argument("--episodes", type=int, default=300, help="number of them (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1000, help="of the episodes (default: %(default)s)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    policy = skein.load_policy(arguments.policy)
    if policy.is_high_level:
        sys.exit(f"{sys.argv[0]}: {arguments.policy}: a high-level policy, which moves neither throttle nor stick")
    agents = {"as it is": policy}
    for pull in filter(None, arguments.pull.split(",")):
        agents[f"pulls to {pull}"] = LimitedActions(policy, pull=float(pull))
    if arguments.throttle is not None:
        agents[f"throttle from {arguments.throttle:g}"] = LimitedActions(policy, throttle=arguments.throttle)
    agents["autopilot"] = "autopilot"
    settings = {} if policy.task == "tracking" else {f"env.{policy.task}.dwell_s": 3, "env.hold_s": 30}
    print(skein.compare(agents, policy.task, episodes=arguments.episodes, seed=arguments.seed,
                        conditions=arguments.condition, **settings))


if __name__ == "__main__":
    try:
        main()
    except (skein.Error, ValueError) as error:
        sys.exit(f"{sys.argv[0]}: {error}")

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Steps one F-16 of JSBSim through its Python package, and one of jsbgym's environments: for every line of the standard
input one line of JSON with the microseconds that a simulated second takes of either, by the median of their steps.
What scripts/peers and scripts/compare_python compare with, in an environment of theirs.

  scripts/peer_work/jsbsim_steps.py SECONDS      (to be flown of each; needs pip install jsbsim jsbgym)
"""
import os
import statistics
import sys
import time

import gymnasium
import jsbgym  # noqa: F401, registers its environments
import jsbsim
import numpy as np

from serving import serve

DT = 0.02  # s
ALTITUDE_FT, SPEED_FPS = 15000, 700
COMMANDS = ["fcs/throttle-cmd-norm", "fcs/elevator-cmd-norm", "fcs/aileron-cmd-norm", "fcs/rudder-cmd-norm"]
SEEN = ["position/h-sl-ft", "attitude/phi-rad", "attitude/theta-rad", "attitude/psi-rad", "velocities/u-fps",
        "velocities/v-fps", "velocities/w-fps", "velocities/p-rad_sec", "velocities/q-rad_sec", "velocities/r-rad_sec",
        "velocities/vt-fps", "aero/alpha-rad", "aero/beta-rad"]
GYM = "F16-HeadingControlTask-Shaping.STANDARD-NoFG-v0"
GYM_STEP_S = 0.2  # 12 steps of JSBSim at 60 Hz


def jsbsim_us(seconds):
    """Control steps as an environment would take them: four commands written, thirteen quantities read."""
    fdm = jsbsim.FGFDMExec(None)
    fdm.set_debug_level(0)
    fdm.load_model("f16")
    fdm.disable_output()
    fdm.set_dt(DT)
    for name, value in [("ic/h-sl-ft", ALTITUDE_FT), ("ic/vt-fps", SPEED_FPS), ("propulsion/set-running", -1)]:
        fdm[name] = value
    fdm.run_ic()
    spent = []
    for _ in range(round(seconds / DT)):
        start = time.perf_counter()
        for name, value in zip(COMMANDS, (0.5, 0, 0, 0)):
            fdm[name] = value
        fdm.run()
        np.array([fdm[name] for name in SEEN])
        spent.append(time.perf_counter() - start)
    return statistics.median(spent) / DT * 1e6


def gym_us(seconds):
    env = gymnasium.make(GYM).unwrapped
    env.reset(seed=0)
    action = np.zeros(env.action_space.shape)
    spent = []
    for _ in range(round(seconds / GYM_STEP_S)):
        start = time.perf_counter()
        *_, terminated, truncated, _ = env.step(action)
        spent.append(time.perf_counter() - start)
        if terminated or truncated:  # beginning anew loads files: not counted
            env.reset()
    return statistics.median(spent) / GYM_STEP_S * 1e6


def main():
    seconds = float(sys.argv[1])
    shown = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # JSBSim writes banners
    serve({"jsbsim_version": jsbsim.__version__, "jsbgym": GYM, "control_step_s": DT, "policy_step_s": GYM_STEP_S},
          lambda: {"jsbsim_us": jsbsim_us(seconds), "jsbgym_us": gym_us(seconds)}, shown)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""How scripts/fly_jsbsim drives JSBSim's F-16. Skipped where there is no build/jsbsim with the package jsbsim."""
import importlib.util
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..")
if importlib.util.find_spec("jsbsim") is None:
    installed = os.path.join(ROOT, "build", "jsbsim", "bin", "python")
    if not os.access(installed, os.X_OK):
        print("skipped: no jsbsim")
        sys.exit()
    os.execv(installed, [installed, "-I", __file__])
sys.path.insert(0, os.path.join(ROOT, "scripts"))

from jsbsim_flight.policy import Policy, act  # noqa: E402
from jsbsim_flight.task import DT, Heading  # noqa: E402
from jsbsim_flight.vehicle import CONTROLS, lever_for_power, power_command  # noqa: E402

POLICY = os.path.join(ROOT, "policies", "heading.skein")
ROUNDING = 1e-6  # of float64 where a policy's numbers are float32
CRUISE = 0.55  # throttle near level flight
ALTITUDE_FT, SPEED_FPS = 20000, 1000


def flown(control, seconds, throttle=CRUISE, pitch=0.0, roll=0.0, yaw=0.0):
    """The vehicle, and its states after every control step with these commands."""
    vehicle, states = CONTROLS[control](ALTITUDE_FT, SPEED_FPS), []
    for _ in range(round(seconds / DT)):
        vehicle.step(throttle, pitch, roll, yaw)
        states.append(vehicle.state())
    return vehicle, states


class Vehicles(unittest.TestCase):
    def test_flights_begin_trimmed(self):
        for control in CONTROLS:
            state = CONTROLS[control](ALTITUDE_FT, SPEED_FPS).state()
            self.assertAlmostEqual(state.altitude, ALTITUDE_FT, delta=1)
            self.assertAlmostEqual(state.airspeed, SPEED_FPS, delta=0.1)
            self.assertAlmostEqual(state.nz, 1, delta=0.01)
            for angle in (state.roll, math.remainder(state.yaw, 2 * math.pi), state.beta, state.p, state.q, state.r):
                self.assertAlmostEqual(angle, 0, delta=1e-6)

    def test_centred_stick_commands_keep_flying_level(self):
        for control in CONTROLS:
            _, states = flown(control, 10)
            self.assertLess(max(abs(state.altitude - ALTITUDE_FT) for state in states), 50, control)
            self.assertLess(max(abs(state.nz - 1) for state in states), 0.1, control)

    def test_stick_commands_have_skeins_signs(self):
        for control in CONTROLS:
            self.assertGreater(max(state.nz for state in flown(control, 2, pitch=0.5)[1]), 3, control)
            self.assertLess(min(state.nz for state in flown(control, 2, pitch=-0.5)[1]), 0, control)
            self.assertGreater(flown(control, 1, roll=0.3)[1][-1].p, math.radians(30), control)
            self.assertLess(flown(control, 1, yaw=1)[1][-1].beta, math.radians(-0.3), control)
            self.assertGreater(flown(control, 0.2, yaw=1)[1][-1].r, 0, control)

    def test_surfaces_have_skeins_signs(self):
        for control in CONTROLS:
            self.assertLess(flown(control, 0.2, pitch=1)[1][-1].surfaces.elevator, -2, control)
            self.assertLess(flown(control, 0.2, roll=1)[1][-1].surfaces.aileron, -5, control)
            self.assertLess(flown(control, 0.2, yaw=1)[1][-1].surfaces.rudder, -0.2, control)

    def test_jsbsims_own_stick_is_worth_what_the_page_says(self):
        _, states = flown("own", 3, throttle=0.9, pitch=1)
        self.assertAlmostEqual(max(state.nz for state in states), 5.9, delta=0.1)
        _, states = flown("own", 2, throttle=0.7, roll=1)
        self.assertAlmostEqual(math.degrees(max(state.p for state in states)), 182, delta=2)

    def test_thrust_settles_at_the_share_that_the_power_means(self):
        for throttle in (0.2, 0.5, 0.77, 0.9, 1.0):
            vehicle, states = flown("skein", 5, throttle=throttle)
            self.assertAlmostEqual(states[-1].power, power_command(throttle), delta=0.1)
            get = vehicle.fdm.get_property_value
            idle, full = 17800 * get("propulsion/engine/IdleThrust"), 29000 * get("propulsion/engine/AugThrust")
            dry = idle + (17800 - idle) * get("propulsion/engine/MilThrust")
            power = states[-1].power
            share = idle + (dry - idle) * power / 50 if power < 50 else dry + (full - dry) * (power - 50) / 50
            self.assertAlmostEqual(get("propulsion/engine/thrust-lbs"), share, delta=0.01 * abs(full))

    def test_the_lever_is_monotonic_and_full_at_full_power(self):
        levers = [lever_for_power(power_command(k / 100)) for k in range(101)]
        self.assertEqual(levers, sorted(levers))
        self.assertEqual((levers[0], levers[-1]), (0, 1))


class Policies(unittest.TestCase):
    def test_actions_are_those_of_scripts_act(self):
        mine, plain = Policy(POLICY), act.Policy(POLICY)
        state = CONTROLS["own"](ALTITUDE_FT, SPEED_FPS).state()
        observation = Heading(state, lambda reach: reach).observe(state)
        for _ in range(2):
            mine.begin()
            plain.state = [0.0] * len(plain.state)
            for _ in range(3):
                for a, b in zip(mine.act(observation), plain.act(observation)):
                    self.assertAlmostEqual(a, b, delta=ROUNDING)


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_program(self, *arguments):
        command = [sys.executable, "-I", os.path.join(ROOT, "scripts", "fly_jsbsim"), *arguments]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)

    def report(self, *arguments):
        path = os.path.join(self.folder.name, "flights.json")
        done = self.run_program("--policy", POLICY, "--noise=0.01", "--dwell=0", "--hold=1", "--json", path, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(path, encoding="utf-8") as file:
            return json.load(file)

    def test_flights_depend_on_the_seed_and_their_number_alone(self):
        report = self.report("--episodes=3", "--processes=1")
        flights = report["flights"]
        self.assertEqual(set(report["machine"]), {"commit", "cpu", "python"})
        self.assertEqual(self.report("--episodes=2", "--processes=2")["flights"], flights[:2])
        self.assertNotEqual(self.report("--episodes=1", "--seed=1")["flights"], flights[:1])
        self.assertEqual(len({tuple(flight["target"]) for flight in flights}), 3)

    def test_what_is_no_policy_for_it_is_refused_in_one_line(self):
        path = os.path.join(self.folder.name, "text.skein")
        with open(path, "w", encoding="utf-8") as file:
            file.write("no policy, but long enough to have a header")
        for name, message in (("nowhere.skein", "No such file"), (path, "not a policy file"),
                              (os.path.join(ROOT, "policies", "tracking.skein"), "a policy for tracking")):
            done = self.run_program("--policy", name)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()

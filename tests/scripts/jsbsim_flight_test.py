# SPDX-License-Identifier: Apache-2.0
"""What scripts/fly_jsbsim knows of Skein, held against flights that Skein records (SKEIN_PROGRAM), and the laws of its
figures. Needs neither numpy nor jsbsim."""
import csv
import glob
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", "scripts"), HERE]

from jsbsim_flight import task  # noqa: E402
from jsbsim_flight.command_smoothness import COMMANDS, action_figures, power, smoothness  # noqa: E402
from jsbsim_flight.control_laws import ControlLaws, Surfaces, step_actuators  # noqa: E402
from jsbsim_flight.flight import Rules, error_figures, fly, hold_figures, step_time  # noqa: E402
from intervals import mean_and_interval, share_and_interval  # noqa: E402
from script_module import load_script  # noqa: E402

fly_jsbsim = load_script("fly_jsbsim")

OBSERVED = 4e-6  # seven digits of float32, of 20,000 ft and in what is taken from it
SURFACE_DEG = 2e-3  # float32 and seven digits through loops whose gains reach tens of degrees per g
TABLED = 4e-3  # of the quantiles: three digits behind the point in print, 0.1 % by the series
ROUNDING = 1e-9
FLOAT = 2e-6  # float32 of commands
REPORTED = 1e-4  # relative and absolute: seven digits of 20,000 ft, 1000 ft/s and 180 deg in errors of a few units
# Full stick commands, drawn every half a second, reach limiters, the integrators' bounds and the schedules of alpha.
RANDOM_AGENT = "random:0.5"
POLICY_STEP = 25  # control steps of this agent: observations are of their beginnings
# The autopilot keeps its throttle at a stop for a third of the time and loses some targets of Control; with this hold
# the actions' power is that of more windows than one.
DWELL_S, HOLD_S = 3, 60


def air(altitude_ft):
    """Density, relative to sea level and absolute, and pressure, of the F-16 models' air (Stevens and Lewis)."""
    temperature_ratio = 1 - 0.703e-5 * altitude_ft
    temperature = 390 if altitude_ft >= 35000 else 519 * temperature_ratio
    density = 2.377e-3 * temperature_ratio ** 4.14
    return temperature_ratio ** 4.14, density, 1715 * density * temperature


def state_of(row):
    value = {name: float(text) for name, text in row.items() if text and name != "termination"}
    ratio, density, pressure = air(value["altitude_ft"])
    angles = {name: math.radians(value[name + "_deg"]) for name in ("roll", "pitch", "yaw", "alpha", "beta")}
    rates = {name: math.radians(value[name + "_deg_s"]) for name in ("p", "q", "r")}
    airspeed = value["true_airspeed_fps"]
    return task.State(
        altitude=value["altitude_ft"], airspeed=airspeed, mach=value["mach"], density_ratio=ratio,
        dynamic_pressure=density * airspeed**2 / 2, static_pressure=pressure, nz=value["load_factor_g"],
        ny=value["lateral_load_factor_g"], power=value["power"], surfaces=surfaces_of(row), **angles, **rates)


def surfaces_of(row):
    return Surfaces(*(float(row[name + "_deg"]) for name in ("elevator", "aileron", "rudder", "leading_edge_flap")))


def target_of(task_class, row):
    """The task with the target of a recorded flight."""
    units = {"_deg": math.radians(1), "_ft": 1, "_fps": 1}
    columns = [column for column in row if column.startswith("target_")]
    flown = task_class(state_of(row), lambda reach: 0)
    flown.target = tuple(float(row[column]) * units["_" + column.split("_")[-1]] for column in columns)
    return flown


def record(name, agent, *options):
    """Flights of an agent as lists of rows, one for every control step, and what skein compare says of the agent."""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        command = [os.environ["SKEIN_PROGRAM"], "compare", "--task", name, "--agents", agent, "--no-html",
                   "--json", report, "--flights", os.path.join(folder, "flights.csv"), *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        (path,) = glob.glob(os.path.join(folder, "flights*.csv"))
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        with open(report, encoding="utf-8") as file:
            (figures,) = json.load(file)["agents"]
    numbers = sorted({row["episode"] for row in rows})
    return [[row for row in rows if row["episode"] == number] for number in numbers], figures


class RecordedFlights(unittest.TestCase):
    """Flights of random stick commands, observed at every control step."""

    @classmethod
    def record(cls, name):
        return record(name, RANDOM_AGENT, "--episodes=4", "--flights-observations", "--set=env.observation_noise=0")[0]

    def test_control_laws_and_actuators_move_the_surfaces_as_skein_does(self):
        steps = 0
        for rows in self.record("heading"):
            laws, positions = ControlLaws(task.DT), surfaces_of(rows[0])
            laws.settle(state_of(rows[0]), positions)
            for before, after in zip(rows, rows[1:]):
                stick = [float(after["action_" + name]) for name in ("pitch", "roll", "yaw")]
                positions = step_actuators(positions, laws.step(*stick, state_of(before)), task.DT)
                for name, angle in vars(surfaces_of(after)).items():
                    self.assertAlmostEqual(getattr(positions, name), angle, delta=SURFACE_DEG,
                                           msg=f"{name} at {after['time_s']} s of flight {after['episode']}")
                steps += 1
        self.assertGreater(steps, 1000)

    def test_observations_are_those_that_skein_shows(self):
        for name, task_class in task.TASKS.items():
            for rows in self.record(name):
                flown = target_of(task_class, rows[0])
                for before, after in list(zip(rows, rows[1:]))[::POLICY_STEP]:
                    expected = [float(after[column]) for column in after if column.startswith("observation_")]
                    observed = flown.observe(state_of(before))
                    self.assertEqual(len(observed), len(expected))
                    for k, (mine, skeins) in enumerate(zip(observed, expected)):
                        self.assertAlmostEqual(mine, skeins, delta=OBSERVED * (1 + abs(skeins)),
                                               msg=f"{name}, number {k}, {after['time_s']} s, {after['episode']}")

    def test_failures_come_when_skein_ends_an_episode(self):
        for rows in self.record("heading"):
            kinds = [task.failure(state_of(row)) for row in rows]
            self.assertEqual(set(kinds[:-1]), {None})
            self.assertEqual(kinds[-1] or "time_limit", rows[-1]["termination"])


class FakeVehicle:
    """Flies a list of states, whatever is commanded."""

    def __init__(self, states):
        self.states, self.step_number = states, 0

    def state(self):
        return self.states[min(self.step_number, len(self.states) - 1)]

    def step(self, throttle, pitch, roll, yaw):
        self.step_number += 1


class Replay:
    """A policy that does what was recorded."""
    action_repeat = 1

    def __init__(self, actions):
        self.actions = iter(actions)

    def begin(self):
        pass

    def act(self, observation):
        return next(self.actions)


class Zero:
    """A policy that does nothing."""
    action_repeat = 5

    def begin(self):
        self.acts = 0

    def act(self, observation):
        self.acts += 1
        return [0.0] * 4


LEVEL = task.State(altitude=20000, roll=0, pitch=0, yaw=0, p=0, q=0, r=0, alpha=0, beta=0, airspeed=1000, mach=0.96,
                   density_ratio=0.5, dynamic_pressure=600, static_pressure=970, nz=1, ny=0, power=30,
                   surfaces=Surfaces())
AWAY = replace(LEVEL, altitude=19500)


class Flights(unittest.TestCase):
    """Flights made by hand, to a target at LEVEL."""

    def fly(self, states, **rules):
        self.policy = Zero()
        return fly(FakeVehicle(states), self.policy, task.Heading(LEVEL, lambda reach: 0), Rules(**rules))

    def test_nothing_counts_before_the_earliest_step_and_then_the_first_touch(self):
        result = self.fly([LEVEL])
        self.assertEqual((result["end"], result["touched_s"], result["reached_s"]), ("target_reached", 6.0, 6.0))
        self.assertEqual(self.policy.acts, 300 / 5)
        self.assertIsNone(result["hold"])

    def test_a_dwell_begins_anew_with_every_break(self):
        states = [AWAY] * 400 + [LEVEL] * 100 + [AWAY] * 10 + [LEVEL]
        result = self.fly(states, dwell_s=3, hold_s=2)
        self.assertEqual((result["end"], result["touched_s"]), ("target_reached", 8.0))
        self.assertEqual(result["reached_s"], step_time(400 + 100 + 10 - 1 + 150))
        self.assertEqual(result["time_to_target_s"], step_time(400 + 100 + 10))
        self.assertEqual(result["flown_s"], step_time(659 + 100))
        self.assertEqual(result["hold"]["within"], 1)

    def test_time_ends_what_is_not_within_tolerances(self):
        self.assertEqual(self.fly([AWAY])["end"], "time_limit")
        self.assertEqual(self.fly([AWAY])["flown_s"], 50.0)
        late = self.fly([AWAY] * 2450 + [LEVEL], dwell_s=3)
        self.assertEqual((late["end"], late["reached_s"]), ("target_reached", step_time(2450 - 1 + 150)))

    def test_what_fails_while_holding_was_not_within_from_then_on(self):
        result = self.fly([LEVEL] * 350 + [replace(LEVEL, nz=11)], hold_s=10)
        self.assertEqual((result["end"], result["reached_s"]), ("overload", 6.0))
        self.assertEqual(result["hold"]["within"], 50 / 500)

    def test_hold_figures_of_a_steady_roll(self):
        rate, count = math.pi / 2, 1000  # 15 turns a minute
        states = [replace(LEVEL, roll=math.remainder(rate * task.DT * k, 2 * math.pi), p=rate, q=(-1)**k * 0.1,
                          nz=1 + (-1)**k * 0.5) for k in range(count)]
        figures = hold_figures(states, [True] * 750 + [False] * 250, count)
        expected = {"within": 0.75, "rms_p_deg_s": 90, "rms_q_deg_s": math.degrees(0.1), "rms_r_deg_s": 0,
                    "load_factor_deviation_g": 0.5, "net_rolls_per_min": 15, "abs_bank_deg": 90}
        for key, value in expected.items():
            self.assertAlmostEqual(figures[key], value, delta=ROUNDING * (1 + value), msg=key)
        back = hold_figures(states + states[::-1], [True], 1)
        self.assertAlmostEqual(back["net_rolls_per_min"], 0, delta=ROUNDING)


    def test_errors_are_root_mean_squares_in_the_units_of_their_keys(self):
        states = [replace(LEVEL, altitude=20000 + 30 * (-1)**k, yaw=0.1, airspeed=1000 + 10 * (k % 2))
                  for k in range(100)]
        expected = {"rms_error_altitude_ft": 30, "rms_error_yaw_deg": math.degrees(0.1),
                    "rms_error_true_airspeed_fps": 10 * math.sqrt(0.5)}
        figures = error_figures(task.Heading(LEVEL, lambda reach: 0), states)
        self.assertEqual(list(figures), list(expected))
        for key, value in expected.items():
            self.assertAlmostEqual(figures[key], value, delta=ROUNDING * value, msg=key)
        pitched = error_figures(task.Control(LEVEL, lambda reach: 0), [replace(LEVEL, pitch=-0.2)])
        self.assertAlmostEqual(pitched["rms_error_pitch_deg"], math.degrees(0.2), delta=ROUNDING)

    def test_actions_of_the_hold_are_those_after_the_step_that_reached_the_target(self):
        # Down to idle in the very step that reaches the target: a change of the flight and not of the hold.
        actions = [[1.0, 0.0, 0.0, 0.0]] * 299 + [[-1.0, 0.0, 0.0, 0.0]] * 51 + [[0.0, 0.25, 0.0, 0.0]] * 50
        result = fly(FakeVehicle([LEVEL]), Replay(actions), task.Heading(LEVEL, lambda reach: 0), Rules(hold_s=2))
        self.assertEqual((result["reached_s"], result["flown_s"]), (6.0, 8.0))
        self.assertAlmostEqual(result["actions"]["throttle_variation_per_s"], 3 / (399 * task.DT), delta=ROUNDING)
        self.assertAlmostEqual(result["actions"]["throttle_saturated"], 350 / 400, delta=ROUNDING)
        self.assertAlmostEqual(result["hold"]["throttle_variation_per_s"], 1 / (99 * task.DT), delta=ROUNDING)
        self.assertAlmostEqual(result["hold"]["throttle_saturated"], 0.5, delta=ROUNDING)
        self.assertAlmostEqual(result["hold"]["pitch_variation_per_s"], 0.25 / (99 * task.DT), delta=ROUNDING)

    def test_a_flight_that_ends_as_non_finite_was_not_within_and_has_no_other_figure(self):
        result = self.fly([LEVEL] * 350 + [replace(LEVEL, nz=math.nan)], hold_s=10)
        self.assertEqual((result["end"], result["actions"], result["hold"]), ("non_finite", {}, {"within": 0}))
        figures = fly_jsbsim.summary("heading", [result, self.fly([LEVEL], hold_s=10)])
        self.assertEqual((figures["hold"]["within"]["mean"], figures["hold"]["rms_p_deg_s"]["count"]), (0.5, 1))


class FiguresOfTheProgram(unittest.TestCase):
    """Flights of the autopilot that Skein records and measures, measured by the script."""

    def replayed(self, name):
        """What skein compare says, and what the script says of the same states and actions."""
        flights, report = record(name, "autopilot", "--episodes=8", "--flights-count=8", f"--hold={HOLD_S}",
                                 f"--set=env.{name}.dwell_s={DWELL_S}")
        results = []
        for rows in flights:
            actions = [[float(row["action_" + command]) for command in COMMANDS] for row in rows[1:]]
            results.append(fly(FakeVehicle([state_of(row) for row in rows]), Replay(actions),
                               target_of(task.TASKS[name], rows[0]), Rules(DWELL_S, HOLD_S)))
            self.assertEqual(results[-1]["end"], rows[-1]["termination"])
        return report["estimates"], fly_jsbsim.summary(name, results)

    def test_hold_and_actions_are_measured_as_skein_does(self):
        for name in task.TASKS:
            estimates, figures = self.replayed(name)
            mine = {**figures["actions"], **{"hold_" + key: value for key, value in figures["hold"].items()},
                    "time_to_target_s": figures["time_to_target_s"]}
            skeins = {key: value for key, value in estimates.items()
                      if key.startswith((*(command + "_" for command in COMMANDS), "hold_"))}
            self.assertEqual(set(skeins) - set(mine), {"hold_within_lowest", "hold_lost"}, name)
            for key, mean in mine.items():
                value = estimates[key]["value"]
                self.assertEqual(mean["count"], estimates[key]["count"], f"{name}: {key}")
                self.assertAlmostEqual(mean["mean"], value, delta=REPORTED * (1 + abs(value)), msg=f"{name}: {key}")
            self.assertAlmostEqual(figures["hold_within_lowest"], estimates["hold_within_lowest"]["value"],
                                   delta=FLOAT)
            self.assertAlmostEqual(figures["hold_lost"]["percent"] / 100, estimates["hold_lost"]["value"],
                                   delta=ROUNDING)
            self.assertGreater(figures["actions"]["throttle_saturated"]["mean"], 0.1)


def sine(amplitude, hz, steps):
    return [amplitude * math.sin(2 * math.pi * hz * task.DT * k) for k in range(steps)]


class CommandSmoothness(unittest.TestCase):
    """Series made by hand: the laws of tests/train/measures/command_smoothness_test.cpp."""

    def expect(self, values, **expected):
        figures = smoothness(values)
        for key, value in expected.items():
            self.assertAlmostEqual(figures[key], value, delta=FLOAT * (1 + value), msg=key)

    def test_a_sine_varies_by_four_amplitudes_and_reverses_twice_a_cycle(self):
        for hz in (0.5, 2.5):  # the peaks are among the samples
            self.expect(sine(0.3, hz, 501), variation_per_s=4 * 0.3 * hz, reversals_per_s=2 * hz, saturated=0)

    def test_power_lies_at_its_frequency_and_adds_up_by_squares_of_amplitudes(self):
        for hz, share in ((0.5, 0), (1.0, 0), (1.1, 1), (7, 1)):  # 1 Hz, the split, is below
            self.expect(sine(0.3, hz, 500), power_above_1hz=share)
        self.expect([a + b - 0.2 for a, b in zip(sine(0.4, 0.3, 500), sine(0.2, 3, 500))], power_above_1hz=0.2)
        whole, _ = power([0.5, -0.25, 0.125, 1, -1, 0, 0.75])
        self.assertAlmostEqual(whole, 2.890625 - 1.125**2 / 7, delta=ROUNDING)

    def test_windows_of_power_are_weighed_by_their_power(self):
        # Fast in the first window of 50 s, slow and twice as far in half a window after it.
        values = sine(0.2, 4, 2500) + sine(0.4, 0.4, 1250)
        self.expect(values, power_above_1hz=0.04 * 50 / (0.04 * 50 + 0.16 * 25))
        self.expect(values[:2549], power_above_1hz=1)  # a rest of less than a second is left out

    def test_chatter_reverses_at_every_change_unless_it_is_within_the_dead_band(self):
        self.expect([0, 0.1] * 250 + [0], variation_per_s=5, reversals_per_s=499 / 10)  # the first change turns nothing
        self.expect([0, 0.1] * 250, power_above_1hz=1)
        self.expect([0, 0.01] * 250 + [0], variation_per_s=0.5, reversals_per_s=0)
        # Steps of 0.0004, far below the dead band, that add up to turns of 0.2.
        self.expect(sine(0.1, 0.03125, 3201), reversals_per_s=2 * 0.03125)
        self.expect(sine(0.009, 0.5, 501), reversals_per_s=0)

    def test_a_held_command_is_measured_as_the_one_that_moves(self):
        moving = sine(0.4, 0.25, 1001)
        held = [moving[k - k % 5] for k in range(1001)]
        figures = smoothness(moving)
        self.expect(held, variation_per_s=figures["variation_per_s"], reversals_per_s=figures["reversals_per_s"])
        self.assertTrue(0 < smoothness(held)["power_above_1hz"] < 0.01)

    def test_constant_and_saturated_commands(self):
        self.expect([0.3] * 500, variation_per_s=0, reversals_per_s=0, power_above_1hz=0, saturated=0)
        self.expect([1.5] * 125 + [-1] * 125 + [0.5] * 250, variation_per_s=3.5 / (499 * task.DT), saturated=0.5)
        self.expect([math.tanh(12)] * 100, saturated=1)  # 1 in float32

    def test_short_series_say_what_they_can(self):
        self.assertEqual((smoothness([]), smoothness([1.0])), ({}, {"saturated": 1}))
        self.assertNotIn("power_above_1hz", smoothness(sine(1, 1, 49)))
        self.assertIn("power_above_1hz", smoothness(sine(1, 1, 50)))

    def test_every_command_is_measured_for_itself(self):
        figures = action_figures([[1.0, value, -value / 2, 0.0] for value in sine(0.4, 0.5, 501)])
        self.assertEqual((figures["throttle_saturated"], figures["yaw_saturated"]), (1, 0))
        self.assertAlmostEqual(figures["pitch_variation_per_s"], 0.8, delta=FLOAT)
        self.assertAlmostEqual(figures["roll_variation_per_s"], 0.4, delta=FLOAT)


class Intervals(unittest.TestCase):
    def test_students_quantiles_are_those_of_the_tables(self):
        for count, quantile in ((2, 12.706), (3, 4.303), (4, 3.182), (6, 2.571), (11, 2.228), (31, 2.042), (101, 1.984)):
            values = [0.0, 1.0] * (count // 2) + [0.5] * (count % 2)
            deviation = math.sqrt(0.25 * (count - count % 2) / (count - 1))
            self.assertAlmostEqual(mean_and_interval(values)["half_width"] / deviation * math.sqrt(count), quantile,
                                   delta=TABLED)

    def test_wilsons_interval_holds_at_the_ends(self):
        # Wilson's interval of 10 of 10 begins at 1 / (1 + z^2 / n).
        share = share_and_interval(10, 10)
        self.assertEqual((share["percent"], round(share["low"], 1), share["high"]), (100, 72.2, 100))
        self.assertAlmostEqual(share_and_interval(0, 10)["high"], 100 - share["low"], delta=ROUNDING)


if __name__ == "__main__":
    unittest.main()

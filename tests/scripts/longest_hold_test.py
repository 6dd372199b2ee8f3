# SPDX-License-Identifier: Apache-2.0
"""Laws of the steady flights of scripts/longest_hold, held against Skein's own trims (SKEIN_PROGRAM), and of how holds
are read. Needs no package."""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "scripts"))

from point_mass.bound import SPEED_TOLERANCE_FPS  # noqa: E402
from point_mass.episodes import EpisodeError  # noqa: E402
from point_mass.forces import GRAVITY_FT_S2, PointMass  # noqa: E402
from point_mass.holds import fly_holds, read_holds  # noqa: E402
from point_mass.steady_hold import SteadyFlight  # noqa: E402

PROGRAM = os.environ["SKEIN_PROGRAM"]
INTERPOLATED_G = 5e-3  # alpha in steps of a degree, densities every 500 ft, the flap's schedule in steps of Mach 0.02
INTERPOLATED_RAD = 1e-3
CLIMBED_SHARE = 0.25  # of seconds held: a climb of 1700 ft takes so much of the thrust
COLUMNS = ("episode,altitude_ft,true_airspeed_fps,p_deg_s,load_factor_g,target_pitch_deg,target_true_airspeed_fps,"
           "error_pitch_deg,error_yaw_deg,error_true_airspeed_fps")


def trim(altitude_ft, speed, path_deg):
    """Skein's steady flight with drag rise and thrust growth."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "trim.json")
        subprocess.run([PROGRAM, "fdm", "trim", "--altitude-ft", str(altitude_ft), "--speed-fps", str(speed),
                        "--flight-path-deg", str(path_deg), "--drag-rise", "--thrust-growth", "--json", path],
                       check=True, stdout=subprocess.DEVNULL)
        with open(path, encoding="utf-8") as file:
            return json.load(file)


class SteadyFlights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.flight = SteadyFlight(PointMass(PROGRAM))

    def test_they_are_the_trims_of_the_program(self):
        for altitude, speed, path_deg in ((15000, 900, 0), (20000, 800, 20), (10000, 700, -5), (25000, 900, 10)):
            skein = trim(altitude, speed, path_deg)
            path, _, greatest = self.flight.straight(speed, altitude, skein["pitch_deg"])
            self.assertAlmostEqual(path, math.radians(path_deg), delta=INTERPOLATED_RAD)
            self.assertAlmostEqual(greatest - math.sin(path), skein["excess_power_fps"] / speed, delta=INTERPOLATED_G)

    def test_what_idle_gives_needs_no_throttle(self):
        # A path on which idle holds the airspeed is one that Skein trims without throttle.
        for altitude, speed in ((15000, 800), (20000, 900)):
            low, high = -20.0, 0.0
            while high - low > 1e-3:
                pitch = (low + high) / 2
                path, least, _ = self.flight.straight(speed, altitude, pitch)
                low, high = (low, pitch) if least < math.sin(path) else (pitch, high)
            self.assertAlmostEqual(trim(altitude, speed, math.degrees(path))["throttle"], 0, delta=0.02)

    def test_level_flight_is_held_to_the_end(self):
        self.assertEqual(self.flight.seconds_held(1000, 20000, 1, 1000, 30), 30)

    def test_a_climb_ends_where_thrust_is_short(self):
        # At full throttle the airspeed falls by excess power over speed, and then leaves its tolerance. The nose is at
        # the tolerance's lower end, on a path 20 deg up, and climbs meanwhile.
        lost_g = -trim(40000, 1100, 20)["excess_power_fps"] / 1100
        seconds = SPEED_TOLERANCE_FPS / (lost_g * GRAVITY_FT_S2)
        high, low = (self.flight.seconds_held(1100, altitude, 26.3, 1100, 30) for altitude in (40000, 15000))
        self.assertAlmostEqual(high, seconds, delta=CLIMBED_SHARE * seconds)
        self.assertGreater(low, 2 * high)

    def test_a_dive_ends_above_the_ground(self):
        # 900 ft/s along a path 15 deg down with the nose at its highest lose 233 ft/s of altitude.
        held = self.flight.seconds_held(900, 4000, -20, 900, 30)
        self.assertGreater(held, 1500 / 400)
        self.assertLess(held, 1500 / 200)

    def test_a_path_without_a_pitch_is_level(self):
        for altitude, speed in ((15000, 900), (25000, 1100)):
            path, _, greatest = self.flight.straight(speed, altitude)
            self.assertEqual(path, 0)
            self.assertAlmostEqual(greatest, trim(altitude, speed, 0)["excess_power_fps"] / speed, delta=INTERPOLATED_G)

    def test_a_dwell_is_held_where_thrust_and_drag_allow(self):
        for altitude, speed in ((20000, 1100), (35000, 900)):
            self.assertTrue(self.flight.can_hold_target("heading", (19500, 0, 1100), (altitude, 90, speed), 3))
        # At this speed and altitude drag takes a g more than full thrust gives: 40 ft/s in less than 1.3 s.
        lost_g = -trim(3000, 2400, 0)["excess_power_fps"] / 2400
        self.assertGreater(lost_g, 1)
        self.assertFalse(self.flight.can_hold_target("heading", (19500, 0, 1100), (3000, 0, 2400), 3))

    def test_any_airspeed_within_the_tolerance_will_do(self):
        # What is held for less than the dwell from the target's airspeed is held for longer from a higher one.
        held = self.flight.seconds_held(1100, 45000, 26.3, 1100, 30)
        with mock.patch("point_mass.steady_hold.SPEED_OFFSETS_FPS", [0]):
            self.assertFalse(self.flight.can_hold([45000], 26.3, 1100, held + 1))
        self.assertTrue(self.flight.can_hold([45000], 26.3, 1100, held + 1))

    def test_a_target_of_control_is_held_at_any_altitude(self):
        target = (26.3, 0, 1100)
        self.assertFalse(self.flight.can_hold([45000], target[0], target[2], 15))
        self.assertTrue(self.flight.can_hold_target("control", (45000, 0, 1100), target, 15))

    def test_the_tolerance_of_pitch_counts(self):
        lowered = self.flight.seconds_held(1100, 20000, 25, 1100, 30)
        with mock.patch("point_mass.steady_hold.PITCH_OFFSETS_DEG", [0]):
            self.assertGreater(lowered, self.flight.seconds_held(1100, 20000, 25, 1100, 30) + 1)


class Holds(unittest.TestCase):
    def read(self, rows, columns=COLUMNS):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "flights.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("\n".join([columns, *rows]) + "\n")
            return read_holds(path, 0.04, 0.08)  # a dwell of two control steps, a hold of four

    def row(self, episode, pitch_error, roll_rate=0.0, load_factor=1.0, altitude=20000, yaw_error=0, speed_error=0):
        return (f"{episode},{altitude},1000,{roll_rate},{load_factor},5,1010,{pitch_error},{yaw_error},"
                f"{speed_error}")

    def test_a_hold_begins_where_the_dwell_ends(self):
        errors = (9, 1, 6, 1, 1, 1, 9, 1, 1)
        rates = (9, 9, 9, 9, 9, 3, -3, 3, -3)
        factors = (7, 7, 7, 7, 7, 1.1, 0.9, 1.1, 0.9)
        (hold,) = self.read([self.row(0, *values, altitude=20000 + k)
                             for k, values in enumerate(zip(errors, rates, factors))])
        self.assertEqual((hold.speed, hold.altitude_ft, hold.target_pitch_deg, hold.target_speed), (1000, 20004, 5, 1010))
        self.assertEqual(hold.within, 0.75)
        self.assertAlmostEqual(hold.roll_rate_deg_s, 3)
        self.assertAlmostEqual(hold.load_factor_deviation_g, 0.1)

    def test_every_error_counts(self):
        for beside in ({"yaw_error": -6}, {"speed_error": 21}):
            (hold,) = self.read([self.row(0, 1)] * 3 + [self.row(0, 1, **beside)] + [self.row(0, 1)] * 2)
            self.assertEqual(hold.within, 0.75)

    def test_what_is_not_flown_is_not_within(self):
        (hold,) = self.read([self.row(0, 1)] * 4)
        self.assertEqual(hold.within, 0.5)

    def test_a_target_that_is_missed_has_no_hold(self):
        missed, held = self.read([self.row(0, 9)] * 4 + [self.row(1, 1)] * 6)
        self.assertIsNone(missed)
        self.assertEqual(held.within, 1)

    def test_a_file_without_a_column_is_refused(self):
        with self.assertRaisesRegex(EpisodeError, "no column p_deg_s"):
            self.read([], COLUMNS.replace("p_deg_s,", ""))

    def test_they_are_what_the_program_reports(self):
        with tempfile.TemporaryDirectory() as folder:
            holds = fly_holds(PROGRAM, "autopilot", 8, 1, 1, 5, folder)
            self.assertEqual(os.listdir(folder), ["report.json"])
        self.assertEqual(len(holds), 8)
        self.assertTrue(any(hold and 0 < hold.within <= 1 for hold in holds))


if __name__ == "__main__":
    unittest.main()

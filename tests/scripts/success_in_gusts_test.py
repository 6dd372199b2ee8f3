#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Laws of the shares that scripts/success_in_gusts prints. Needs no package."""
import argparse
import math
import os
import random
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from script_module import load_script  # noqa: E402

SCRIPT = load_script("success_in_gusts")
FLIGHTS = 600
SAMPLED = 4 * 0.5 / math.sqrt(FLIGHTS)  # four standard deviations of a share of so many flights, at most


def share(wait_s, turbulence=21.0, dwell=3.0, step_s=SCRIPT.STEP_S, seed=1, airspeed=1100.0):
    options = argparse.Namespace(turbulence=turbulence, airspeed=airspeed, tolerance=20.0, dwell=dwell, flights=FLIGHTS)
    return SCRIPT.share_reached(options, wait_s, random.Random(seed), step_s) / FLIGHTS


class Shares(unittest.TestCase):
    def test_still_air_reaches_all_and_a_storm_none(self):
        self.assertEqual(share(0, turbulence=0), 1)
        self.assertEqual(share(20, turbulence=1000), 0)

    def test_at_an_instant_it_is_the_normal_distributions(self):
        inside = math.erf(20 / 21 / math.sqrt(2))
        self.assertAlmostEqual(share(0, dwell=SCRIPT.STEP_S), inside, delta=SAMPLED)

    def test_a_gust_that_hardly_changes_stays_within(self):
        # At 1 ft/s a gust takes half an hour to change.
        self.assertAlmostEqual(share(0, airspeed=1.0), math.erf(20 / 21 / math.sqrt(2)), delta=SAMPLED)

    def test_less_time_and_stronger_gusts_reach_less(self):
        shares = [share(wait) for wait in (40, 20, 5)]
        self.assertGreater(shares[0], shares[1])
        self.assertGreater(shares[1], shares[2])
        self.assertGreater(share(20, turbulence=7.3), 0.99)

    def test_a_finer_step_gives_the_same(self):
        # Between two steps a gust can leave its tolerance and come back: the finer step sees a little more of that.
        coarse, fine = (share(20, step_s=step) for step in (SCRIPT.STEP_S, SCRIPT.STEP_S / 4))
        self.assertAlmostEqual(coarse, fine, delta=math.sqrt(2) * SAMPLED)


class Dwells(unittest.TestCase):
    def reached(self, gusts, wait_steps, dwell_steps):
        rest = iter(gusts)
        return SCRIPT.is_reached(0.0, lambda _: next(rest), wait_steps, dwell_steps, 20, 1)

    def test_a_dwell_has_no_break(self):
        self.assertFalse(self.reached([1, 1, 30, 1, 1, 30], 5, 3))
        self.assertTrue(self.reached([1, 1, -30, 1, 1, 1], 5, 3))

    def test_one_that_has_begun_in_time_may_end_later(self):
        self.assertTrue(self.reached([30, 30, 1, 1, 1], 2, 3))
        self.assertFalse(self.reached([30, 30, 30, 1, 1, 1], 2, 3))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/reached_by_any counts. Needs no package."""
import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from script_module import load_script  # noqa: E402

SCRIPT = load_script("reached_by_any")


class Counts(unittest.TestCase):
    REACHED = [[True, False, False, True], [False, True, False, True], [False, False, False, True]]

    def test_a_target_counts_once(self):
        self.assertEqual(SCRIPT.by_any(self.REACHED), 3)
        self.assertEqual(SCRIPT.by_any(self.REACHED[2:]), 1)

    def test_others_reach_some_of_what_an_agent_misses(self):
        self.assertEqual([SCRIPT.others_reach(self.REACHED, k) for k in range(3)], [1, 1, 2])


if __name__ == "__main__":
    unittest.main()

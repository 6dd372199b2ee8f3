#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/soak calls flat, and what it finds in samples of a training that leaks or slows down."""
import pathlib
import signal
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from ctrl_c import Interrupted  # noqa: E402
from script_module import load_script  # noqa: E402

soak = load_script("soak")


def samples(**changes):
    """Of 200 moments; `changes` says of a name what it is at the share 0 to 1 of the time."""
    rows = []
    for number in range(200):
        share = number / 199
        row = {"memory_mb": 300.0 if share > 0.05 else 40.0, "threads": 3, "descriptors": 12, "files": 9,
               "iterations": int(400 * share), "steps": int(1e6 * share), "processor_s": 100 * share}
        row.update({name: change(share) for name, change in changes.items()})
        rows.append(row)
    return rows


class Soak(unittest.TestCase):
    def test_a_flat_training_is_flat_whatever_it_takes_to_begin(self):
        self.assertEqual(list(soak.grown(samples())), [])

    def test_a_look_at_a_checkpoint_that_is_being_written_is_no_growth(self):
        moments = iter([0] * 190 + [1] + [0] * 9)
        self.assertEqual(list(soak.grown(samples(descriptors=lambda share: 12 + next(moments)))), [])

    def test_each_growth_is_found(self):
        growing = {"memory_mb": lambda share: 300 + 30 * share, "descriptors": lambda share: 12 + int(4 * share),
                   "threads": lambda share: 3 + int(2 * share + 0.5), "files": lambda share: 9 + int(50 * share)}
        for name, change in growing.items():
            findings = list(soak.grown(samples(**{name: change})))
            self.assertEqual(len(findings), 1, name)
            self.assertIn(name.split("_")[0], findings[0])

    def test_a_training_that_slows_down_is_found(self):
        findings = list(soak.grown(samples(steps=lambda share: int(1e6 * (share - 0.2 * share ** 2)))))
        self.assertEqual(len(findings), 1)
        self.assertIn("the rate fell", findings[0])

    def test_too_short_a_training_is_no_judgement(self):
        findings = list(soak.grown(samples(iterations=lambda share: int(90 * share))))
        self.assertEqual(len(findings), 1)
        self.assertIn("give more minutes", findings[0])

    def test_interrupted_leaves_nothing(self):
        for number in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
            ended = Interrupted("soak", "--minutes=60", number=number)
            self.assertEqual((ended.code, ended.error), (128 + number, "scripts/soak: interrupted\n"))
            self.assertEqual((ended.left, ended.running), ([], []))


if __name__ == "__main__":
    unittest.main()

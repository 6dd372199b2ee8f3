#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts say of figures is what `skein bench` says of its own (SKEIN_PROGRAM)."""
import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

from figures import figure, machine_of, machine_of_scripts, quantile, said_as_json  # noqa: E402

PROGRAM = os.environ["SKEIN_PROGRAM"]
ROUNDING = 1e-9


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.said = said_as_json([PROGRAM, "bench", "sim", "--threads", 1, "--num-aircraft", 32, "--steps", 7])

    def test_have_the_words_and_the_spread_of_the_program(self):
        self.assertTrue(self.said["figures"])
        for name, said in self.said["figures"].items():
            own = figure(said["samples"], said["better"])
            spread = said.pop("spread")
            self.assertAlmostEqual(own.pop("spread"), spread, delta=ROUNDING * max(1, spread), msg=name)
            self.assertEqual(own, said, name)

    def test_are_of_the_machine_that_the_program_names(self):
        self.assertEqual(machine_of(PROGRAM), self.said["machine"])
        self.assertIn("commit", self.said["machine"])

    def test_of_scripts_are_of_the_same_machine(self):
        said = machine_of_scripts()
        self.assertEqual(set(said), {"commit", "cpu", "python"})
        self.assertRegex(said["commit"], "^([0-9a-f]{10,}(-dirty)?|unknown)$")
        self.assertEqual(said["cpu"], self.said["machine"]["cpu"])


class Spread(unittest.TestCase):
    def test_few_samples_have_quartiles_among_them(self):
        self.assertEqual(quantile([3.0], 0.25), 3.0)
        self.assertEqual(quantile([2.0, 1.0], 0.75), 2.0)
        self.assertAlmostEqual(quantile([4.0, 1.0, 2.0, 3.0], 0.25), 1 + 5 / 12)
        self.assertEqual(quantile([1, 2, 3, 4, 5, 6, 7], 0.5), 4)

    def test_nothing_has_none(self):
        self.assertIsNone(figure([0.0, 0.0], "less")["spread"])


class Failure(unittest.TestCase):
    def test_of_the_program_is_said_in_its_words(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(said):
            program = pathlib.Path(folder) / "program"
            program.write_text("#!/bin/sh\necho no such thing\nexit 4\n")
            program.chmod(0o755)
            with self.assertRaises(SystemExit) as end:
                machine_of(program)
        self.assertEqual(end.exception.code, 1)
        self.assertRegex(said.getvalue(), "^[^\n]*program info: no such thing\n$")


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/compare_python refuses and writes, without the packages that it needs."""
import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import SCRIPTS, load_script  # noqa: E402


def refusal(*arguments):
    """What it says of arguments that it does not take."""
    packages = {"numpy": mock.MagicMock(), "skein": mock.MagicMock(TASKS=("heading", "control", "tracking"))}
    said = io.StringIO()
    with mock.patch.dict(sys.modules, packages), mock.patch.object(sys, "argv", ["compare_python", *arguments]), \
            contextlib.redirect_stderr(said):
        try:
            load_script("compare_python").main()
        except SystemExit as end:
            return end.code, said.getvalue()
    return 0, said.getvalue()


class Figures(unittest.TestCase):
    def test_have_their_samples_and_say_what_was_measured_where(self):
        native = mock.MagicMock()
        native.vec_env_seconds.side_effect = [1.0, 2.0, 6.0]
        native.describe_machine.return_value = '{"commit": "0123456789"}'
        package = mock.MagicMock(TASKS=("heading",), _skein=native)
        package.make_vec.return_value.policy_step_s = 0.5
        with tempfile.TemporaryDirectory() as folder, \
                mock.patch.dict(sys.modules, {"numpy": mock.MagicMock(), "skein": package}), \
                contextlib.redirect_stdout(io.StringIO()):
            path = pathlib.Path(folder) / "figures.json"
            words = ["compare_python", "--aircraft", "8", "--steps", "10", "--pairs", "3", "--json", str(path)]
            script = load_script("compare_python")
            with mock.patch.object(sys, "argv", words), \
                    mock.patch.object(script, "seconds_from_python", side_effect=[2.0, 4.0, 8.0]), \
                    mock.patch.object(script, "single_step_us", side_effect=range(1, 11)):
                script.main()
            said = json.loads(path.read_text())
        self.assertEqual(said["machine"], {"commit": "0123456789"})
        self.assertEqual(said["settings"], {"task": "heading", "aircraft": 8, "steps": 10, "pairs": 3, "threads": 0})
        self.assertIsNone(said["peers"])
        figures = said["figures"]
        self.assertEqual(figures["share_of_cpp"]["samples"], [0.5, 0.5, 0.75])
        self.assertEqual(figures["share_of_cpp"]["median"], 0.5)
        self.assertEqual(figures["policy_steps_per_s"]["samples"], [40, 20, 10])
        self.assertEqual(figures["simulated_s_per_s"]["samples"], [20, 10, 5])
        self.assertEqual(figures["single_policy_step_us"]["samples"], [6, 7, 8, 9, 10])
        for name, figure in figures.items():
            self.assertGreater(figure["spread"], 0, name)
            self.assertEqual(figure["better"], "less" if name.endswith("_us") else "more", name)


class Arguments(unittest.TestCase):
    def test_that_measure_nothing_are_refused(self):
        for name in ("--aircraft", "--steps", "--pairs"):
            code, said = refusal(name, "0")
            self.assertEqual(code, 2)
            self.assertRegex(said, f"^scripts/compare_python: argument {name}: 0 is less than 1 [^\n]*\n$")

    def test_that_compare_different_tasks_are_refused(self):
        code, said = refusal("--peers", "--task", "control")
        self.assertEqual(code, 2)
        self.assertRegex(said, "^scripts/compare_python: argument --peers: the peers fly heading, not control [^\n]*\n$")

    def test_need_the_packages(self):
        command = [sys.executable, "-I", "-S", SCRIPTS / "compare_python", "--help"]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, "^scripts/compare_python: No module named 'numpy'; install the package: [^\n]*\n$")


if __name__ == "__main__":
    unittest.main()
